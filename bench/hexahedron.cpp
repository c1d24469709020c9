#include <cmath>

#include "bench/kernels.hpp"
#include "core/continuum/explicit_solid.hpp"

namespace polynya::bench {
namespace {

using namespace continuum;

HexMesh cube(int n, double side) {
  HexMesh mesh;
  for (int k = 0; k <= n; ++k)
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) mesh.nodes.insert(mesh.nodes.end(), {side * i / n, side * j / n, side * k / n});
  const auto node = [&](int i, int j, int k) { return i + (n + 1) * (j + (n + 1) * k); };
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        for (int z = k; z <= k + 1; ++z)
          mesh.elements.insert(mesh.elements.end(),
                               {node(i, j, z), node(i + 1, j, z), node(i + 1, j + 1, z), node(i, j + 1, z)});
  return mesh;
}

/// ns per element and cycle (positions, forces, velocities) of a 64^3 block that swings, `speed` m/s at most.
double cycle(const Law& law, double speed) {
  const int n = 64;
  auto solid = make_solid("block", cube(n, 0.064), law);
  for (std::size_t k = 0; k < solid.node_count(); ++k)
    for (std::size_t i = 0; i < 3; ++i)
      solid.velocities[3 * k + i] =
          speed * std::sin(200 * solid.mesh.nodes[3 * k + (i + 1) % 3] + static_cast<double>(i));
  const std::vector<double> none(3 * solid.node_count(), 0.0);
  const double dt = 0.5 * stable_step(solid);
  const int cycles = 4;
  const double time = shortest_time(5, [&] {
    for (int c = 0; c < cycles; ++c) {
      advance_positions(solid, dt);
      internal_forces(solid, dt);
      advance_velocities(solid, none, dt, dt);
    }
  });
  return 1e9 * time / (cycles * static_cast<double>(solid.element_count()));
}

}  // namespace

std::vector<Figure> hexahedron_elastic() {
  return {{"ice.hexahedron_elastic_ns", cycle(Elastic{900, 8.13e9, 4.44e9}, 1)}};
}

/// Fresh-water ice; the shear of the swing fractures a part of it, so that all branches of the law are taken.
std::vector<Figure> hexahedron_jh2() {
  const auto ice = johnson_holmquist_2_from_card("ice", {{"density", 900},
                                                         {"shear_modulus", 4.4444e9},
                                                         {"bulk_modulus", 8.1254e9},
                                                         {"hugoniot_elastic_limit", 5.2e9},
                                                         {"pressure_at_hugoniot_elastic_limit", 3.4381e9},
                                                         {"intact_strength_constant", 1.4},
                                                         {"intact_strength_exponent", 0.8918},
                                                         {"strain_rate_constant", 0.05},
                                                         {"fractured_strength_constant", 0.09},
                                                         {"fractured_strength_exponent", 1.2},
                                                         {"maximum_tensile_pressure", 1e6},
                                                         {"damage_constant", 0.05},
                                                         {"damage_exponent", 0.5}});
  return {{"ice.hexahedron_jh2_ns", cycle(ice, 5)}};
}

}  // namespace polynya::bench
