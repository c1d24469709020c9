#include "core/exchange/participant.hpp"

#include <unistd.h>

#include <algorithm>
#include <chrono>

#include "core/exchange/channel.hpp"

namespace polynya::exchange {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

struct Participant::State {
  Options options;
  std::unique_ptr<Channel> channel;
  Envelope envelope;
  Waits waits;

  explicit State(Options given)
      : options(std::move(given)),
        channel(options.replay.wanted() ? open_replay(options.replay, options.name)
                                        : connect_to_coupler(options.endpoint)),
        envelope{protocol_version, options.run} {}

  /// The next message, or nothing when the time is over.
  std::optional<Message> next(Clock::time_point until) {
    while (true) {
      const auto left = std::max(std::chrono::ceil<milliseconds>(until - Clock::now()), milliseconds(0));
      if (std::optional<Delivery> delivery = channel->next(std::min(left, milliseconds(3'600'000))))
        return accept(std::move(*delivery));
      if (channel->closed()) {
        channel->abandon_queued();
        throw CouplerLost("the coupler at " + options.endpoint + " closed the connection: it ended or was killed");
      }
      if (left == milliseconds(0)) return std::nullopt;
    }
  }

  Message accept(Delivery&& delivery) const {
    if (!delivery.fault.empty()) throw ProtocolError("from the coupler: " + delivery.fault);
    Message& message = delivery.message;
    // A refusal may come from a coupler of another run or version, so it is read before these are compared.
    if (message.kind() == "refuse") throw Refused(message.header.value("reason", "no reason given"));
    if (delivery.envelope.protocol != envelope.protocol || delivery.envelope.run != envelope.run)
      throw ProtocolError("message '" + message.kind() + "' from the coupler belongs to protocol " +
                          std::to_string(delivery.envelope.protocol) + ", run '" + delivery.envelope.run +
                          "'; this is protocol " + std::to_string(envelope.protocol) + ", run '" + envelope.run + "'");
    if (message.kind() == "stop") throw Stopped(message.header.value("reason", "no reason given"));
    return std::move(message);
  }
};

Participant::Participant(Options options) : state_(std::make_unique<State>(std::move(options))) {
  const Options& own = state_->options;
  Message hello("hello");
  hello.header["name"] = own.name;
  hello.header["pid"] = getpid();
  send(std::move(hello));
  const auto patience = std::chrono::duration<double>(own.timeout_seconds);
  const std::optional<Message> answer = state_->next(Clock::now() + std::chrono::ceil<milliseconds>(patience));
  if (!answer) {
    state_->channel->abandon_queued();
    throw CouplerLost("no coupler answered at " + own.endpoint + " within " +
                      nlohmann::json(own.timeout_seconds).dump() + " s");
  }
  expect_kind(*answer, "welcome");
}

Participant::~Participant() = default;

void Participant::send(const Message& message) {
  send(Message(message));
}

void Participant::send(Message&& message) {
  state_->channel->send(std::move(message), state_->envelope);
}

Message Participant::receive() {
  const auto start = Clock::now();
  std::optional<Message> message;
  while (!message) message = state_->next(Clock::now() + std::chrono::hours(1));
  state_->waits.add(start, state_->channel->woke());
  return std::move(*message);
}

Message Participant::receive(std::string_view kind) {
  Message message = receive();
  expect_kind(message, kind);
  return message;
}

void Participant::fail(const std::string& reason) {
  Message message("failed");
  message.header["reason"] = reason;
  send(std::move(message));
}

const Waits& Participant::waits() const {
  return state_->waits;
}

}  // namespace polynya::exchange
