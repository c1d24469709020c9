#include <gtest/gtest.h>

#include <cmath>

#include "block.hpp"
#include "core/continuum/explicit_solid.hpp"
#include "random_numbers.hpp"

namespace polynya::continuum {
namespace {

const Elastic elastic{900, 8.13e9, 4.44e9};

TEST(RemovedElement, TakesItsMassAndExertsNoForce) {
  auto solid = make_solid("block", tests::block({1, 1, 2}, {1e-3, 1e-3, 2e-3}), elastic);
  set_point_state(solid, 0, {{1e6, 1e6, 1e6, 0, 0, 0}});
  for (std::size_t n = 0; n < solid.node_count(); ++n) solid.velocities[3 * n] = 2;
  const auto removed = remove_element(solid, 0);
  EXPECT_DOUBLE_EQ(removed.mass, 900e-9);
  EXPECT_DOUBLE_EQ(removed.momentum[0], 2 * 900e-9);
  EXPECT_DOUBLE_EQ(removed.kinetic_energy, 2 * 900e-9);
  for (std::size_t n = 0; n < 4; ++n) EXPECT_EQ(solid.masses[n], 0);
  for (std::size_t n = 4; n < 12; ++n) EXPECT_DOUBLE_EQ(solid.masses[n], 900e-9 / 8);
  internal_forces(solid, 0.0);
  for (double f : solid.internal_force) EXPECT_NEAR(f, 0, 1e-12);
  EXPECT_EQ(solid.element.stress[0][0], 1e6);  // stays readable
  EXPECT_THROW(remove_element(solid, 0), std::invalid_argument);
}

TEST(RemovedElement, LeavesTheEnergyBalanceExact) {
  auto solid = make_solid("block", tests::block({6, 5, 7}, {6e-3, 5e-3, 7e-3}), elastic);
  tests::Random random;
  for (double& v : solid.velocities) v = random.symmetric();
  const std::vector<double> none(solid.velocities.size(), 0.0);
  double dt = 0.9 * stable_step(solid);
  internal_forces(solid, 0.0);
  advance_velocities(solid, none, 0, dt);
  const double start = energies(solid).balance();
  std::size_t living = solid.element_count();
  for (int step = 0; living > 3; ++step) {
    advance_positions(solid, dt);
    internal_forces(solid, dt);
    const double next = 0.95 * stable_step(solid);
    advance_velocities(solid, none, dt, next);
    ASSERT_NEAR(energies(solid).balance(), start, 1e-12 * start) << step;
    const auto e = static_cast<std::size_t>(random.unit() * static_cast<double>(solid.element_count()));
    if (solid.element.alive[e] != 0) {
      remove_element(solid, e);
      --living;
    }
    dt = next;
  }
  // Removal and isolated survivors leave the motion stable: no energy but what was there.
  EXPECT_LT(energies(solid).kinetic, start);
  for (std::size_t e = 0; e < solid.element_count(); ++e)
    EXPECT_LT(solid.element.alive[e] * std::abs(solid.element.stress[0][e]), 1e8);
}

TEST(StableStep, BearsALonelyElementAtItsLimit) {
  for (double factor : {0.99, 1.02}) {
    auto solid = make_solid("element", tests::block({1, 1, 1}, {1e-3, 1e-3, 1e-3}), elastic, {0, 0, 1, 0.05, 0.01});
    for (std::size_t i = 0; i < 24; ++i) solid.velocities[i] = 1e-6 * (solid.mesh.nodes[i] > 0 ? 1 : -1);  // breathing
    const std::vector<double> none(24, 0.0);
    const double dt = factor * stable_step(solid);
    for (int step = 0; step < 500; ++step) {
      advance_positions(solid, dt);
      internal_forces(solid, dt);
      advance_velocities(solid, none, dt, dt);
      if (std::abs(solid.velocities[0]) > 1) break;
    }
    const bool grew = std::abs(solid.velocities[0]) > 2e-5;
    EXPECT_EQ(grew, factor > 1);
  }
}

}  // namespace
}  // namespace polynya::continuum
