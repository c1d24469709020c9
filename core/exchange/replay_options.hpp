#pragma once
#include <CLI/CLI.hpp>

#include "core/exchange/replay.hpp"

namespace polynya::exchange {

/// Adds --replay and what goes with it to a solver's command line, which has --connect already.
void add_replay_options(CLI::App& app, Replay& replay);

}  // namespace polynya::exchange
