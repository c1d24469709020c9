#pragma once
#include <string>
#include <vector>

#include "core/compute/state_archive.hpp"
#include "core/results/frame.hpp"

namespace polynya::results {

/// The field frames of one participant: RUN/fields/NAME_0000.vtkhdf, ... and their index RUN/fields/NAME.json,
/// {"frames": [{"file": "NAME_0000.vtkhdf", "time": 0.0}, ...]}, rewritten by rename after each frame.
class FrameSeries {
 public:
  FrameSeries(std::string run_folder, std::string name);

  /// Writes frame `number` (>= 0) at `time` in s and adds it to the index; a number written again replaces its entry.
  /// Throws ResultsError.
  void write(int number, const UnstructuredFields& fields, double time);

  std::size_t count() const { return entries_.size(); }
  /// s, of the frame written last; -1 if there is none.
  double last_time() const { return entries_.empty() ? -1 : entries_.back().time; }

  /// The index. The first frame after loading removes those that came later: until then all is as it was, in case
  /// another program refuses the checkpoint.
  void list_state(compute::StateArchive& archive);

 private:
  struct Entry {
    std::string file;
    double time;

    POLYNYA_STATE(file, time)
  };
  void remove_others() const;
  void write_index() const;

  std::string folder_;
  std::string name_;
  std::vector<Entry> entries_;
  bool cut_ = false;  ///< before the next frame: what is not in the index
};

}  // namespace polynya::results
