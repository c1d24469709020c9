#include "core/continuum/internal_forces.hpp"

namespace polynya::continuum {

void internal_forces_scalar(ExplicitSolid& solid, double dt) {
  std::visit(
      [&](const auto& law) {
        if (solid.numerics.integration == Integration::full)
          advance_all_elements<Integration::full, double>(solid, law, dt);
        else
          advance_all_elements<Integration::one_point, double>(solid, law, dt);
      },
      solid.law);
}

}  // namespace polynya::continuum
