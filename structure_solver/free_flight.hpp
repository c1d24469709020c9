#pragma once
#include "core/scene/scene.hpp"
#include "structure_solver/build_vehicle.hpp"
#include "structure_solver/output.hpp"

namespace polynya::structure {

/// One step without loads: positions over `step`, which ends at `time`, forces, velocities into the step `next`.
void step_freely(VehicleBody& body, double step, double next, double time, Output& output);

/// Alone: flight without loads but gravity until the scene's end time.
void run_free_flight(BuiltVehicle& vehicle, const scene::Run& run, Output& output);

}  // namespace polynya::structure
