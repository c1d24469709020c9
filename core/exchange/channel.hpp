#pragma once
#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "core/exchange/transport.hpp"

namespace polynya::exchange {

/// What a participant talks through: a connection to the coupler, or a record of what was said. Chosen once.
class Channel {
 public:
  virtual ~Channel() = default;
  /// Queues a message; arrays are moved out of it.
  virtual void send(Message&& message, const Envelope& envelope) = 0;
  /// The next delivery. Sleeps at most this long for one; returns nothing when the time is over or the other side left.
  virtual std::optional<Delivery> next(std::chrono::milliseconds longest) = 0;
  /// Whether the other side has left. What it said before is still delivered first.
  virtual bool closed() = 0;
  /// When next() last came back from sleeping; the epoch where it never sleeps.
  virtual std::chrono::steady_clock::time_point woke() const = 0;
  /// Forgets what has not left yet.
  virtual void abandon_queued() = 0;
};

/// A ZeroMQ socket connected to the coupler. Throws EndpointError.
std::unique_ptr<Channel> connect_to_coupler(const std::string& endpoint);

}  // namespace polynya::exchange
