#pragma once
#include <chrono>
#include <map>
#include <string>

namespace polynya::compute {

/// Wall time in seconds spent under named headings ("remap", "waiting", ...).
class Stopwatch {
 public:
  /// Adds the time from construction to destruction to one heading.
  class Lap {
   public:
    Lap(Stopwatch& owner, const char* heading)
        : owner_(owner), heading_(heading), start_(std::chrono::steady_clock::now()) {}
    ~Lap() {
      const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start_;
      owner_.seconds_[heading_] += passed.count();
    }
    Lap(const Lap&) = delete;
    Lap& operator=(const Lap&) = delete;

   private:
    Stopwatch& owner_;
    const char* heading_;
    std::chrono::steady_clock::time_point start_;
  };

  [[nodiscard]] Lap lap(const char* heading) { return Lap(*this, heading); }
  const std::map<std::string, double>& seconds() const { return seconds_; }

 private:
  std::map<std::string, double> seconds_;
};

}  // namespace polynya::compute
