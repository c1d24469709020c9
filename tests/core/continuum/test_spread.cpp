#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "block.hpp"
#include "core/continuum/explicit_solid.hpp"

// An element of brittle material whose law is asked once yields and breaks by what its hourglass modes hold, too.
namespace polynya::continuum {
namespace {

constexpr double size = 1e-3;

JohnsonHolmquist2 brittle() {
  return johnson_holmquist_2_from_card("ice", {{"density", 900},
                                               {"shear_modulus", 4.4444e9},
                                               {"bulk_modulus", 8.1254e9},
                                               {"hugoniot_elastic_limit", 5.2e9},
                                               {"pressure_at_hugoniot_elastic_limit", 3.4381e9},
                                               {"intact_strength_constant", 1.4},
                                               {"intact_strength_exponent", 0.8918},
                                               {"strain_rate_constant", 0},
                                               {"fractured_strength_constant", 0.09},
                                               {"fractured_strength_exponent", 1.2},
                                               {"maximum_tensile_pressure", 1e6},
                                               {"damage_constant", 0.05},
                                               {"damage_exponent", 0.5}});
}

/// A cube whose nodes move by shear (1/s, along y over x) and bending (1/s, strain rate along x of the faces in y).
ExplicitSolid moving_cube(Integration integration, double shear, double bending) {
  Numerics numerics;
  numerics.integration = integration;
  auto solid = make_solid("cube", tests::block({1, 1, 1}, {size, size, size}), brittle(), numerics);
  for (std::size_t n = 0; n < 8; ++n) {
    const double* x = &solid.mesh.nodes[3 * n];
    const double xi = x[0] > 0.5 * size ? 1 : -1, eta = x[1] > 0.5 * size ? 1 : -1;
    solid.velocities[3 * n] = bending * 0.5 * size * xi * eta;
    solid.velocities[3 * n + 1] = shear * 0.5 * size * xi;
  }
  return solid;
}

void move_on(ExplicitSolid& solid, double dt) {
  advance_positions(solid, dt);
  internal_forces(solid, dt);
}

/// Time until the element's damage is `wanted`, s.
double time_until(ExplicitSolid solid, double wanted, double dt) {
  while (solid.element.damage[0] < wanted && solid.time < 1e6 * dt) move_on(solid, dt);
  return solid.time;
}

// The mean square of the fibre stress E e y/(size/2) is E^2 e^2/3, e the strain at the surface.
TEST(SpreadAboutMean, PureBendingYieldsWhenTheRootMeanSquareOfItsFibresDoes) {
  const auto law = brittle();
  const double young = 9 * law.bulk_modulus * law.shear_modulus / (3 * law.bulk_modulus + law.shear_modulus);
  const double yields = std::sqrt(3.0) * strength(law, 0.0, 0.0, false, false).intact / young;
  const double yielded = time_until(moving_cube(Integration::one_point, 0, 1), 1e-12, 1e-3 * yields);
  EXPECT_NEAR(yielded / yields, 1, 0.003);
}

TEST(SpreadAboutMean, ShearAndBendingYieldTogetherByTheSumOfTheirSquares) {
  const auto law = brittle();
  const double young = 9 * law.bulk_modulus * law.shear_modulus / (3 * law.bulk_modulus + law.shear_modulus);
  for (const double bending : {0.3, 1.0, 3.0}) {
    const double per_time = std::hypot(std::sqrt(3.0) * law.shear_modulus, young * bending / std::sqrt(3.0));
    const double yields = strength(law, 0.0, 0.0, false, false).intact / per_time;
    EXPECT_NEAR(time_until(moving_cube(Integration::one_point, 1, bending), 1e-12, 1e-3 * yields) / yields, 1, 0.003)
        << bending;
  }
}

TEST(SpreadAboutMean, WhatStaysBentBeyondYieldDoesNotBreakWithoutMotion) {
  auto solid = moving_cube(Integration::one_point, 0, 1);
  while (solid.element.damage[0] < 0.05) move_on(solid, 1e-6);
  const double damage = solid.element.damage[0];
  ASSERT_LT(damage, 1);
  std::fill(solid.velocities.begin(), solid.velocities.end(), 0.0);
  for (int step = 0; step < 1000; ++step) move_on(solid, 1e-6);
  EXPECT_EQ(solid.element.damage[0], damage);
}

// The reference asks the law at eight points.
TEST(SpreadAboutMean, DamageGrowsLikeThatOfEightPoints) {
  for (const double bending : {0.0, 0.5, 1.0, 2.0, 4.0}) {
    const double one = time_until(moving_cube(Integration::one_point, 1, bending), 0.5, 1e-7);
    const double eight = time_until(moving_cube(Integration::full, 1, bending), 0.5, 1e-7);
    std::printf("surface strain %.1f of the shear: one point %.3e s, eight %.3e s, ratio %.3f\n", bending, one, eight,
                one / eight);
    EXPECT_NEAR(one / eight, 1, 0.15) << bending;
  }
}

}  // namespace
}  // namespace polynya::continuum
