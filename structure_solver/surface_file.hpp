#pragma once
#include <string>

#include "structure_solver/build_vehicle.hpp"

namespace polynya::structure {

/// Writes what a program needs that moves this vehicle in our place, as JSON in SI, of the modelled part at its start:
/// "positions" [nv][3], "ids" [nv], "masses" [nv], "triangles" [nt][3] of the hull, as docs/protocol.md defines them,
/// and of the whole part "mass", "centre_of_mass" [3] and "inertia" [3][3] about it. Numbers are written to their last
/// bit. std::runtime_error when the file cannot be written.
void write_surface(const std::string& path, const BuiltVehicle& vehicle);

}  // namespace polynya::structure
