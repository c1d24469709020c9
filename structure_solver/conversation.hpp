#pragma once
#include "core/exchange/participant.hpp"
#include "core/results/checkpoint_file.hpp"
#include "structure_solver/build_vehicle.hpp"
#include "structure_solver/output.hpp"

namespace polynya::structure {

/// Coupled: windows as docs/protocol.md says, until the coupler says `finish`. Throws what Participant throws.
/// step_factor: fraction of the stable step that it takes in free windows.
void run_coupled(BuiltVehicle& vehicle, double step_factor, exchange::Participant& coupler, Output& output,
                 const results::Checkpoints& checkpoints = {});

}  // namespace polynya::structure
