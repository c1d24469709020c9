#pragma once
#include <span>

#include "core/continuum/explicit_solid.hpp"

namespace polynya::continuum {

/// Adds the traction of the damped nodes to internal_force and books its work: half a step with the velocity before,
/// half a step, pending, with the one that advance_velocities is about to set.
void add_boundary_traction(ExplicitSolid& solid, std::span<const double> external_force, double dt_previous,
                           double dt_next);

}  // namespace polynya::continuum
