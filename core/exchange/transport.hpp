#pragma once
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/exchange/message.hpp"
#include "core/exchange/wire.hpp"

namespace polynya::exchange {

/// What one multipart message became. Either message is meaningful or fault says what is wrong with it.
struct Delivery {
  std::string route;    ///< address of the sender for Transport::send; empty on the participant's side
  int connection = -1;  ///< number of the connection it came over, as in Transport::closed_connections()
  Message message;
  Envelope envelope;
  std::string fault;
};

/// One ZeroMQ socket with its monitor. The only place of the project that knows ZeroMQ. Nothing in here spins: next()
/// sleeps in the kernel.
class Transport {
 public:
  enum class Side { coupler, participant };  ///< ROUTER that binds, DEALER that connects

  /// Throws EndpointError.
  Transport(Side side, const std::string& endpoint);
  ~Transport();
  Transport(const Transport&) = delete;
  Transport& operator=(const Transport&) = delete;

  /// The next delivery. Sleeps at most this long for one; returns nothing when the time is over or a connection closed.
  /// So whoever finds nothing and then a closed connection has read all that came over it before.
  std::optional<Delivery> next(std::chrono::milliseconds longest);

  /// When next() last came back from sleeping in the kernel; what follows is work on what arrived.
  std::chrono::steady_clock::time_point woke() const;

  /// Connections that the other side closed since the last call, oldest first.
  std::vector<int> closed_connections();
  /// Whether a delivery's connection is still there; true for an unknown one (-1).
  bool is_open(int connection);

  /// Queues a message; arrays are moved out of it. False when nobody is at this route any more.
  bool send(const std::string& route, Message&& message, const Envelope& envelope);

  /// Forgets what is still queued when destroyed, instead of waiting up to two seconds for it to leave.
  void abandon_queued();

  /// The bound or connected address.
  std::string endpoint() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace polynya::exchange
