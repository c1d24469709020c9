#pragma once
#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace polynya::results {

/// Folder of a checkpoint, relative to the run's: "checkpoints/000000123".
std::string checkpoint_folder(std::int64_t step);

/// Makes a checkpoint valid whose files ("fluid.h5", ...) are all there: writes its manifest.json (time, step, names
/// and sizes of the files) by rename, then removes all checkpoints of the run but this one and the valid one before it.
/// Throws ResultsError.
void commit_checkpoint(const std::string& run_folder, std::int64_t step, double time,
                       const std::vector<std::string>& files);

/// When the next checkpoint is due: after so much simulated time and after so much wall time, whichever comes first.
/// Results do not depend on it. 0: never.
class CheckpointSchedule {
 public:
  CheckpointSchedule(double interval, double wall_interval, double time);
  bool due(double time) const;
  /// A checkpoint is being taken now.
  void taken(double time);

 private:
  using Clock = std::chrono::steady_clock;
  double interval_, wall_interval_, next_;
  Clock::time_point last_ = Clock::now();
};

}  // namespace polynya::results
