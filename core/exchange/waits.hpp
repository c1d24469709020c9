#pragma once
#include <array>
#include <chrono>
#include <vector>

namespace polynya::exchange {

/// When a thread was blocked, waiting for a message.
class Waits {
 public:
  using Clock = std::chrono::steady_clock;

  /// Books a wait that began and ended then; nothing if it never slept.
  void add(Clock::time_point from, Clock::time_point to) {
    if (to > from) intervals_.push_back({seconds(from), seconds(to)});
  }
  double total() const {
    double sum = 0;
    for (const auto& [from, to] : intervals_) sum += to - from;
    return sum;
  }
  /// [n] pairs of seconds on the clock that all processes of a machine share, ascending.
  const std::vector<std::array<double, 2>>& intervals() const { return intervals_; }

 private:
  static double seconds(Clock::time_point time) {
    return std::chrono::duration<double>(time.time_since_epoch()).count();
  }

  std::vector<std::array<double, 2>> intervals_;
};

}  // namespace polynya::exchange
