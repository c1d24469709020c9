#pragma once
#include <cstddef>

#include "core/continuum/explicit_solid.hpp"

namespace polynya::continuum {

/// Of an element that has a node with seven neighbours.
inline constexpr double exposure_amid_others = 0.25;

/// Sets exposure[element] from the numbers of living elements at its nodes, and what its pack has in common.
void update_exposure(ExplicitSolid& solid, std::size_t element);

}  // namespace polynya::continuum
