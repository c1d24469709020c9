#pragma once
#include <span>

#include "core/continuum/explicit_solid.hpp"

namespace polynya::continuum {

/// What Newton's method found.
struct NewtonResult {
  ExplicitSolid solid;     ///< its mesh the shape without stress, its positions those of the start
  int iterations = 0;      ///< corrections
  int factorisations = 0;  ///< of the stiffness
  double imbalance = 0;    ///< N, largest force component that is not balanced
};

/// The shape without stress whose elements balance `loads` ([n][3], N, without rigid acceleration) at the present
/// positions, to `enough` (N): Newton's method with a line search (KINSOL; Hindmarsh et al. 2005), the stiffness
/// (stiffness.hpp) factorised by Eigen's sparse L D L^T and kept while each correction leaves less than a tenth.
/// Throws std::runtime_error "no equilibrium: ..." where it does not converge, or where the body can move without
/// straining in another way than as a whole.
NewtonResult newton_equilibrium(const ExplicitSolid& solid, std::span<const double> loads, double enough);

}  // namespace polynya::continuum
