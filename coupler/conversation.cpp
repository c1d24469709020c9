#include "coupler/conversation.hpp"

#include "core/exchange/errors.hpp"

namespace polynya::coupler {

SolidSide* Conversation::find(Body body) {
  for (SolidSide& side : solids)
    if (side.body == body) return &side;
  return nullptr;
}

const SolidSide* Conversation::find(Body body) const {
  return const_cast<Conversation*>(this)->find(body);
}

namespace {

Body body_named(const std::string& name, const std::string& participant) {
  if (name == "vehicle") return Body::vehicle;
  if (name == "ice") return Body::ice;
  throw exchange::ProtocolError("participant '" + participant + "': header 'body' is '" + name +
                                "', must be 'vehicle' or 'ice'");
}

}  // namespace

void receive_ready(Conversation& conversation, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    const exchange::Message ready = conversation.hub.receive(name, "ready");
    const std::string role = ready.header.value("role", std::string{});
    if (role == "solid") {
      SolidSide side;
      side.name = name;
      side.body = body_named(ready.header.value("body", std::string{}), name);
      if (conversation.find(side.body))
        throw exchange::ProtocolError("participant '" + name + "': another participant is this body already");
      read_ready(side, ready);
      conversation.solids.push_back(std::move(side));
    } else if (role == "fluid") {
      conversation.fluid = read_fluid_ready(name, ready);
    } else {
      throw exchange::ProtocolError("participant '" + name + "': header 'role' is '" + role +
                                    "', must be 'solid' or 'fluid'");
    }
  }
}

void begin_solids(Conversation& conversation, double step) {
  for (SolidSide& side : conversation.solids) {
    exchange::Message begin("begin");
    begin.header["time"] = 0.0;
    begin.header["step"] = step;
    if (!side.start_force.empty()) side.fluid_force = side.start_force;
    add_loads(begin, side);
    conversation.hub.send(side.name, std::move(begin));
  }
}

void receive_surfaces(Conversation& conversation, long window) {
  for (SolidSide& side : conversation.solids) {
    const exchange::Message surface = conversation.hub.receive(side.name, "surface");
    if (surface.header.value("window", -1L) != window)
      throw exchange::ProtocolError("participant '" + side.name + "': 'surface' of window " +
                                    std::to_string(surface.header.value("window", -1L)) + " where window " +
                                    std::to_string(window) + " is due");
    read_surface(side, surface);
  }
}

void send_loads(Conversation& conversation, const WindowEnd& end) {
  for (SolidSide& side : conversation.solids) {
    exchange::Message loads("loads");
    add_loads(loads, side);
    if (const int threads = std::exchange(side.new_threads, 0)) loads.header["threads"] = threads;
    loads.header["window"] = end.window;
    loads.header["next_step"] = end.next_length;
    loads.header["finish"] = end.finish;
    loads.header["frame"] = end.frame;
    if (end.free) loads.header["free"] = true;
    if (!end.checkpoint.empty()) loads.header["checkpoint"] = end.checkpoint;
    conversation.hub.send(side.name, std::move(loads));
  }
}

std::vector<std::pair<std::string, nlohmann::json>> say_goodbye(Conversation& conversation) {
  std::vector<std::string> names;
  for (const SolidSide& side : conversation.solids) names.push_back(side.name);
  if (conversation.fluid) names.push_back(conversation.fluid->name);
  std::vector<std::pair<std::string, nlohmann::json>> last_words;
  for (const std::string& name : names) {
    exchange::Message finished = conversation.hub.receive(name, "finished");
    last_words.emplace_back(name, std::move(finished.header));
    conversation.hub.send(name, exchange::Message("bye"));
  }
  return last_words;
}

}  // namespace polynya::coupler
