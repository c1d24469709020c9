#include <gtest/gtest.h>

#include <cmath>

#include "block.hpp"
#include "core/continuum/explicit_solid.hpp"

namespace polynya::continuum {
namespace {

const Elastic material{2700, 7e10, 2.7e10};
constexpr double length = 0.1;

/// A row of n cubes along x.
ExplicitSolid bar(int n, bool laterally_fixed) {
  const double side = length / n;
  auto solid = make_solid("bar", tests::block({n, 1, 1}, {length, side, side}), material);
  if (laterally_fixed) solid.fixed.assign(solid.node_count(), 0b110);
  return solid;
}

/// Time at which the middle of the bar reaches half the speed of a step wave that enters at x = 0, by interpolation.
double arrival(ExplicitSolid solid, double wave_speed) {
  const double area = std::pow(length / static_cast<double>(solid.element_count()), 2), pressure = 1e6;
  std::vector<double> push(3 * solid.node_count(), 0.0);
  std::size_t probe = 0;
  for (std::size_t n = 0; n < solid.node_count(); ++n) {
    if (solid.mesh.nodes[3 * n] == 0) push[3 * n] = pressure * area / 4;
    if (std::abs(solid.mesh.nodes[3 * n] - length / 2) < 1e-9) probe = n;
  }
  const double half = 0.5 * pressure / (material.density * wave_speed);
  const double dt = 0.9 * stable_step(solid);
  advance_velocities(solid, push, 0, dt);
  double before = 0;
  while (solid.time < length / wave_speed) {
    advance_positions(solid, dt);
    internal_forces(solid, dt);
    advance_velocities(solid, push, dt, dt);
    const double now = solid.velocities[3 * probe];  // at time + dt/2
    if (now > half) return solid.time + dt / 2 - dt * (now - half) / (now - before);
    before = now;
  }
  return 0;
}

TEST(Waves, PlaneWaveTravelsAtTheLongitudinalSpeedAndConverges) {
  const double speed = std::sqrt((material.bulk_modulus + 4.0 / 3.0 * material.shear_modulus) / material.density);
  const double exact = 0.5 * length / speed;
  const double coarse = std::abs(arrival(bar(50, true), speed) / exact - 1);
  const double fine = std::abs(arrival(bar(200, true), speed) / exact - 1);
  EXPECT_LT(coarse, 0.01);
  EXPECT_LT(fine, 0.003);
  EXPECT_LT(fine, 0.5 * coarse);
}

TEST(Waves, SlenderRodCarriesWavesAtTheRodSpeed) {
  const double young =
      9 * material.bulk_modulus * material.shear_modulus / (3 * material.bulk_modulus + material.shear_modulus);
  const double speed = std::sqrt(young / material.density);
  const double exact = 0.5 * length / speed;
  EXPECT_NEAR(arrival(bar(200, false), speed) / exact, 1, 0.01);
}

/// Energy left of a smooth pulse after it has met the boundary at x = length, as a fraction. component: 0 longitudinal,
/// 1 shear.
double reflected(int component) {
  const int n = 200;
  auto solid = bar(n, false);
  solid.fixed.assign(solid.node_count(), static_cast<std::uint8_t>(0b111 & ~(1 << component)));
  add_non_reflecting_boundary(solid, {{1, 0, 0}, length});
  add_non_reflecting_boundary(solid, {{1, 0, 0}, 0});
  for (std::size_t k = 0; k < solid.node_count(); ++k)
    solid.velocities[3 * k + component] = std::exp(-std::pow((solid.mesh.nodes[3 * k] - length / 2) / 6e-3, 2));
  const std::vector<double> none(3 * solid.node_count(), 0.0);
  const double dt = 0.8 * stable_step(solid);
  advance_velocities(solid, none, 0, dt);
  const double start = energies(solid).kinetic;
  const double speed = component == 0
                           ? std::sqrt((material.bulk_modulus + 4.0 / 3.0 * material.shear_modulus) / material.density)
                           : std::sqrt(material.shear_modulus / material.density);
  while (solid.time < 0.95 * length / speed) {
    advance_positions(solid, dt);
    internal_forces(solid, dt);
    advance_velocities(solid, none, dt, dt);
  }
  const auto account = energies(solid);
  EXPECT_NEAR(account.balance(), start, 1e-12 * start);
  EXPECT_GT(account.boundary_flux, 0.9 * start);
  return (account.kinetic + account.internal) / start;
}

TEST(NonReflectingBoundary, LetsALongitudinalPulseLeave) {
  EXPECT_LT(reflected(0), 0.01);
}
TEST(NonReflectingBoundary, LetsAShearPulseLeave) {
  EXPECT_LT(reflected(1), 0.01);
}

TEST(NonReflectingBoundary, HoldsAPrestressedColumnInPlace) {
  const int n = 10;
  auto solid = bar(n, true);
  add_non_reflecting_boundary(solid, {{1, 0, 0}, 0});
  add_non_reflecting_boundary(solid, {{1, 0, 0}, length});
  for (std::size_t e = 0; e < solid.element_count(); ++e) set_point_state(solid, e, {{-2e6, -1e6, -1e6, 0, 0, 0}});
  const std::vector<double> none(3 * solid.node_count(), 0.0);
  internal_forces(solid, 0.0);
  hold_boundary_at_rest(solid, none);
  const double dt = 0.9 * stable_step(solid);
  advance_velocities(solid, none, 0, dt);
  for (int step = 0; step < 100000; ++step) {
    advance_positions(solid, dt);
    internal_forces(solid, dt);
    advance_velocities(solid, none, dt, dt);
  }
  for (std::size_t i = 0; i < solid.positions.size(); ++i)
    EXPECT_NEAR(solid.positions[i], solid.mesh.nodes[i], 1e-9 * length);
  EXPECT_NEAR(solid.element.stress[0][n / 2], -2e6, 1);
}

}  // namespace
}  // namespace polynya::continuum
