#pragma once
#include <limits>
#include <memory>
#include <string>

namespace polynya::exchange {

class Channel;

/// One solver against the record of a coupled run, with no other process.
struct Replay {
  std::string record = {};  ///< RUN/record; empty: no replay
  double from = 0;          ///< s: before it nothing is compared, no field frame is written
  double until = std::numeric_limits<double>::infinity();  ///< s: the replay ends with the window that reaches it
  double tolerance = 0;     ///< largest difference allowed, as in MessageDifference; 0: bit for bit
  bool keep_going = false;  ///< past differences; the largest is told at the end

  bool wanted() const { return !record.empty(); }
};

/// Plays the coupler from the record. Compares what the participant sends with what it sent then: ReplayDifference
/// names the first difference. Ends with ReplayEnded, the verdict, where `bye` is due, where the record ends, or at
/// `until`. Calls polynya_replay_reached() once. Throws RecordError.
std::unique_ptr<Channel> open_replay(const Replay& replay, const std::string& participant);

}  // namespace polynya::exchange

/// Called when a replay reaches `from`: for a solid the positions of that window are known and its forces are not yet,
/// for the fluid the walls at the end of its step are known. Does nothing; a debugger stops here.
extern "C" void polynya_replay_reached(double time);
