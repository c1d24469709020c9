#pragma once
#include <cstddef>

#include "core/continuum/explicit_solid.hpp"

namespace polynya::continuum {

/// Sets exposure[element] from the numbers of living elements at its nodes.
void update_exposure(ExplicitSolid& solid, std::size_t element);

}  // namespace polynya::continuum
