#include "core/continuum/internal_forces.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/continuum/bad_element.hpp"

namespace polynya::continuum {

void report_bad_element(const ExplicitSolid& solid, std::size_t first_pack) {
  const ElementState& element = solid.element;
  const std::size_t first = first_pack * compute::pack_width;
  // The volume may be positive again at the end of a step through inversion: then the pack's first living lane is
  // named.
  std::size_t bad = solid.element_count();
  for (std::size_t e = first; e < first + compute::pack_width && e < solid.element_count(); ++e) {
    if (element.alive[e] == 0) continue;
    const double trace = element.stress[0][e] + element.stress[1][e] + element.stress[2][e];
    if (bad == solid.element_count()) bad = e;
    if (!(element.volume[e] > 0) || !std::isfinite(trace)) {
      bad = e;
      break;
    }
  }
  const auto centre = element_centre(solid, bad);
  char text[512];
  std::snprintf(text, sizeof text,
                "%s: element %zu is inverted or its stress is not finite: centre (%.6g, %.6g, %.6g) m, time %.9g s, "
                "volume %.6g of %.6g m^3, mean stress %.6g Pa, damage %.4g, plastic strain %.4g",
                solid.name.c_str(), bad, centre[0], centre[1], centre[2], solid.time, element.volume[bad],
                element.reference_volume[bad],
                (element.stress[0][bad] + element.stress[1][bad] + element.stress[2][bad]) / 3, element.damage[bad],
                element.plastic_strain[bad]);
  throw BadElement(text, bad, centre, solid.time);
}

void gather_forces(ExplicitSolid& solid) {
  const double* from = solid.element_force.data();
  constexpr std::size_t w = compute::pack_width;
  compute::for_chunks(solid.node_count(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      double x = 0, y = 0, z = 0;
      for (std::int32_t k = solid.gather_start[n]; k < solid.gather_start[n + 1]; ++k) {
        const double* force = from + solid.gather_slot[k];
        x += force[0];
        y += force[w];
        z += force[2 * w];
      }
      solid.internal_force[3 * n] = x;
      solid.internal_force[3 * n + 1] = y;
      solid.internal_force[3 * n + 2] = z;
    }
  });
}

void internal_forces(ExplicitSolid& solid, double dt) {
  std::visit([&](const auto& law) { advance_all_elements<compute::Pack>(solid, law, dt); }, solid.law);
  gather_forces(solid);
  solid.step_limit = stable_step(solid);
}

}  // namespace polynya::continuum
