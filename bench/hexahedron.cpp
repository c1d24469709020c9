#include <cmath>

#include "bench/blocks.hpp"
#include "bench/kernels.hpp"
#include "core/continuum/explicit_solid.hpp"

namespace polynya::bench {
namespace {

using namespace continuum;

struct Swing {
  ExplicitSolid solid;
  std::vector<double> none;
  double step;
};

/// A block of n^3 elements that swings, `speed` m/s at most.
Swing swing(const Law& law, int n, double speed) {
  Swing block{make_solid("block", in_blocks(cube(n, 1e-3 * n)), law), {}, 0};
  ExplicitSolid& solid = block.solid;
  for (std::size_t k = 0; k < solid.node_count(); ++k)
    for (std::size_t i = 0; i < 3; ++i)
      solid.velocities[3 * k + i] =
          speed * std::sin(200 * solid.mesh.nodes[3 * k + (i + 1) % 3] + static_cast<double>(i));
  block.none.assign(3 * solid.node_count(), 0.0);
  block.step = 0.5 * stable_step(solid);
  return block;
}

/// Positions, forces, velocities, `cycles` times.
void advance(Swing& block, int cycles) {
  for (int c = 0; c < cycles; ++c) {
    advance_positions(block.solid, block.step);
    internal_forces(block.solid, block.step);
    advance_velocities(block.solid, block.none, block.step, block.step);
  }
}

constexpr int cycles = 4;

/// ns per element and cycle of n^3 elements, the shortest of `repetitions`.
double cycle(const Law& law, int n, double speed, int repetitions) {
  Swing block = swing(law, n, speed);
  const double time = shortest_time(repetitions, [&] { advance(block, cycles); });
  return 1e9 * time / (cycles * static_cast<double>(block.solid.element_count()));
}

const Elastic elastic_ice{900, 8.13e9, 4.44e9};

}  // namespace

std::vector<Figure> hexahedron_elastic() {
  return {{"ice.hexahedron_elastic_ns", cycle(elastic_ice, 64, 1, 5)}};
}

/// The elastic kernel on about 1e5, 1e6 and 4e6 elements: the exponent of the time over the number, of the two ends (1:
/// linear), and what a second thread gains at 1e6.
std::vector<Figure> hexahedron_scaling() {
  const int sides[] = {46, 100, 159};
  const double small = cycle(elastic_ice, sides[0], 1, 5), middle = cycle(elastic_ice, sides[1], 1, 3),
               large = cycle(elastic_ice, sides[2], 1, 2);
  const double numbers = 3 * std::log(static_cast<double>(sides[2]) / sides[0]);
  Swing block = swing(elastic_ice, sides[1], 1);
  return {{"ice.hexahedron_scaling_1e5_ns", small},
          {"ice.hexahedron_scaling_1e6_ns", middle},
          {"ice.hexahedron_scaling_4e6_ns", large},
          {"ice.hexahedron_scaling_exponent", 1 + std::log(large / small) / numbers},
          {"ice.hexahedron_two_threads_speedup", speedup_of_two_threads(5, [&] { advance(block, cycles); })}};
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
  return {{"ice.hexahedron_jh2_ns", cycle(ice, 64, 5, 5)}};
}

}  // namespace polynya::bench
