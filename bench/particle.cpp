#include "bench/kernels.hpp"
#include "ice_solver/pair_sums.hpp"
#include "ice_solver/particles.hpp"

namespace polynya::bench {
namespace {

using namespace ice;

constexpr double spacing = 0.002;
constexpr int side = 30;
constexpr double smoothing = 1.315 * spacing;  // 76 neighbours within 2 h on a cubic lattice
constexpr int steps_per_list = 20;             // as in the water exit: 16,830 steps, 616 lists

/// A cube of broken ice that swings a little.
Particles cube(const continuum::Law& law) {
  Particles particles;
  for (int k = 0; k < side; ++k)
    for (int j = 0; j < side; ++j)
      for (int i = 0; i < side; ++i) {
        ParticleBirth birth;
        birth.element = static_cast<std::int64_t>(particles.count());
        birth.mass = 900 * spacing * spacing * spacing;
        birth.smoothing_length = smoothing;
        birth.position = {i * spacing, j * spacing, k * spacing};
        birth.velocity = {0.1 * ((i * 7 + j) % 5), 0.1 * ((j * 3 + k) % 5), 0.1 * ((k * 11 + i) % 5)};
        birth.state.damage = 0.5;
        add_particle(particles, law, birth);
      }
  return particles;
}

continuum::JohnsonHolmquist2 fresh_ice() {
  return continuum::johnson_holmquist_2_from_card("ice", {{"density", 900},
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
                                                          {"damage_constant", 0.1},
                                                          {"damage_exponent", 0.5}});
}

}  // namespace

/// Velocity gradients, stress by JH-2 and forces of one step, and a step's share of a neighbour list.
std::vector<Figure> particle() {
  const continuum::Law law = fresh_ice();
  Particles particles = cube(law);
  Points none;
  NeighbourList list;
  PairSums sums;
  const auto build = [&] { list.build(particles.points, none, {}, 0.2 * smoothing); };
  const double listing = shortest_time(3, build);
  const double step = shortest_time(5, [&] {
    sums.velocity_gradients(list, particles.points, none, particles.velocity_gradient, particles.approach_speed);
    update_particle_stress(particles, law, 1e-8);
    sums.forces(list, particles.points, none, {.sound_speed = 3850});
  });
  const double count = static_cast<double>(particles.count());
  return {{"ice.particle_ns", 1e9 * (step + listing / steps_per_list) / count},
          {"ice.particle_list_ns", 1e9 * listing / count},
          {"ice.particle_neighbours", static_cast<double>(list.entries()) / count}};
}

}  // namespace polynya::bench
