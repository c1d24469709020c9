#pragma once
#include <optional>
#include <vector>

#include "core/exchange/hub.hpp"
#include "coupler/fluid_side.hpp"
#include "coupler/solid_side.hpp"

namespace polynya::coupler {

/// The participants of a run and what is said to them, in the order of docs/protocol.md.
struct Conversation {
  exchange::Hub& hub;
  std::vector<SolidSide> solids;
  std::optional<FluidSide> fluid;

  SolidSide* find(Body body);
  const SolidSide* find(Body body) const;

  POLYNYA_STATE_WITHOUT((hub), hub, solids, fluid)
};

/// `ready` of every participant: roles, surfaces, grid, accounts.
void receive_ready(Conversation& conversation, const std::vector<std::string>& names);

/// First word to the solids: the length of the first window (s).
void begin_solids(Conversation& conversation, double step);

/// `surface` of every solid: positions at the end of the window.
void receive_surfaces(Conversation& conversation, long window);

/// What `loads` say besides the loads.
struct WindowEnd {
  long window = 0;
  double next_length = 0;  ///< s, of the next window
  bool free = false;       ///< nothing acts between the participants before its end
  bool finish = false;
  long frame = -1;         ///< number of the field frame to write now, -1 for none
  std::string checkpoint;  ///< folder of the checkpoint to write before the next window; empty: none
};

/// `loads` to every solid.
void send_loads(Conversation& conversation, const WindowEnd& end);

/// `finished` from everybody, `bye` to everybody; returns what each had to say at the end.
std::vector<std::pair<std::string, nlohmann::json>> say_goodbye(Conversation& conversation);

}  // namespace polynya::coupler
