#pragma once
#include <chrono>
#include <map>
#include <string>

namespace polynya::results {

/// What a process used. Construct it first thing in main; write it last.
class ProcessReport {
 public:
  double waiting_time = 0;                ///< s of wall time spent waiting for messages
  std::map<std::string, double> seconds;  ///< s of wall time under headings, e.g. compute::Stopwatch::seconds()
  std::map<std::string, double> counts;   ///< "steps", "cells", ...

  double wall_time() const;     ///< s since construction
  static double cpu_time();     ///< s of user and system time of this process, all threads
  static double peak_memory();  ///< bytes, largest resident size so far

  /// Writes RUN/logs/NAME.json: wall_time, cpu_time, peak_memory, waiting_time, seconds, counts. Throws ResultsError.
  void write(const std::string& run_folder, const std::string& name) const;

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace polynya::results
