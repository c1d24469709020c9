#pragma once
#include <cstddef>
#include <span>

#include "core/continuum/explicit_solid.hpp"

namespace polynya::continuum {

/// automatic: Newton's method up to most_nodes_for_newton nodes, dynamic relaxation above and where Newton finds none.
enum class EquilibriumMethod { automatic, newton, relaxation };

/// Where the factorised stiffness of a plate begins to cost more than relaxation (docs/theory.md).
inline constexpr std::size_t most_nodes_for_newton = 3000;

/// How a body came into equilibrium. Without loads: all zero.
struct EquilibriumReport {
  EquilibriumMethod method = EquilibriumMethod::automatic;  ///< newton or relaxation once it was asked for
  int iterations = 0;                                       ///< corrections of Newton's method, steps of relaxation
  int factorisations = 0;                                   ///< of the stiffness
  double imbalance = 0;                                     ///< N, largest component of a nodal force not balanced
};

/// Gives a body the stress that balances loads ([n][3], N) and the inertia of the rigid acceleration they cause: it
/// starts under them without a wave. Positions and velocities stay, the reference shape is moved instead: the shape the
/// body has is its shape under these loads. Energies count from this state.
///
/// newton: newton_equilibrium.hpp, to 1e-10 of the largest load on a node. relaxation: dynamic relaxation with kinetic
/// damping (Cundall 1976; Barnes 1999, J. Int. Assoc. Shell Spatial Struct. 40:3), to 1e-6: a copy at rest swings under
/// the loads and is stopped at every maximum of its kinetic energy. Both balance the loads at the present positions;
/// stress follows from one static step there (static_step.hpp). Neither goes beyond what rounding of positions can
/// hide. Throws std::runtime_error "no equilibrium: ..." if the forces do not come to balance.
EquilibriumReport bring_into_equilibrium(ExplicitSolid& solid, std::span<const double> loads,
                                         EquilibriumMethod method = EquilibriumMethod::automatic);

}  // namespace polynya::continuum
