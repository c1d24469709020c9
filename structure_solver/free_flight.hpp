#pragma once
#include "core/scene/scene.hpp"
#include "structure_solver/build_vehicle.hpp"
#include "structure_solver/output.hpp"

namespace polynya::structure {

/// Alone: flight without loads but gravity until the scene's end time.
void run_free_flight(BuiltVehicle& vehicle, const scene::Run& run, Output& output);

}  // namespace polynya::structure
