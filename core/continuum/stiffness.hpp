#pragma once
#include <Eigen/SparseCore>
#include <cstdint>
#include <span>

#include "core/continuum/static_step.hpp"

namespace polynya::continuum {

/// Lower triangle of the tangent stiffness, N/m, of a body that one static step (static_step.hpp) leads from its
/// reference shape by `displacement` to `present` (both [n][3], m). unknown_of: [3 n], row of a component, or -1 where
/// it is held.
///
/// By differences of the elements' own forces, one displaced node at a time, all elements at once and each alone, with
/// its own nodes. So laws, hourglass forces and points are those of the run, and plastic flow gives the tangent that is
/// consistent with the step (Simo & Taylor 1985). Made symmetric and free of what rigid motions would do: the
/// difference's own error (1e-6) then stays a part of each strain and cannot swamp the small stiffness of bending.
Eigen::SparseMatrix<double> tangent_stiffness(const ExplicitSolid& solid, const RememberedState& start,
                                              std::span<const double> present, std::span<const double> displacement,
                                              std::span<const std::int32_t> unknown_of);

}  // namespace polynya::continuum
