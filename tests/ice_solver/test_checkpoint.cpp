// Ice that was saved and loaded goes on with the same bits: elements with damage, particles with bonds, lists of
// neighbours with a skin, contact with itself, conversion in mid course.
#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>

#include "tests/core/results/state_bits.hpp"
#include "tests/ice_solver/ice_bodies.hpp"

namespace polynya::ice {
namespace {

using namespace testing;
using polynya::testing::carry_over;
using polynya::testing::state_difference;

constexpr double size = 0.002;

/// A brittle plate, a quarter of it modelled, whose middle is thrown up: it breaks and becomes particles, step by step.
IceOptions breaking_plate(continuum::Integration integration = continuum::Integration::one_point) {
  IceOptions options = block_options(8, 8, 4, size, brittle_ice());
  options.conversion = true;
  options.critical_strain = 0.03;
  options.own_contact = true;
  options.contact_friction = 0.3;
  options.planes = {true, true};
  options.sides = Sides::non_reflecting;
  options.gravity = 9.81;
  options.numerics.integration = integration;
  return options;
}

void throw_middle(IceBody& ice) {
  for (std::size_t n = 0; n < ice.solid.node_count(); ++n) {
    const double* x = &ice.solid.positions[3 * n];
    const double r = std::hypot(x[0], x[1]) / (3 * size);
    ice.solid.velocities[3 * n + 2] = 90 * std::exp(-r * r);
  }
}

double advance_by(IceBody& ice, double dt, int steps) {
  for (int n = 0; n < steps; ++n) dt = advance(ice, dt);
  return dt;
}

/// As often as asked for, from the first conversions on.
void expect_same_course(int steps_before, int steps_after,
                        continuum::Integration integration = continuum::Integration::one_point) {
  IceBody whole = make_ice(breaking_plate(integration));
  throw_middle(whole);
  double dt = start(whole);
  while (whole.particles.count() == 0) dt = advance(whole, dt);
  dt = advance_by(whole, dt, steps_before);
  const std::size_t particles = whole.particles.count();
  IceBody resumed = make_ice(breaking_plate(integration));
  carry_over(whole, resumed);
  ASSERT_EQ(state_difference(whole, resumed), "");
  advance_by(whole, dt, steps_after);
  const int threads = omp_get_max_threads();
  omp_set_num_threads(threads == 1 ? 2 : 1);
  advance_by(resumed, dt, steps_after);
  omp_set_num_threads(threads);
  EXPECT_EQ(state_difference(whole, resumed), "");
  EXPECT_EQ(account_values(account_of(whole)), account_values(account_of(resumed)));
  EXPECT_GT(whole.particles.count(), particles);
  EXPECT_GT(whole.solid.element_count(), particles);
}

TEST(Checkpoint, IceGoesOnWithTheSameBitsWhenItsFirstElementHasJustBecomeAParticle) {
  expect_same_course(0, 60);
}
TEST(Checkpoint, IceGoesOnWithTheSameBitsBetweenTwoBuildsOfItsListOfNeighbours) {
  expect_same_course(37, 60);
}

TEST(Checkpoint, FullyIntegratedIceGoesOnWithTheSameBits) {
  expect_same_course(10, 40, continuum::Integration::full);
}

TEST(Checkpoint, ElasticIceGoesOnWithTheSameBits) {
  IceOptions options = block_options(6, 3, 3, size);
  IceBody whole = make_ice(options), resumed = make_ice(options);
  throw_middle(whole);
  double dt = start(whole);
  dt = advance_by(whole, dt, 50);
  carry_over(whole, resumed);
  advance_by(whole, dt, 50);
  advance_by(resumed, dt, 50);
  EXPECT_EQ(state_difference(whole, resumed), "");
}

}  // namespace
}  // namespace polynya::ice
