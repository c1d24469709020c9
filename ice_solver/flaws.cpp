#include "ice_solver/flaws.hpp"

#include <random>

namespace polynya::ice {

void sow_flaws(continuum::ExplicitSolid& ice, double largest, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  for (std::size_t e = 0; e < ice.element_count(); ++e) {
    // Not std::uniform_real_distribution, whose numbers the standard leaves open.
    const double damage = largest * 0x1p-53 * static_cast<double>(engine() >> 11);
    ice.element.damage[e] = damage;
    for (auto& point : ice.points) point.damage[e] = damage;
  }
}

}  // namespace polynya::ice
