#include "core/exchange/hub.hpp"

#include <algorithm>
#include <chrono>
#include <deque>
#include <map>
#include <utility>

#include "core/exchange/environment.hpp"
#include "core/exchange/transport.hpp"

namespace polynya::exchange {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

/// How often the hub looks whether the processes it waits for still exist. A closed connection wakes it at once; this
/// second look is for a connection that a child of the dead process keeps open.
constexpr milliseconds second_look{1000};

enum class Presence { expected, here, departed };

struct Member {
  Presence presence = Presence::expected;
  std::string route;
  int connection = -1;
  long pid = 0;  ///< 0: on another host, or not told
  std::deque<Message> inbox;
  Waits waits;
};

std::string list(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace

struct Hub::State {
  Transport transport;
  Envelope envelope;
  std::map<std::string, Member> members;
  std::map<std::string, std::string> name_of_route;
  std::vector<std::string> leaving;
  std::string last_refusal;
  Recorder* recorder = nullptr;
  bool local;

  State(const std::string& endpoint, std::string run, const std::vector<std::string>& expected)
      : transport(Transport::Side::coupler, endpoint),
        envelope{protocol_version, std::move(run)},
        local(endpoint.starts_with("ipc://")) {
    for (const std::string& name : expected) members[name];
  }

  Member& member(const std::string& name) {
    const auto found = members.find(name);
    if (found == members.end()) throw std::invalid_argument("no participant '" + name + "' is expected in this run");
    return found->second;
  }

  /// Takes in one message, or sleeps at most this long for one. Only when nothing is left to read does a closed
  /// connection count: what the participant said before, its own reason for leaving above all, comes first.
  void attend(milliseconds longest) {
    if (std::optional<Delivery> delivery = transport.next(std::min(longest, second_look)))
      return accept(std::move(*delivery));
    note_closed_connections();
    lose(std::exchange(leaving, {}));
    lose(members_without_process());
  }

  void note_closed_connections() {
    for (const int connection : transport.closed_connections())
      for (const auto& [name, member] : members)
        if (member.presence == Presence::here && member.connection == connection) leaving.push_back(name);
  }

  void lose(std::vector<std::string> gone) {
    std::erase_if(gone, [&](const std::string& name) { return members[name].presence != Presence::here; });
    for (const std::string& name : gone) members[name].presence = Presence::departed;
    if (!gone.empty())
      throw ParticipantLost(gone.front(),
                            "closed its connection before the end of the run; it ended, crashed or was killed");
  }

  std::vector<std::string> members_without_process() const {
    std::vector<std::string> found;
    for (const auto& [name, member] : members)
      if (member.presence == Presence::here && member.pid != 0 && !process_is_alive(member.pid)) found.push_back(name);
    return found;
  }

  void accept(Delivery&& delivery) {
    const auto known = name_of_route.find(delivery.route);
    if (known == name_of_route.end()) return meet(std::move(delivery));
    const std::string& name = known->second;
    if (!delivery.fault.empty()) throw ProtocolError("from " + name + ": " + delivery.fault);
    if (delivery.envelope.protocol != envelope.protocol || delivery.envelope.run != envelope.run)
      throw ProtocolError("from " + name + ": message '" + delivery.message.kind() + "' of another protocol or run");
    if (delivery.message.kind() == "failed") {
      members[name].presence = Presence::departed;
      throw ParticipantLost(name, delivery.message.header.value("reason", "gave up without a reason"));
    }
    members[name].inbox.push_back(std::move(delivery.message));
  }

  void meet(Delivery&& delivery) {
    const std::string reason = objection(delivery);
    if (!reason.empty()) return refuse(delivery.route, reason);
    if (!transport.is_open(delivery.connection)) return;
    note_closed_connections();  // now, because the number of a closed connection may belong to the newcomer
    if (!transport.send(delivery.route, Message("welcome"), envelope)) return;
    const std::string name = delivery.message.header["name"];
    Member& member = members[name];
    member.presence = Presence::here;
    member.route = delivery.route;
    member.connection = delivery.connection;
    const auto& header = delivery.message.header;
    const bool told = header.contains("pid") && header["pid"].is_number_integer();
    const long pid = told ? header["pid"].get<long>() : 0;
    member.pid = local && process_is_alive(pid) ? pid : 0;
    name_of_route[delivery.route] = name;
  }

  /// Why a newcomer is not welcome; empty when it is.
  std::string objection(const Delivery& delivery) const {
    const auto& header = delivery.message.header;
    if (!delivery.fault.empty()) return delivery.fault;
    if (delivery.envelope.protocol != envelope.protocol)
      return "this coupler speaks protocol " + std::to_string(envelope.protocol) + ", not " +
             std::to_string(delivery.envelope.protocol);
    if (delivery.envelope.run != envelope.run)
      return "this is run '" + envelope.run + "', not '" + delivery.envelope.run + "'";
    if (delivery.message.kind() != "hello")
      return "the first message must be 'hello', not '" + delivery.message.kind() + "'";
    if (!header.contains("name") || !header["name"].is_string()) return "'hello' lacks the field 'name'";
    const auto found = members.find(header["name"].get<std::string>());
    if (found == members.end())
      return "no participant '" + header["name"].get<std::string>() + "' is expected; expected are " + list(names());
    if (found->second.presence != Presence::expected)
      return "a participant '" + found->first + "' has already joined this run";
    return {};
  }

  void refuse(const std::string& route, const std::string& reason) {
    last_refusal = reason;
    Message refusal("refuse");
    refusal.header["reason"] = reason;
    transport.send(route, std::move(refusal), envelope);
  }

  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const auto& [name, member] : members) all.push_back(name);
    return all;
  }

  std::vector<std::string> missing() const {
    std::vector<std::string> absent;
    for (const auto& [name, member] : members)
      if (member.presence == Presence::expected) absent.push_back(name);
    return absent;
  }
};

Hub::Hub(std::string endpoint, std::string run, std::vector<std::string> expected)
    : state_(std::make_unique<State>(endpoint, std::move(run), expected)) {}

Hub::~Hub() = default;

void Hub::record(Recorder& recorder) {
  state_->recorder = &recorder;
}

void Hub::await_participants(double timeout_seconds) {
  const auto until = Clock::now() + std::chrono::ceil<milliseconds>(std::chrono::duration<double>(timeout_seconds));
  while (!state_->missing().empty()) {
    const auto left = std::chrono::ceil<milliseconds>(until - Clock::now());
    if (left > milliseconds(0)) {
      state_->attend(left);
      continue;
    }
    const std::vector<std::string> absent = state_->missing();
    std::string sentence = list(absent) + " did not join run '" + state_->envelope.run + "' at " + endpoint() +
                           " within " + nlohmann::json(timeout_seconds).dump() + " s";
    if (!state_->last_refusal.empty()) sentence += "; last refusal: " + state_->last_refusal;
    throw ParticipantMissing(absent, sentence);
  }
}

void Hub::send(const std::string& name, const Message& message) {
  send(name, Message(message));
}

void Hub::send(const std::string& name, Message&& message) {
  Member& member = state_->member(name);
  const bool last = message.kind() == "bye";
  if (member.presence != Presence::here) throw ParticipantLost(name, "is not part of the run at this time");
  if (state_->recorder != nullptr) state_->recorder->note(name, Sender::coupler, message);
  if (!state_->transport.send(member.route, std::move(message), state_->envelope)) {
    // What it said last is still to be read: these rounds throw, with its own reason if it gave one.
    for (int round = 0; round < 3; ++round) state_->attend(second_look);
    throw ParticipantLost(name, "cannot be reached any more");
  }
  if (last) member.presence = Presence::departed;
}

Message Hub::receive(const std::string& name) {
  Member& member = state_->member(name);
  const auto start = Clock::now();
  while (member.inbox.empty()) {
    if (member.presence != Presence::here) throw ParticipantLost(name, "is not part of the run at this time");
    state_->attend(second_look);
  }
  member.waits.add(start, state_->transport.woke());
  Message message = std::move(member.inbox.front());
  member.inbox.pop_front();
  if (state_->recorder != nullptr) state_->recorder->note(name, Sender::participant, message);
  return message;
}

Message Hub::receive(const std::string& name, std::string_view kind) {
  Message message = receive(name);
  if (message.kind() != kind)
    throw ProtocolError("from " + name + ": expected a message '" + std::string(kind) + "', received '" +
                        message.kind() + "'");
  return message;
}

void Hub::stop_all(const std::string& reason) {
  for (auto& [name, member] : state_->members) {
    if (member.presence != Presence::here) continue;
    Message stop("stop");
    stop.header["reason"] = reason;
    state_->transport.send(member.route, std::move(stop), state_->envelope);
    member.presence = Presence::departed;
  }
}

const Waits& Hub::waits(const std::string& name) const {
  return state_->member(name).waits;
}

std::string Hub::endpoint() const {
  return state_->transport.endpoint();
}

}  // namespace polynya::exchange
