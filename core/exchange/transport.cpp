#include "core/exchange/transport.hpp"

#include <poll.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>
#include <set>
#include <utility>
#include <zmq.hpp>

#include "core/exchange/errors.hpp"

namespace polynya::exchange {
namespace {

using std::chrono::milliseconds;

constexpr int linger_ms = 2000;
constexpr std::size_t least_shared = 1024;  ///< bytes; ZeroMQ keeps very short frames in the message itself
constexpr const char* monitor_address = "inproc://monitor";

bool is_local(const std::string& endpoint) {
  return endpoint.starts_with("ipc://");
}

void check_endpoint(const std::string& endpoint) {
  if (!is_local(endpoint) && !endpoint.starts_with("tcp://"))
    throw EndpointError("endpoint '" + endpoint + "': expected ipc://PATH or tcp://HOST:PORT");
  constexpr std::size_t longest = sizeof(sockaddr_un::sun_path) - 1;
  const std::size_t length = endpoint.size() - std::strlen("ipc://");
  if (is_local(endpoint) && (length == 0 || length > longest))
    throw EndpointError("endpoint '" + endpoint + "': the socket path has " + std::to_string(length) +
                        " characters, allowed are 1 to " + std::to_string(longest));
}

/// Over ipc the kernel reports a dead peer at once, and a peer that a debugger holds must not count as dead. Over tcp
/// a host may vanish silently: the other side's input/output thread then misses its heartbeats.
void set_options(zmq::socket_t& socket, Transport::Side side, bool local) {
  socket.set(zmq::sockopt::linger, linger_ms);
  socket.set(zmq::sockopt::sndhwm, 0);
  socket.set(zmq::sockopt::rcvhwm, 0);
  socket.set(zmq::sockopt::reconnect_ivl, 20);
  if (side == Transport::Side::coupler) socket.set(zmq::sockopt::router_mandatory, true);
  if (local) return;
  socket.set(zmq::sockopt::ipv6, true);
  socket.set(zmq::sockopt::heartbeat_ivl, 500);
  socket.set(zmq::sockopt::heartbeat_timeout, 3000);
  socket.set(zmq::sockopt::heartbeat_ttl, 3000);
}

/// A frame that shares the bytes of an array: the input/output thread sends them from where they are.
zmq::message_t frame_of(const Bytes& bytes) {
  if (bytes.empty()) return zmq::message_t();
  auto* owner = new Bytes(bytes);
  return zmq::message_t(
      const_cast<std::byte*>(owner->data()), owner->size(), [](void*, void* hint) { delete static_cast<Bytes*>(hint); },
      owner);
}

/// The bytes of a frame, where they are if numbers can be read there. Short frames lie side by side, as they came.
Bytes bytes_of(zmq::message_t&& frame) {
  const std::span<const std::byte> bytes(frame.data<std::byte>(), frame.size());
  if (bytes.size() < least_shared || reinterpret_cast<std::uintptr_t>(bytes.data()) % alignof(double) != 0)
    return Bytes(bytes);
  return {bytes, std::make_shared<zmq::message_t>(std::move(frame))};
}

Message decode(std::vector<zmq::message_t>& frames, Envelope& envelope) {
  if (frames.empty()) throw ProtocolError("a message without frames");
  Message message = decode_header(frames[0].to_string_view(), envelope);
  if (frames.size() != message.arrays.size() + 1)
    throw ProtocolError("message '" + message.kind() + "' announces " + std::to_string(message.arrays.size()) +
                        " arrays and came with " + std::to_string(frames.size() - 1));
  for (std::size_t i = 0; i < message.arrays.size(); ++i)
    fill(message.arrays[i], bytes_of(std::move(frames[i + 1])), message.kind());
  return message;
}

}  // namespace

struct Transport::State {
  Side side;
  zmq::context_t context{1};
  zmq::socket_t socket;
  zmq::socket_t monitor;
  std::set<int> open;
  std::vector<int> closed;
  std::chrono::steady_clock::time_point woke;
  std::vector<zmq::message_t> frames;

  State(Side which, const std::string& endpoint)
      : side(which),
        socket(context, which == Side::coupler ? zmq::socket_type::router : zmq::socket_type::dealer),
        monitor(context, zmq::socket_type::pair) {
    set_options(socket, side, is_local(endpoint));
    monitor.set(zmq::sockopt::linger, 0);
    const int events = ZMQ_EVENT_ACCEPTED | ZMQ_EVENT_CONNECTED | ZMQ_EVENT_DISCONNECTED;
    if (zmq_socket_monitor(socket.handle(), monitor_address, events) != 0) throw zmq::error_t();
    monitor.connect(monitor_address);
    try {
      side == Side::coupler ? socket.bind(endpoint) : socket.connect(endpoint);
    } catch (const zmq::error_t& error) {
      throw EndpointError("endpoint '" + endpoint + "': " + error.what());
    }
    read_monitor();  // once, so that its descriptor reports what comes from now on: see next()
  }

  ~State() {
    zmq_socket_monitor(socket.handle(), nullptr, 0);
    if (side == Side::participant) return;
    const std::string address = socket.get(zmq::sockopt::last_endpoint);
    zmq_unbind(socket.handle(), address.c_str());
    // ZeroMQ leaves the socket file behind.
    if (is_local(address)) unlink(address.c_str() + std::strlen("ipc://"));
  }

  std::optional<Delivery> take() {
    frames.clear();
    do {
      zmq::message_t frame;
      if (!socket.recv(frame, zmq::recv_flags::dontwait)) return std::nullopt;
      frames.push_back(std::move(frame));
    } while (frames.back().more());

    Delivery delivery;
    delivery.connection = zmq_msg_get(frames.back().handle(), ZMQ_SRCFD);
    if (side == Side::coupler) {
      delivery.route = frames.front().to_string();
      frames.erase(frames.begin());
    }
    try {
      delivery.message = decode(frames, delivery.envelope);
    } catch (const ProtocolError& error) {
      delivery.fault = error.what();
    }
    frames.clear();
    return delivery;
  }

  void read_monitor() {
    zmq::message_t event;
    while (monitor.recv(event, zmq::recv_flags::dontwait)) {
      // First frame: 16-bit event, 32-bit value (the connection's descriptor); second frame: address.
      std::uint16_t kind = 0;
      std::int32_t connection = 0;
      std::memcpy(&kind, event.data<char>(), sizeof kind);
      std::memcpy(&connection, event.data<char>() + sizeof kind, sizeof connection);
      zmq::message_t address;
      (void)monitor.recv(address);
      if (kind == ZMQ_EVENT_DISCONNECTED) {
        open.erase(connection);
        closed.push_back(connection);
      } else {
        open.insert(connection);
      }
    }
  }
};

Transport::Transport(Side side, const std::string& endpoint) {
  check_endpoint(endpoint);
  state_ = std::make_unique<State>(side, endpoint);
}

Transport::~Transport() = default;

std::optional<Delivery> Transport::next(milliseconds longest) {
  const auto until = std::chrono::steady_clock::now() + longest;
  // ZeroMQ's descriptors report only changes since the socket was last found empty, which take() and read_monitor()
  // make sure of. Waiting on them directly saves the six system calls of zmq_poll. They may also report a change that
  // is no message.
  pollfd both[] = {{state_->socket.get(zmq::sockopt::fd), POLLIN, 0},
                   {state_->monitor.get(zmq::sockopt::fd), POLLIN, 0}};
  while (true) {
    if (std::optional<Delivery> delivery = state_->take()) return delivery;
    const auto left = std::chrono::ceil<milliseconds>(until - std::chrono::steady_clock::now());
    if (!state_->closed.empty() || left <= milliseconds(0)) return std::nullopt;
    const int ready = poll(both, 2, static_cast<int>(left.count()));
    state_->woke = std::chrono::steady_clock::now();
    if (ready > 0 && both[1].revents != 0) state_->read_monitor();
  }
}

std::chrono::steady_clock::time_point Transport::woke() const {
  return state_->woke;
}

std::vector<int> Transport::closed_connections() {
  state_->read_monitor();
  return std::exchange(state_->closed, {});
}

bool Transport::is_open(int connection) {
  state_->read_monitor();
  return connection < 0 || state_->open.contains(connection);
}

bool Transport::send(const std::string& route, Message&& message, const Envelope& envelope) {
  const std::string header = encode_header(message, envelope);
  zmq::socket_t& socket = state_->socket;
  try {
    if (state_->side == Side::coupler) socket.send(zmq::buffer(route), zmq::send_flags::sndmore);
    for (std::size_t i = 0; i <= message.arrays.size(); ++i) {
      zmq::message_t frame =
          i == 0 ? zmq::message_t(header.data(), header.size()) : frame_of(message.arrays[i - 1].bytes);
      socket.send(std::move(frame), i < message.arrays.size() ? zmq::send_flags::sndmore : zmq::send_flags::none);
    }
  } catch (const zmq::error_t& error) {
    if (error.num() == EHOSTUNREACH) return false;
    throw;
  }
  return true;
}

void Transport::abandon_queued() {
  state_->socket.set(zmq::sockopt::linger, 0);
}

std::string Transport::endpoint() const {
  return state_->socket.get(zmq::sockopt::last_endpoint);
}

}  // namespace polynya::exchange
