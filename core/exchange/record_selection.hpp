#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace polynya::exchange {

/// Which windows of a run are on record: intervals of time (s) or of window numbers, ends included, ascending:
/// [from, to, from, to, ...], the last one open where its end is missing. Both empty: all.
struct RecordSelection {
  std::vector<double> times;
  std::vector<std::int64_t> windows;

  bool holds(std::int64_t window, double time) const { return within(windows, window) && within(times, time); }
  bool from_the_start() const {
    return (times.empty() || times.front() <= 0) && (windows.empty() || windows.front() <= 0);
  }

 private:
  template <class T>
  static bool within(const std::vector<T>& ends, T value) {
    if (ends.empty()) return true;
    for (std::size_t k = 0; k < ends.size(); k += 2)
      if (value >= ends[k] && (k + 1 == ends.size() || value <= ends[k + 1])) return true;
    return false;
  }
};

}  // namespace polynya::exchange
