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

/// A cube of 1 mm whose nodes move by amplitude along x in the mode (x y): it bends about z.
ExplicitSolid bent(const Law& law, double damage, double amplitude, double velocity) {
  auto solid = make_solid("element", tests::block({1, 1, 1}, {1e-3, 1e-3, 1e-3}), law);
  solid.element.damage[0] = damage;
  for (std::size_t n = 0; n < 8; ++n) {
    const double* x = &solid.mesh.nodes[3 * n];
    const double sign = (x[0] > 0 ? 1 : -1) * (x[1] > 0 ? 1 : -1);
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

double youngs_modulus(const Elastic& law) {
  return 9 * law.bulk_modulus * law.shear_modulus / (3 * law.bulk_modulus + law.shear_modulus);
}

// Bending by the angle 4 u / L over the length L: strain 2 u / L at the edge, energy 2/3 E L u^2, on eight nodes.
TEST(Hourglass, StiffnessInBendingIsThatOfABeam) {
  const Elastic law{900, 8.13e9, 4.44e9};
  auto solid = bent(law, 0, 1e-8, 0);
  internal_forces(solid, 0.0);
  EXPECT_NEAR(largest_force(solid) / (4.0 / 3.0 * youngs_modulus(law) * 1e-3 * 1e-8 / 8), 1, 1e-4);
  for (const auto& component : solid.element.stress) EXPECT_NEAR(component[0], 0, 1e-3);
}

// A bar of elements as thick as it is, four times as long: M = E I kappa, whatever the length of the elements.
TEST(Hourglass, StiffnessInBendingOfALongElementIsThatOfABeam) {
  const Elastic law{900, 8.13e9, 4.44e9};
  const double length = 4e-3, size = 1e-3, curvature = 1e-3;
  auto solid = make_solid("element", tests::block({1, 1, 1}, {length, size, size}), law);
  for (std::size_t n = 0; n < 8; ++n) {
    const double* x = &solid.mesh.nodes[3 * n];
    solid.positions[3 * n] += curvature * (x[0] - length / 2) * (x[1] - size / 2);
  }
  internal_forces(solid, 0.0);
  double moment = 0;
  for (std::size_t n = 0; n < 8; ++n)
    if (solid.mesh.nodes[3 * n] > 0) moment -= solid.internal_force[3 * n] * (solid.mesh.nodes[3 * n + 1] - size / 2);
  EXPECT_NEAR(moment / (youngs_modulus(law) * std::pow(size, 4) / 12 * curvature), 1, 1e-5);
}

// Forces of modes along and across the edges turn with the body and turn nothing.
TEST(Hourglass, StiffnessGivesNoTorqueAndTurnsWithTheBody) {
  const Elastic law{900, 8.13e9, 4.44e9};
  auto solid = make_solid("element", tests::block({1, 1, 1}, {1e-3, 2e-3, 4e-3}), law);
  for (std::size_t n = 0; n < 8; ++n) {
    const double* x = &solid.mesh.nodes[3 * n];
    const double s[] = {x[0] > 0 ? 1.0 : -1.0, x[1] > 0 ? 1.0 : -1.0, x[2] > 0 ? 1.0 : -1.0};
    const double a = s[0] * s[1], b = s[1] * s[2], c = s[0] * s[1] * s[2];
    const double moved[] = {3e-5 * a + 2e-5 * b + 1e-5 * c, 1e-5 * a - 3e-5 * b, 2e-5 * a + 4e-5 * c};
    for (std::size_t i = 0; i < 3; ++i) solid.positions[3 * n + i] += moved[i];
  }
  auto turned = solid;
  for (std::size_t n = 0; n < 8; ++n) {  // by 90 degrees about z
    turned.positions[3 * n] = -solid.positions[3 * n + 1];
    turned.positions[3 * n + 1] = solid.positions[3 * n];
  }
  internal_forces(solid, 0.0);
  internal_forces(turned, 0.0);
  double torque[3]{}, force[3]{};
  const double largest = largest_force(solid);
  for (std::size_t n = 0; n < 8; ++n) {
    const double *x = &solid.positions[3 * n], *f = &solid.internal_force[3 * n];
    for (std::size_t i = 0; i < 3; ++i) {
      force[i] += f[i];
      torque[i] += x[(i + 1) % 3] * f[(i + 2) % 3] - x[(i + 2) % 3] * f[(i + 1) % 3];
    }
    EXPECT_NEAR(turned.internal_force[3 * n], -f[1], 1e-11 * largest);
    EXPECT_NEAR(turned.internal_force[3 * n + 1], f[0], 1e-11 * largest);
    EXPECT_NEAR(turned.internal_force[3 * n + 2], f[2], 1e-11 * largest);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(force[i], 0, 1e-12 * largest);
    EXPECT_NEAR(torque[i], 0, 1e-12 * largest * 4e-3);
  }
}

// The yield strain of the hourglass is Y / 3 G = 1e7 / 1.332e10 here.
TEST(Hourglass, StiffnessFadesWithinTheStrainOfYielding) {
  const J2Plastic law{900, 8.13e9, 4.44e9, 1e7, 0, 1e300};
  const double yield_strain = 1e7 / (3 * 4.44e9);
  auto intact = bent(law, 0, 1e-8, 0);
  internal_forces(intact, 0.0);
  for (const double flowed : {0.25, 0.5, 1.0, 100.0}) {
    auto solid = bent(law, 0, 1e-8, 0);
    solid.element.plastic_strain[0] = flowed * yield_strain;
    internal_forces(solid, 0.0);
    EXPECT_NEAR(largest_force(solid) / largest_force(intact), 1 - 0.7 * std::min(flowed, 1.0), 1e-12) << flowed;
  }
}

// Every element bent against its neighbours, broken ones by a tenth of their size: what is broken exerts nothing.
TEST(Hourglass, BrokenBlockCarriesNoLoadInItsHourglassMode) {
  const Law law = johnson_holmquist_2_from_card("ice", card);
  constexpr double slowly = 1e4;  // s: nothing viscous is left to feel
  for (const Integration integration : {Integration::one_point, Integration::full})
    for (const double damage : {0.0, 1.0}) {
      const double amplitude = damage == 0 ? 1e-7 : 1e-4;  // m; intact ice would break
      Numerics numerics;
      numerics.integration = integration;
      auto solid = make_solid("block", tests::block({4, 4, 4}, {4e-3, 4e-3, 4e-3}), law, numerics);
      for (std::size_t e = 0; e < solid.element_count(); ++e)
        set_point_state(solid, e, {.stress = {}, .relative_volume = 1, .damage = damage});
      for (std::size_t n = 0; n < solid.node_count(); ++n) {
        const double* x = &solid.mesh.nodes[3 * n];
        const long odd = std::lround(1e3 * x[0]) + std::lround(1e3 * x[1]);
        solid.velocities[3 * n] = (odd % 2 == 0 ? amplitude : -amplitude) / slowly;
      }
      advance_positions(solid, slowly);
      internal_forces(solid, slowly);
      if (damage == 0)
        EXPECT_GT(largest_force(solid), 0.05);
      else
        EXPECT_LT(largest_force(solid), 1e-9);
    }
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
  const double bound = flow * 1e-6 / 12;
  EXPECT_NEAR(largest_force(far), bound, 1e-4 * bound);
  EXPECT_NEAR(largest_force(fast), bound, 1e-4 * bound);  // at 1 km/s
}

TEST(Hourglass, StiffnessGivesBackWhatItTook) {
  const Elastic law{900, 8.13e9, 4.44e9};
  auto solid = make_solid("element", tests::block({1, 1, 1}, {1e-3, 1e-3, 1e-3}), law, {0, 0, 1, 0, 0});
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
  EXPECT_NEAR(largest, 2.0 / 3.0 * youngs_modulus(law) * 1e-3 * 1e-14, 1e-3 * largest);
}

}  // namespace
}  // namespace polynya::continuum
