#include <gtest/gtest.h>

#include <cmath>

#include "block.hpp"
#include "core/continuum/explicit_solid.hpp"
#include "random_numbers.hpp"

namespace polynya::continuum {
namespace {

const Elastic elastic{900, 8.13e9, 4.44e9};

HexMesh distorted() {
  tests::Random random;
  return tests::block({6, 5, 4}, {6e-3, 5e-3, 4e-3}, [&](double* x) {
    for (int i = 0; i < 3; ++i) x[i] += 2e-4 * random.symmetric();
  });
}

TEST(Energy, BalanceHoldsToRoundOffWithChangingStepsAndForces) {
  const auto brittle = johnson_holmquist_2_from_card("ice", {{"density", 900},
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
                                                             {"damage_exponent", 0.5},
                                                             {"bulking_fraction", 1}});
  for (const Law& law : {Law(elastic), Law(brittle)}) {
    auto solid = make_solid("block", distorted(), law);
    tests::Random random;
    for (std::size_t n = 0; n < solid.node_count(); ++n)
      if (solid.mesh.nodes[3 * n] < 2e-4) solid.fixed[n] = 1;
    for (std::size_t n = 0; n < solid.node_count(); ++n)
      for (std::size_t i = 0; i < 3; ++i)
        solid.velocities[3 * n + i] = (solid.fixed[n] >> i & 1) ? 0.5 : 3 * random.symmetric();
    add_non_reflecting_boundary(solid, {{0, 0, 1}, 0});
    std::vector<double> force(3 * solid.node_count());
    double dt = 0.5 * stable_step(solid);
    internal_forces(solid, 0.0);
    advance_velocities(solid, force, 0, dt);
    const double start = energies(solid).balance();
    for (int step = 0; step < 400; ++step) {
      advance_positions(solid, dt);
      internal_forces(solid, dt);
      for (double& f : force) f = 0.2 * random.symmetric();
      const double next = (0.5 + 0.4 * random.unit()) * stable_step(solid);
      advance_velocities(solid, force, dt, next);
      dt = next;
      ASSERT_NEAR(energies(solid).balance(), start, 1e-12 * start) << "law " << law.index() << " step " << step;
    }
    EXPECT_NE(energies(solid).external_work, 0);
    EXPECT_GT(energies(solid).viscous, 0);
    EXPECT_GT(energies(solid).hourglass, 0);
  }
}

TEST(Energy, InternalEnergyIsTheElasticEnergyOfTheStress) {
  auto solid = make_solid("block", tests::block({8, 8, 8}, {8e-3, 8e-3, 8e-3}), elastic, {0, 0, 1, 0, 0});
  for (std::size_t n = 0; n < solid.node_count(); ++n) {  // a breathing, bending motion resolved by the mesh
    const double *x = &solid.mesh.nodes[3 * n], k = M_PI / 8e-3;
    solid.velocities[3 * n] = std::cos(k * x[0]);
    solid.velocities[3 * n + 1] = 0.5 * std::cos(k * x[0]) * std::cos(k * x[2]);
  }
  const std::vector<double> none(solid.velocities.size(), 0.0);
  const double dt = 0.5 * stable_step(solid);
  advance_velocities(solid, none, 0, dt);
  const double start = energies(solid).kinetic;
  double largest = 0;
  for (int step = 0; step < 300; ++step) {
    advance_positions(solid, dt);
    internal_forces(solid, dt);
    advance_velocities(solid, none, dt, dt);
    double stored = 0;
    for (std::size_t e = 0; e < solid.element_count(); ++e) {
      const auto& s = solid.element.stress;
      const double mean = (s[0][e] + s[1][e] + s[2][e]) / 3;
      double deviator = 0;
      for (int c = 0; c < 3; ++c) deviator += std::pow(s[c][e] - mean, 2);
      for (int c = 3; c < 6; ++c) deviator += 2 * s[c][e] * s[c][e];
      stored +=
          solid.element.volume[e] * (mean * mean / (2 * elastic.bulk_modulus) + deviator / (4 * elastic.shear_modulus));
    }
    const auto account = energies(solid);
    largest = std::max(largest, stored);
    ASSERT_NEAR(account.internal, stored, 2e-3 * start);
  }
  EXPECT_GT(largest, 0.5 * start);
}

}  // namespace
}  // namespace polynya::continuum
