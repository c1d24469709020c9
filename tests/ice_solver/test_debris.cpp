#include <gtest/gtest.h>

#include "tests/ice_solver/ice_bodies.hpp"

namespace polynya::ice {
namespace {

using namespace testing;

/// A block that flies and turns, of which a corner breaks off.
IceBody broken_block(Debris debris) {
  IceOptions options = block_options(3, 3, 3, 0.01);
  options.debris = debris;
  IceBody ice = make_ice(options);
  for (std::size_t n = 0; n < ice.solid.node_count(); ++n) {
    ice.solid.velocities[3 * n] = 2 - 20 * ice.solid.positions[3 * n + 1];
    ice.solid.velocities[3 * n + 1] = 20 * ice.solid.positions[3 * n];
  }
  double dt = start(ice);
  for (int i = 0; i < 5; ++i) dt = advance(ice, dt);
  convert_elements(ice, std::vector<std::int32_t>{0, 1, 9});
  for (int i = 0; i < 20; ++i) dt = advance(ice, dt);
  return ice;
}

TEST(FreeMasses, FlyOnAsTheyWereAndFeelNothing) {
  const IceBody ice = broken_block(Debris::free_masses);
  ASSERT_EQ(ice.particles.count(), 3u);
  EXPECT_NEAR(mass_of(ice), 900 * 27e-6, 1e-15);
  const auto p = momentum_of(ice);
  EXPECT_NEAR(p[0], 900 * 27e-6 * (2 - 20 * 0.015), 1e-12);
  EXPECT_NEAR(p[1], 900 * 27e-6 * 20 * 0.015, 1e-12);
  for (std::size_t k = 0; k < 9; ++k) EXPECT_EQ(ice.particles.points.force[k], 0);
}

TEST(DeletedElements, TakeTheirMassAndMotionWithThem) {
  IceBody whole = broken_block(Debris::free_masses);
  const IceBody ice = broken_block(Debris::none);
  EXPECT_EQ(ice.particles.count(), 0u);
  const Account a = account_of(ice), b = account_of(whole);
  EXPECT_NEAR(a.mass, 24.0 / 27 * b.mass, 1e-15);
  EXPECT_NEAR(a.broken_mass, b.broken_mass, 1e-15);
  // What left is on the books: energy and momentum balance as if nothing had.
  EXPECT_NEAR(a.balance(), b.balance(), 1e-10 * b.kinetic);
  for (std::size_t c = 0; c < 2; ++c)
    EXPECT_NEAR(a.momentum[c] - a.boundary_impulse[c], b.momentum[c] - b.boundary_impulse[c], 1e-12);
}

TEST(HeldRim, HoldsTheEdgeOfTheUpperFaceOnly) {
  IceOptions options = block_options(6, 6, 2, 0.01);
  options.planes = {true, true};
  options.held_rim = 0.01;
  const IceBody ice = make_ice(options);
  int held = 0;
  for (std::size_t n = 0; n < ice.solid.node_count(); ++n) {
    if (ice.solid.fixed[n] != 7) continue;
    ++held;
    const double* at = &ice.solid.mesh.nodes[3 * n];
    EXPECT_NEAR(at[2], 0.02, 1e-12);
    EXPECT_GT(std::max(at[0], at[1]), 0.05 - 1e-9);
  }
  EXPECT_EQ(held, 49 - 25);  // two lines of nodes along the two sides that are no symmetry planes
}

}  // namespace
}  // namespace polynya::ice
