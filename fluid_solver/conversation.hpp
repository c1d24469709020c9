#pragma once
#include "core/exchange/participant.hpp"
#include "core/results/checkpoint_file.hpp"
#include "core/scene/scene.hpp"
#include "fluid_solver/fluid.hpp"
#include "fluid_solver/output.hpp"

namespace polynya::fluid {

/// Plays the fluid's part of docs/protocol.md, section 5, to the end.
void run_coupled(const scene::Scene& scene, Fluid& fluid, exchange::Participant& coupler, Output& output,
                 const results::Checkpoints& checkpoints = {});

}  // namespace polynya::fluid
