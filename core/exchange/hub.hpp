#pragma once
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/exchange/errors.hpp"
#include "core/exchange/message.hpp"
#include "core/exchange/recorder.hpp"
#include "core/exchange/waits.hpp"

namespace polynya::exchange {

/// The coupler's end of all conversations (docs/protocol.md). Refuses strangers and duplicates by itself whenever it
/// waits. One thread at a time. Removes its socket file when destroyed.
class Hub {
 public:
  /// Binds. "tcp://127.0.0.1:*" takes a free port, see endpoint(). Throws EndpointError.
  Hub(std::string endpoint, std::string run, std::vector<std::string> expected);
  ~Hub();
  Hub(const Hub&) = delete;
  Hub& operator=(const Hub&) = delete;

  /// From now on notes every message of send() and receive(), in this order. The recorder must outlive the hub's use.
  void record(Recorder& recorder);

  /// Welcomes participants until all expected ones are here. Throws ParticipantMissing naming the others after the
  /// timeout, ParticipantLost when one comes and goes.
  void await_participants(double timeout_seconds);

  /// Hands a message to the transport and returns at once. The second form moves the arrays instead of copying them.
  /// After `bye` the participant may leave. Throws ParticipantLost when it is gone already.
  void send(const std::string& name, const Message& message);
  void send(const std::string& name, Message&& message);

  /// Blocks until this participant's next message, however long it computes. Throws ParticipantLost when any
  /// participant is gone (before `bye`) or gave up, ProtocolError on a malformed message.
  Message receive(const std::string& name);
  /// The same, and throws ProtocolError unless the message is of this kind.
  Message receive(const std::string& name, std::string_view kind);

  /// Sends `stop` to every participant that is still here. Never throws for a participant that is not.
  void stop_all(const std::string& reason);

  /// Seconds spent blocked in receive(name), and when.
  double waiting_seconds(const std::string& name) const { return waits(name).total(); }
  const Waits& waits(const std::string& name) const;
  /// The bound address, wildcards resolved.
  std::string endpoint() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace polynya::exchange
