#pragma once
#include <map>
#include <string>
#include <vector>

namespace polynya::coupler {

/// Shares the cores among the processes of a run by trial: a process gets twice or half its threads, and keeps them if
/// windows become faster by it. The only thing here that follows wall time; results do not depend on threads.
class ThreadBalance {
 public:
  /// threads: what each process starts with; none of them gets more than `cores`.
  ThreadBalance(int cores, std::map<std::string, int> threads);

  /// Wall time per window of the span that just ended, s. Returns the processes whose number of threads changes now.
  std::vector<std::string> note(double seconds_per_window);
  int threads(const std::string& name) const { return threads_.at(name); }

 private:
  struct Trial {
    std::string name;
    int threads;
  };
  std::vector<std::string> begin_next_trial();
  void plan_trials();
  double median();

  int cores_;
  std::map<std::string, int> threads_;
  std::vector<Trial> planned_;  ///< the last one comes next
  std::string tried_;           ///< process on trial; empty: the present shares are measured
  int threads_before_ = 0;
  double time_ = 0;  ///< s per window with the present shares
  std::vector<double> samples_;
  long skip_ = 0;  ///< spans that do not count
};

/// What the processes start with: fluid and coupler work while all others wait and get every core, the solids work at
/// the same time and get half of them each.
int first_threads(const std::string& name, int cores);

}  // namespace polynya::coupler
