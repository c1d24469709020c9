#pragma once
#include <cstdint>

#include "core/continuum/explicit_solid.hpp"

namespace polynya::ice {

/// Gives every element a damage to start with, drawn evenly from 0 to `largest` in the order of the mesh: ice is weaker
/// by about as much there, in tension and under pressure. The same seed gives the same flaws on any machine.
void sow_flaws(continuum::ExplicitSolid& ice, double largest, std::uint64_t seed);

}  // namespace polynya::ice
