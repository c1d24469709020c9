#pragma once
#include <span>
#include <vector>

#include "core/continuum/explicit_solid.hpp"

namespace polynya::continuum {

/// Gives a free elastic body the stress that balances loads ([n][3], N) and the inertia of the rigid acceleration they
/// cause: it starts under them without a wave. Positions and velocities stay, the reference shape is moved instead: the
/// shape the body has is its shape under these loads. Energies count from this state.
///
/// By dynamic relaxation with kinetic damping (Cundall 1976; Barnes 1999, J. Int. Assoc. Shell Spatial Struct. 40:3):
/// a copy at rest swings under the loads and is stopped at every maximum of its kinetic energy.
/// Throws std::runtime_error if the forces do not come to balance.
void bring_into_equilibrium(ExplicitSolid& solid, std::span<const double> loads);

/// Loads less the inertia of the rigid motion that they and the held components allow ([n][3], N): they accelerate the
/// body as a whole in no direction and about no axis.
std::vector<double> without_rigid_acceleration(const ExplicitSolid& solid, std::span<const double> loads);

}  // namespace polynya::continuum
