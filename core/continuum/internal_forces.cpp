#include "core/continuum/internal_forces.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
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

void stage_nodes(const ExplicitSolid& solid, std::size_t chunk, ChunkNodes& nodes) {
  const ElementChunks& chunks = solid.chunks;
  const std::int32_t* list = &chunks.nodes[chunks.start[chunk]];
  const auto count = static_cast<std::size_t>(chunks.start[chunk + 1] - chunks.start[chunk]);
  if (nodes.position.size() < count)
    for (auto* records : {&nodes.position, &nodes.velocity, &nodes.force}) records->resize(count);
  constexpr std::size_t ahead = 64;
  for (std::size_t k = 0; k < count; ++k) {
    const std::int32_t later = 3 * list[std::min(k + ahead, count - 1)];
    __builtin_prefetch(&solid.positions[later]);
    __builtin_prefetch(&solid.velocities[later]);
    const double *x = &solid.positions[3 * list[k]], *v = &solid.velocities[3 * list[k]];
    nodes.position[k].value = {0.125 * x[0], 0.125 * x[1], 0.125 * x[2], 0};
    nodes.velocity[k].value = {0.125 * v[0], 0.125 * v[1], 0.125 * v[2], 0};
    nodes.force[k].value = {};
  }
}

void hand_out_forces(const ChunkNodes& nodes, std::size_t chunk, ExplicitSolid& solid) {
  const ElementChunks& chunks = solid.chunks;
  const std::int32_t* list = &chunks.nodes[chunks.start[chunk]];
  const auto count = static_cast<std::size_t>(chunks.start[chunk + 1] - chunks.start[chunk]);
  const auto alone = static_cast<std::size_t>(chunks.first_shared[chunk] - chunks.start[chunk]);
  for (std::size_t k = 0; k < alone; ++k)
    for (std::size_t i = 0; i < 3; ++i) solid.internal_force[3 * list[k] + i] = nodes.force[k].value[i];
  std::copy(nodes.force.begin() + alone, nodes.force.begin() + count,
            solid.force_shares.begin() + chunks.first_share[chunk]);
}

void add_shared_forces(ExplicitSolid& solid) {
  const ElementChunks& chunks = solid.chunks;
  compute::for_chunks(chunks.shared_nodes.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      if (!solid.sleeping.all_awake && solid.sleeping.node_asleep[chunks.shared_nodes[n]] == 2) continue;
      std::array<double, 3> sum{};
      for (std::int32_t k = chunks.share_start[n]; k < chunks.share_start[n + 1]; ++k)
        for (std::size_t i = 0; i < 3; ++i) sum[i] += solid.force_shares[chunks.share_of[k]].value[i];
      for (std::size_t i = 0; i < 3; ++i) solid.internal_force[3 * chunks.shared_nodes[n] + i] = sum[i];
    }
  });
}

void internal_forces(ExplicitSolid& solid, double dt) {
  if (solid.numerics.integration == Integration::full) return internal_forces_full(solid, dt);
  std::visit([&](const auto& law) { advance_all_elements<Integration::one_point, compute::Pack>(solid, law, dt); },
             solid.law);
}

}  // namespace polynya::continuum
