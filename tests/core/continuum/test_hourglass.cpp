#include <gtest/gtest.h>

#include <cmath>

#include "block.hpp"
#include "core/continuum/explicit_solid.hpp"

namespace polynya::continuum {
namespace {

const std::map<std::string, double> card{{"density", 900},
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
                                         {"damage_exponent", 0.5}};

/// One brick whose nodes move by amplitude along x in the mode (y z): its bending mode.
ExplicitSolid bent(const Law& law, double damage, double amplitude, double velocity) {
  auto solid = make_solid("element", tests::block({1, 1, 1}, {1e-3, 1e-3, 1e-3}), law);
  solid.element.damage[0] = damage;
  for (std::size_t n = 0; n < 8; ++n) {
    const double* x = &solid.mesh.nodes[3 * n];
    const double sign = (x[1] > 0 ? 1 : -1) * (x[2] > 0 ? 1 : -1);
    solid.positions[3 * n] += amplitude * sign;
    solid.velocities[3 * n] = velocity * sign;
  }
  return solid;
}

double largest_force(const ExplicitSolid& solid) {
  double largest = 0;
  for (double f : solid.internal_force) largest = std::max(largest, std::abs(f));
  return largest;
}

TEST(Hourglass, StiffnessIsThatOfFlanaganAndBelytschko) {
  const Elastic law{900, 8.13e9, 4.44e9};
  auto solid = bent(law, 0, 1e-6, 0);
  internal_forces(solid, 0.0);
  // A cube: b.b = 1.5 L^4, V = L^3; nodal force k 8 u with k = kappa/16 (K + 4G/3) 1.5 L.
  const double modulus = 8.13e9 + 4.0 / 3.0 * 4.44e9;
  EXPECT_NEAR(largest_force(solid), 0.05 / 16 * modulus * 1.5 * 1e-3 * 8 * 1e-6, 1e-9);
  for (const auto& component : solid.element.stress) EXPECT_NEAR(component[0], 0, 1e-3);
}

TEST(Hourglass, ForceOfAFullyDamagedElementVanishes) {
  const Law law = johnson_holmquist_2_from_card("ice", card);
  auto intact = bent(law, 0, 1e-6, 0), broken = bent(law, 1, 1e-6, 0);
  internal_forces(intact, 0.0);
  internal_forces(broken, 0.0);
  EXPECT_GT(largest_force(intact), 0.1);
  EXPECT_LT(largest_force(broken), 1e-12);
}

TEST(Hourglass, ForceIsCappedByTheFlowStress) {
  const auto law = johnson_holmquist_2_from_card("ice", card);
  auto far = bent(law, 0, 1e-5, 0), fast = bent(law, 0, 0, 1e3);
  internal_forces(far, 0.0);
  internal_forces(fast, 0.0);
  const double flow = strength(law, 0.0, 1.0, false, false).intact;  // stress free but for the mode
  EXPECT_NEAR(largest_force(far), flow * 1e-6 / 12, 1e-4 * flow * 1e-6 / 12);
  // The viscous part at 1 km/s: the floor, 1 % of wave speed / length, is all that is left above the cap.
  const double speed = std::sqrt((8.1254e9 + 4.0 / 3.0 * 4.4444e9) / 900);
  EXPECT_NEAR(largest_force(fast), 0.01 * 900e-9 / 8 * speed / 1e-3 * 1e3, 1e-3);
}

TEST(Hourglass, StiffnessGivesBackWhatItTook) {
  const Elastic law{900, 8.13e9, 4.44e9};
  auto solid = make_solid("element", tests::block({1, 1, 1}, {1e-3, 1e-3, 1e-3}), law, {0, 0, 0.05, 0, 0});
  const auto none = std::vector<double>(24, 0.0);
  const auto mode = bent(law, 0, 1e-7, 0).positions;
  solid.positions = mode;
  internal_forces(solid, 0.0);
  advance_velocities(solid, none, 0, 1e-8);
  double largest = 0, worst = 0;
  for (int step = 0; step < 3000; ++step) {
    advance_positions(solid, 1e-8);
    internal_forces(solid, 1e-8);
    advance_velocities(solid, none, 1e-8, 1e-8);
    const auto account = energies(solid);
    largest = std::max(largest, account.kinetic);
    worst = std::max(worst, std::abs(account.balance()));
    // Exact exchange with the kinetic energy: the law's stress has no part in this motion.
    ASSERT_NEAR(account.hourglass + account.kinetic - account.step_change, 0, 1e-6 * largest + 1e-20);
  }
  EXPECT_LT(worst, 1e-12 * largest);
  // 1/2 k |q|^2 of the start, k = kappa/16 M 1.5 L, q = 8 u.
  const double k = 0.05 / 16 * (8.13e9 + 4.0 / 3.0 * 4.44e9) * 1.5e-3;
  EXPECT_NEAR(largest, 0.5 * k * 64e-14, 1e-3 * largest);
}

}  // namespace
}  // namespace polynya::continuum
