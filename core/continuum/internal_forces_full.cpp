#include "core/continuum/internal_forces.hpp"

namespace polynya::continuum {

void internal_forces_full(ExplicitSolid& solid, double dt) {
  std::visit([&](const auto& law) { advance_all_elements<Integration::full, compute::Pack>(solid, law, dt); },
             solid.law);
}

}  // namespace polynya::continuum
