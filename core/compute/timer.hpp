#pragma once
#include <time.h>

#include <map>
#include <string>

namespace polynya::compute {

/// Wall and processor time in seconds spent under named headings ("remap", "contact", ...). A lap within a lap counts
/// for the inner heading only, so headings add up to no more than the time that passed.
class Stopwatch {
 public:
  /// The time from construction to destruction belongs to one heading, less that of laps within.
  class Lap {
   public:
    Lap(Stopwatch& owner, const char* heading) : owner_(owner), outer_(owner.switch_to(heading)) {}
    ~Lap() { owner_.switch_to(outer_); }
    Lap(const Lap&) = delete;
    Lap& operator=(const Lap&) = delete;

   private:
    Stopwatch& owner_;
    const char* outer_;
  };

  [[nodiscard]] Lap lap(const char* heading) { return Lap(*this, heading); }
  const std::map<std::string, double>& seconds() const { return seconds_; }
  /// Of all threads of the process.
  const std::map<std::string, double>& cpu_seconds() const { return cpu_seconds_; }

 private:
  static double now(clockid_t clock) {
    timespec time;
    clock_gettime(clock, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }

  /// Books the time since the last call under the heading of now; returns that heading.
  const char* switch_to(const char* heading) {
    const double wall = now(CLOCK_MONOTONIC), cpu = now(CLOCK_PROCESS_CPUTIME_ID);
    if (heading_) {
      seconds_[heading_] += wall - wall_;
      cpu_seconds_[heading_] += cpu - cpu_;
    }
    wall_ = wall;
    cpu_ = cpu;
    const char* before = heading_;
    heading_ = heading;
    return before;
  }

  std::map<std::string, double> seconds_, cpu_seconds_;
  const char* heading_ = nullptr;
  double wall_ = 0, cpu_ = 0;
};

}  // namespace polynya::compute
