#pragma once
#include <memory>
#include <string>
#include <string_view>

#include "core/exchange/errors.hpp"
#include "core/exchange/message.hpp"
#include "core/exchange/replay.hpp"
#include "core/exchange/waits.hpp"

namespace polynya::exchange {

/// A solver's end of the conversation with the coupler (docs/protocol.md). Order of calls: construct, send `ready`,
/// receive `begin`, then the loop of the role, send `finished`, receive `bye`. One thread at a time.
class Participant {
 public:
  struct Options {
    std::string endpoint;         ///< "ipc:///tmp/x/socket" or "tcp://host:port"
    std::string run;              ///< identifier of the run, the same for all its processes
    std::string name;             ///< one of the names the coupler expects
    double timeout_seconds = 60;  ///< longest wait for the coupler's answer to `hello`
    Replay replay = {};  ///< when wanted: the record takes the place of the coupler, endpoint and run are unused
  };

  /// Connects, says `hello` and waits for `welcome`. Throws EndpointError, Refused, CouplerLost, RecordError.
  explicit Participant(Options options);
  ~Participant();
  Participant(const Participant&) = delete;
  Participant& operator=(const Participant&) = delete;

  /// Hands a message to the transport and returns at once. The second form moves the arrays instead of copying them.
  /// In a replay throws ReplayDifference, and like receive() ReplayEnded.
  void send(const Message& message);
  void send(Message&& message);

  /// Blocks until the next message, however long the coupler computes. Throws Stopped on `stop`, CouplerLost when the
  /// coupler ended or was killed, ProtocolError on a malformed message.
  Message receive();
  /// The same, and throws ProtocolError unless the message is of this kind.
  Message receive(std::string_view kind);

  /// Tells the coupler that this participant cannot go on, in one sentence. The coupler ends the run with it.
  void fail(const std::string& reason);

  /// Seconds spent blocked in receive(), and when.
  double waiting_seconds() const { return waits().total(); }
  const Waits& waits() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace polynya::exchange
