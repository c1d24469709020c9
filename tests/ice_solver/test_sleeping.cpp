// Ice of which a part sleeps: its bits after a checkpoint and with more threads, its books.
#include <gtest/gtest.h>
#include <omp.h>

#include "tests/core/results/state_bits.hpp"
#include "tests/ice_solver/ice_bodies.hpp"

namespace polynya::ice {
namespace {

using namespace testing;
using polynya::testing::carry_over;
using polynya::testing::state_difference;

/// A strip of brittle ice that is held at none of its sides, one corner of which flies up.
IceBody strip(double threshold) {
  IceOptions options = block_options(64, 12, 3, 0.002, brittle_ice());
  options.conversion = true;
  options.critical_strain = 0.03;
  options.sides = Sides::non_reflecting;
  options.sleeping_threshold = threshold;
  IceBody ice = make_ice(options);
  for (std::size_t n = 0; n < ice.solid.node_count(); ++n) {
    const double* x = &ice.solid.positions[3 * n];
    if (std::hypot(x[0], x[1]) < 0.005) ice.solid.velocities[3 * n + 2] = 60;
  }
  return ice;
}

double advance_by(IceBody& ice, double dt, int steps) {
  for (int n = 0; n < steps; ++n) dt = advance(ice, dt);
  return dt;
}

TEST(IceSleeping, GoesOnWithTheSameBitsAfterACheckpointAndWithAnotherNumberOfThreads) {
  IceBody whole = strip(1e-8);
  double dt = start(whole);
  dt = advance_by(whole, dt, 20);
  ASSERT_FALSE(whole.solid.sleeping.all_awake);
  ASSERT_GT(whole.solid.sleeping.elements_awake, 0u);
  const std::size_t awake = whole.solid.sleeping.elements_awake;
  IceBody resumed = strip(1e-8);
  carry_over(whole, resumed);
  ASSERT_EQ(state_difference(whole, resumed), "");
  advance_by(whole, dt, 30);
  const int threads = omp_get_max_threads();
  omp_set_num_threads(threads == 1 ? 2 : 1);
  advance_by(resumed, dt, 30);
  omp_set_num_threads(threads);
  EXPECT_EQ(state_difference(whole, resumed), "");
  EXPECT_GT(whole.solid.sleeping.elements_awake, awake);
}

TEST(IceSleeping, BooksOfEnergyAndMomentumClose) {
  IceBody ice = strip(1e-6), awake = strip(0);
  double dt = start(ice), dt_awake = start(awake);
  const Account first = account_of(ice);
  advance_by(ice, dt, 40);
  advance_by(awake, dt_awake, 40);
  const Account last = account_of(ice), reference = account_of(awake);
  EXPECT_LT(ice.solid.sleeping.share_awake(), 0.95);
  EXPECT_GT(ice.particles.count(), 0u);
  EXPECT_EQ(ice.particles.count(), awake.particles.count());
  // Without particles the balance holds to rounding (SolidSleeping); particles miss the same in both.
  EXPECT_NEAR(last.balance(), reference.balance(), 1e-9 * first.kinetic);
  for (std::size_t c = 0; c < 3; ++c)
    EXPECT_NEAR(last.momentum[c] - last.boundary_impulse[c], first.momentum[c] - first.boundary_impulse[c],
                1e-12 * last.mass * 60);
  EXPECT_NEAR(last.kinetic, reference.kinetic, 1e-6 * reference.kinetic);
  const double c = continuum::longitudinal_wave_speed(ice.solid.law);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(last.momentum[i], reference.momentum[i], 1e-6 * c * last.mass);
}

}  // namespace
}  // namespace polynya::ice
