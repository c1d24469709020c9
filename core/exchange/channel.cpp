#include "core/exchange/channel.hpp"

namespace polynya::exchange {
namespace {

class SocketChannel : public Channel {
 public:
  explicit SocketChannel(const std::string& endpoint) : transport_(Transport::Side::participant, endpoint) {}
  void send(Message&& message, const Envelope& envelope) override { transport_.send({}, std::move(message), envelope); }
  std::optional<Delivery> next(std::chrono::milliseconds longest) override { return transport_.next(longest); }
  bool closed() override { return !transport_.closed_connections().empty(); }
  std::chrono::steady_clock::time_point woke() const override { return transport_.woke(); }
  void abandon_queued() override { transport_.abandon_queued(); }

 private:
  Transport transport_;
};

}  // namespace

std::unique_ptr<Channel> connect_to_coupler(const std::string& endpoint) {
  return std::make_unique<SocketChannel>(endpoint);
}

}  // namespace polynya::exchange
