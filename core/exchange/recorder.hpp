#pragma once
#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/exchange/message.hpp"
#include "core/exchange/record_segment.hpp"

namespace polynya::exchange {

/// Writes down what participants and coupler say to each other, in files that are closed and renamed one after the
/// other: RECORD/ice-00000.h5, RECORD/ice-00001.h5 and so on (layout: docs/debugging.md). So all but the latest is
/// readable whenever the process is killed. A thread of its own writes; the run waits only when that
/// thread falls behind by more than the queue.
class Recorder {
 public:
  struct Options {
    std::string folder;                           ///< RUN/record
    std::string run;                              ///< identifier of the run
    std::vector<std::string> participants;        ///< empty: all
    RecordSelection selection;                    ///< one that does not begin at the start cannot be replayed
    std::optional<std::array<double, 6>> region;  ///< m, see RecordRegion; such a record cannot be replayed
    Compression compression = Compression::none;
    double segment_seconds = 2;  ///< longest wall time between two files; a hundredth of the run if that is more
    std::size_t segment_bytes = 32 << 20;  ///< most of one file; early ones are smaller
    std::size_t queue_bytes = 128 << 20;
  };

  struct Statistics {
    std::size_t messages = 0, bytes = 0;
    double noting_seconds = 0;   ///< of the run's thread, in note()
    double closing_seconds = 0;  ///< of the run's thread, in close()
    double busy_seconds = 0;     ///< processor time of the recorder's thread
  };

  explicit Recorder(Options options);
  /// Closes what is open. Use close() to learn of errors.
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Keeps a message for the record; it shares the arrays' bytes. One thread at a time. Throws results::ResultsError
  /// when an earlier one could not be written.
  void note(const std::string& participant, Sender sender, const Message& message);

  /// Writes the last files. Throws results::ResultsError.
  Statistics close();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace polynya::exchange
