#pragma once
#include <array>
#include <map>
#include <string>
#include <vector>

namespace polynya::results {

/// When a process was blocked, waiting for a message: [n] pairs of seconds on the clock that all processes of a machine
/// share (CLOCK_MONOTONIC), ascending.
using Waits = std::vector<std::array<double, 2>>;

/// What a process used.
class ProcessReport {
 public:
  int threads = 0;                            ///< of parallel loops, at the end
  std::map<std::string, Waits> waits;         ///< by whom the process waited for
  std::map<std::string, double> seconds;      ///< s of wall time under headings, less the waits: see set_headings
  std::map<std::string, double> cpu_seconds;  ///< s of processor time of all threads under the same headings
  std::map<std::string, double> counts;       ///< "steps", "cells", ...

  /// Takes over the headings of a stopwatch. All waiting happens under its heading "messages": what is left of that is
  /// the time for packing, sending and unpacking.
  void set_headings(const std::map<std::string, double>& wall, const std::map<std::string, double>& cpu);

  static double wall_time();    ///< s since the process began
  double waiting_time() const;  ///< s, sum of the waits
  static double cpu_time();     ///< s of user and system time of this process, all threads
  static double peak_memory();  ///< bytes, largest resident size so far

  /// Writes RUN/logs/NAME.json: wall_time, cpu_time, waiting_time, threads, peak_memory, seconds, cpu_seconds, counts;
  /// and RUN/logs/NAME_waits.csv if it waited. Throws ResultsError.
  void write(const std::string& run_folder, const std::string& name) const;
};

}  // namespace polynya::results
