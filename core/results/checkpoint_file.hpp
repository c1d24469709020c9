#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "core/compute/state_archive.hpp"
#include "core/results/error.hpp"

namespace polynya::results {

/// A checkpoint that cannot be used: missing, damaged, or of another scene, version or program. The text names the file
/// and what differs.
class CheckpointError : public ResultsError {
  using ResultsError::ResultsError;
};

/// Whose state a file holds, and of when.
struct CheckpointStamp {
  std::string program;    ///< "fluid_solver", ...
  std::string scene;      ///< the resolved scene, JSON
  double time = 0;        ///< s
  std::int64_t step = 0;  ///< completed: windows of a coupled run, steps of a solver alone
};

/// Saves a state to an HDF5 file: every value a data set of its name with a checksum, the stamp and the version as
/// attributes. Written aside; commit() makes it appear whole. Throws ResultsError.
class CheckpointWriter final : public compute::StateArchive {
 public:
  CheckpointWriter(std::string path, const CheckpointStamp& stamp);
  ~CheckpointWriter() override;
  void commit();

 private:
  std::size_t stored(const std::string& name, Entry entry) override;
  void transfer(const std::string& name, Entry entry, void* data, std::size_t count) override;

  struct File;
  std::unique_ptr<File> file_;
};

/// Loads a state from such a file. Throws CheckpointError where the file does not fit; values that fit no list of the
/// program make finish() throw.
class CheckpointReader final : public compute::StateArchive {
 public:
  /// scene: the resolved scene of now, JSON. It must be that of the checkpoint but for what may change on the way: the
  /// end time, checkpoints, the record, command, launch and threads of participants, names and what is reported.
  CheckpointReader(std::string path, const std::string& program, const std::string& scene);
  ~CheckpointReader() override;

  double time() const { return time_; }
  std::int64_t step() const { return step_; }
  /// Empty, or one sentence where the program is another build than the one that wrote the file.
  const std::string& remark() const { return remark_; }
  /// Call when all is loaded.
  void finish();

  /// Loads one object: item() and finish(), all errors with the name of the file.
  template <class T>
  void load(T& state) {
    try {
      item("state", state);
    } catch (const compute::StateError& error) {
      throw_unfit(error.what());
    }
    finish();
  }

 private:
  std::size_t stored(const std::string& name, Entry entry) override;
  void transfer(const std::string& name, Entry entry, void* data, std::size_t count) override;
  [[noreturn]] void throw_unfit(const std::string& what) const;

  struct File;
  std::unique_ptr<File> file_;
  double time_ = 0;
  std::int64_t step_ = 0;
  std::string remark_;
};

/// Saves one object as CheckpointReader::load reads it.
template <class T>
void save_checkpoint(const std::string& path, const CheckpointStamp& stamp, T& state) {
  CheckpointWriter writer(path, stamp);
  writer.item("state", state);
  writer.commit();
}

/// One program's part in the checkpoints of its run: FOLDER/NAME.h5.
class Checkpoints {
 public:
  Checkpoints() = default;  ///< takes no part
  /// scene: resolved, JSON. resume: folder of the checkpoint to go on from; empty: a fresh run.
  Checkpoints(std::string run_folder, std::string name, std::string program, std::string scene, std::string resume)
      : run_folder_(std::move(run_folder)),
        name_(std::move(name)),
        program_(std::move(program)),
        scene_(std::move(scene)),
        resume_(std::move(resume)) {}

  bool active() const { return !name_.empty(); }
  bool resuming() const { return !resume_.empty(); }
  std::string file() const { return name_ + ".h5"; }

  /// folder: relative to the run's.
  template <class T>
  void save(const std::string& folder, std::int64_t step, double time, T& state) const {
    save_checkpoint(run_folder_ + "/" + folder + "/" + file(), {program_, scene_, time, step}, state);
  }
  /// Returns what the user should know (CheckpointReader::remark). Throws CheckpointError.
  template <class T>
  std::string load(T& state) const {
    CheckpointReader reader(resume_ + "/" + file(), program_, scene_);
    reader.load(state);
    return reader.remark();
  }
  /// Whether the file is there and fits, without loading it: time in s. Throws CheckpointError.
  double check() const { return CheckpointReader(resume_ + "/" + file(), program_, scene_).time(); }

 private:
  std::string run_folder_, name_, program_, scene_, resume_;
};

/// The first key in which two resolved scenes differ so that a run cannot go on, as "vehicle.speed is 60 there and 40
/// here"; empty if there is none.
std::string scene_difference(const std::string& there, const std::string& here);

}  // namespace polynya::results
