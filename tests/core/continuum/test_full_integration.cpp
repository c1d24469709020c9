#include <gtest/gtest.h>
#include <omp.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "block.hpp"
#include "core/continuum/bad_element.hpp"
#include "core/continuum/explicit_solid.hpp"
#include "random_numbers.hpp"

namespace polynya::continuum {
namespace {

const Elastic ice_like{900, 8.13e9, 4.44e9};

Numerics full() {
  Numerics numerics;
  numerics.integration = Integration::full;
  return numerics;
}

/// Without anything that dissipates.
Numerics full_without_viscosity() {
  Numerics numerics = full();
  numerics.linear_viscosity = numerics.quadratic_viscosity = 0;
  return numerics;
}

JohnsonHolmquist2 brittle() {
  return johnson_holmquist_2_from_card("ice", {{"density", 900},
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
}

ExplicitSolid distorted_block(const Numerics& numerics, const Law& law) {
  tests::Random random;
  return make_solid("block",
                    tests::block({4, 3, 5}, {4e-3, 3e-3, 5e-3},
                                 [&](double* x) {
                                   for (int i = 0; i < 3; ++i) x[i] += 2e-4 * random.symmetric();
                                 }),
                    law, numerics);
}

/// One step of length dt that takes the nodes by the displacement ([n][3], m).
void displace(ExplicitSolid& solid, const std::vector<double>& displacement, double dt) {
  for (std::size_t k = 0; k < displacement.size(); ++k) solid.velocities[k] = displacement[k] / dt;
  advance_positions(solid, dt);
  internal_forces(solid, dt);
}

/// Displacement of the eight nodes of one brick along x in a product of its natural coordinates.
std::vector<double> mode_along_x(const ExplicitSolid& solid, std::array<bool, 3> varies, double amplitude) {
  std::vector<double> displacement(24, 0.0);
  for (std::size_t n = 0; n < 8; ++n) {
    displacement[3 * n] = amplitude;
    for (std::size_t i = 0; i < 3; ++i)
      if (varies[i] && solid.mesh.nodes[3 * n + i] == 0) displacement[3 * n] *= -1;
  }
  return displacement;
}

/// Stiffness of one element at rest, N/m: force against displacement, column by column.
Eigen::MatrixXd stiffness(const ExplicitSolid& at_rest) {
  constexpr double step = 1e-9;
  Eigen::MatrixXd matrix(24, 24);
  for (int k = 0; k < 24; ++k) {
    auto solid = at_rest;
    std::vector<double> displacement(24, 0.0);
    displacement[static_cast<std::size_t>(k)] = step;
    displace(solid, displacement, 1);
    for (int i = 0; i < 24; ++i) matrix(i, k) = -solid.internal_force[static_cast<std::size_t>(i)] / step;
  }
  return 0.5 * (matrix + matrix.transpose());
}

TEST(FullIntegration, PatchOfDistortedElementsFollowsALinearFieldExactly) {
  auto solid = distorted_block(full_without_viscosity(), ice_like);
  Numerics bare;
  bare.linear_viscosity = bare.quadratic_viscosity = 0;
  auto one_point = distorted_block(bare, ice_like);
  const double gradient[3][3] = {{900, -300, 200}, {500, 400, 100}, {-600, 250, 700}};  // 1/s
  for (auto* body : {&solid, &one_point})
    for (int step = 0; step < 200; ++step) {
      std::vector<double> displacement(body->positions.size());
      for (std::size_t k = 0; k < displacement.size(); ++k)
        for (std::size_t j = 0; j < 3; ++j)
          displacement[k] += 1e-7 * gradient[k % 3][j] * body->positions[k - k % 3 + j];
      displace(*body, displacement, 1e-7);
    }
  const double scale = std::abs(solid.element.stress[0][0]);
  EXPECT_GT(scale, 1e7);
  for (std::size_t c = 0; c < 6; ++c)
    for (std::size_t e = 0; e < solid.element_count(); ++e) {
      EXPECT_NEAR(solid.element.stress[c][e], one_point.element.stress[c][0], 1e-11 * scale);
      for (const PointArrays& point : solid.points)
        EXPECT_NEAR(point.stress[c][e], one_point.element.stress[c][0], 1e-11 * scale);
    }
  // Inner nodes feel no force, outer ones that of the stress; 1e-6 m^2 is the area of an element's face.
  for (std::size_t i = 0; i < solid.internal_force.size(); ++i) {
    const double expected = solid.living_elements[i / 3] == 8 ? 0 : one_point.internal_force[i];
    EXPECT_NEAR(solid.internal_force[i], expected, 1e-10 * scale * 1e-6);
  }
}

TEST(FullIntegration, RigidRotationLeavesNoStress) {
  auto solid = distorted_block(full(), ice_like);
  const double c = std::cos(0.1), s = std::sin(0.1);  // 90 degrees in 15.7 steps
  for (int step = 0; step < 16; ++step) {
    std::vector<double> displacement(solid.positions.size(), 0.0);
    for (std::size_t n = 0; n < solid.node_count(); ++n) {
      const double *x = &solid.positions[3 * n], turned[] = {c * x[0] - s * x[2], x[1], s * x[0] + c * x[2]};
      for (std::size_t i = 0; i < 3; ++i) displacement[3 * n + i] = turned[i] - x[i];
    }
    displace(solid, displacement, 1e-6);
  }
  for (const PointArrays& point : solid.points)
    for (const auto& component : point.stress)
      for (double stress : component) EXPECT_NEAR(stress, 0, 1e-13 * ice_like.bulk_modulus);
}

TEST(FullIntegration, ForcesGiveNoNetForceAndNoTorque) {
  auto solid = distorted_block(full(), ice_like);
  tests::Random random;
  for (double& v : solid.velocities) v = 5 * random.symmetric();
  for (int step = 0; step < 10; ++step) {
    advance_positions(solid, 1e-7);
    internal_forces(solid, 1e-7);
  }
  double force[3] = {}, torque[3] = {}, size = 0;
  for (std::size_t n = 0; n < solid.node_count(); ++n) {
    const double *f = &solid.internal_force[3 * n], *x = &solid.positions[3 * n];
    for (int i = 0; i < 3; ++i) {
      force[i] += f[i];
      size += std::abs(f[i]);
      torque[i] += x[(i + 1) % 3] * f[(i + 2) % 3] - x[(i + 2) % 3] * f[(i + 1) % 3];
    }
  }
  EXPECT_GT(size, 1);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(force[i], 0, 1e-13 * size);
    EXPECT_NEAR(torque[i], 0, 1e-13 * size * 5e-3);
  }
}

// Of a cube with half edges a: u = g eta xi strains by exx = g eta/a, exy = g xi/2a; the mean change of volume is none,
// so the energy is that of the deviator, whatever the bulk modulus: G V (g/a)^2 (2/3 + 1/2)/3. Likewise the others.
TEST(FullIntegration, HourglassModesHaveTheEnergyOfTheTrilinearField) {
  struct Mode {
    std::array<bool, 3> varies;
    double energy;  // over G V (g/a)^2
  };
  const double size = 1e-3, g = 1e-9;
  for (const double bulk : {8.13e9, 8.13e12})
    for (const Mode& mode : {Mode{{true, true, false}, 7.0 / 18}, Mode{{true, false, true}, 7.0 / 18},
                             Mode{{false, true, true}, 1.0 / 3}, Mode{{true, true, true}, 5.0 / 27}}) {
      auto solid = make_solid("element", tests::block({1, 1, 1}, {size, size, size}), Elastic{900, bulk, 4.44e9},
                              full_without_viscosity());
      const auto displacement = mode_along_x(solid, mode.varies, g);
      displace(solid, displacement, 1);
      double work = 0;
      for (std::size_t k = 0; k < 24; ++k) work -= 0.5 * solid.internal_force[k] * displacement[k];
      EXPECT_NEAR(work / (4.44e9 * std::pow(size, 3) * std::pow(g / (size / 2), 2)), mode.energy, 1e-5);
      EXPECT_EQ(solid.hourglass_energy, 0);
    }
}

TEST(FullIntegration, NoMotionButARigidOneIsWithoutEnergy) {
  tests::Random random;
  for (const double distortion : {0.0, 0.15}) {
    const auto solid = make_solid("element",
                                  tests::block({1, 1, 1}, {1e-3, 2e-3, 1.5e-3},
                                               [&](double* x) {
                                                 for (int i = 0; i < 3; ++i)
                                                   x[i] += distortion * 1e-3 * random.symmetric();
                                               }),
                                  ice_like, full_without_viscosity());
    const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(stiffness(solid)).eigenvalues();
    for (int k = 0; k < 6; ++k) EXPECT_NEAR(values[k] / values[23], 0, 1e-6) << distortion << " mode " << k;
    for (int k = 6; k < 24; ++k) EXPECT_GT(values[k] / values[23], 0.01) << distortion << " mode " << k;
  }
}

// The largest frequency of an element alone bounds that of any mesh of such elements (Irons & Treharne 1971).
TEST(FullIntegration, StepIsStableForBricksAndDistortedElements) {
  tests::Random random;
  double worst = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const std::array<double, 3> size{1e-3, 1e-3 * (1 + 2 * random.unit()), 1e-3 * (1 + 2 * random.unit())};
    const double distortion = trial < 20 ? 0 : 0.3 * random.unit();
    const Elastic law{900, (1.0 + 9 * random.unit()) * 4e9, 4e9};
    const auto solid = make_solid("element",
                                  tests::block({1, 1, 1}, size,
                                               [&](double* x) {
                                                 for (std::size_t i = 0; i < 3; ++i)
                                                   x[i] += distortion * size[i] * random.symmetric();
                                               }),
                                  law, full_without_viscosity());
    const double largest = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(stiffness(solid)).eigenvalues()[23];
    worst = std::max(worst, stable_step(solid) / (2 / std::sqrt(largest / solid.masses[0])));
  }
  RecordProperty("largest_part_of_the_stable_step", std::to_string(worst));
  EXPECT_LT(worst, 1 + 1e-4);
  EXPECT_GT(worst, 0.9);
}

// Homogeneous deformation: all points see what the one point sees.
TEST(FullIntegration, UniaxialStrainOfBrittleIceIsThatOfTheOnePointElement) {
  const auto make = [](const Numerics& numerics) {
    return make_solid("element", tests::block({1, 1, 1}, {1e-3, 1e-3, 1e-3}), brittle(), numerics);
  };
  auto eight = make(full()), one = make({});
  bool half_broken = false;
  for (int step = 0; step < 500; ++step) {
    const double strain = step < 150 ? 1e-5 : -1e-4;  // tension until it is broken, then 3.5 % of compression
    for (auto* solid : {&eight, &one}) {
      std::vector<double> displacement(24, 0.0);
      for (std::size_t n = 0; n < 8; ++n)
        if (solid->mesh.nodes[3 * n + 2] > 0) displacement[3 * n + 2] = strain * 1e-3;
      displace(*solid, displacement, 1e-6);
    }
    for (std::size_t c = 0; c < 6; ++c)
      ASSERT_NEAR(eight.element.stress[c][0], one.element.stress[c][0], 1e-12 * 8e9) << "step " << step;
    ASSERT_NEAR(eight.element.damage[0], one.element.damage[0], 1e-12);
    ASSERT_NEAR(eight.element.bulking_pressure[0], one.element.bulking_pressure[0], 1e-12 * 8e9);
    half_broken |= one.element.damage[0] > 0.1 && one.element.damage[0] < 0.9;
  }
  EXPECT_TRUE(half_broken);
  EXPECT_EQ(eight.element.damage[0], 1);
  for (std::size_t k = 0; k < 24; ++k) EXPECT_NEAR(eight.internal_force[k], one.internal_force[k], 1e-12 * 8e9 * 1e-6);
}

TEST(FullIntegration, BendingBreaksTheOuterPointsBeforeTheMean) {
  auto solid = make_solid("element", tests::block({1, 1, 1}, {1e-3, 1e-3, 1e-3}), brittle(), full());
  // Bent alone all points would be strained alike: the pressure is the element's.
  std::vector<double> bent_and_stretched = mode_along_x(solid, {true, true, false}, 1e-8);
  for (std::size_t n = 0; n < 8; ++n) bent_and_stretched[3 * n] += 1e-5 * solid.mesh.nodes[3 * n];
  const auto most_damage = [&] {
    double most = 0;
    for (const PointArrays& point : solid.points) most = std::max(most, point.damage[0]);
    return most;
  };
  while (most_damage() < 1) displace(solid, bent_and_stretched, 1e-6);
  std::vector<double> damage;
  for (const PointArrays& point : solid.points) damage.push_back(point.damage[0]);
  const auto [least, most] = std::minmax_element(damage.begin(), damage.end());
  EXPECT_EQ(*most, 1);
  EXPECT_LT(*least, 1);
  double mean = 0;
  for (double d : damage) mean += d / 8;
  EXPECT_NEAR(solid.element.damage[0], mean, 1e-15);
}

TEST(FullIntegration, BalanceOfEnergyHoldsToRoundOffWhileIceBreaksAndElementsLeave) {
  auto solid = distorted_block(full(), brittle());
  tests::Random random;
  for (double& v : solid.velocities) v = 3 * random.symmetric();
  std::vector<double> force(solid.velocities.size());
  double dt = 0.5 * stable_step(solid);
  advance_velocities(solid, force, 0, dt);
  const double start = energies(solid).balance();
  for (int step = 0; step < 400; ++step) {
    advance_positions(solid, dt);
    internal_forces(solid, dt);
    for (double& f : force) f = 0.2 * random.symmetric();
    const double next = (0.5 + 0.4 * random.unit()) * stable_step(solid);
    advance_velocities(solid, force, dt, next);
    if (step % 50 == 49) remove_element(solid, static_cast<std::size_t>(step) / 10);
    dt = next;
    if (step % 50 != 49) {
      ASSERT_NEAR(energies(solid).balance(), start, 1e-12 * start) << "step " << step;
    }
  }
  EXPECT_EQ(energies(solid).hourglass, 0);
  EXPECT_GT(energies(solid).viscous, 0);
  EXPECT_EQ(*std::max_element(solid.element.damage.begin(), solid.element.damage.end()), 1);
}

// A free block that breathes and bends: what the motion loses the stress holds, and gives back.
TEST(FullIntegration, FreeVibrationKeepsItsEnergyInMotionAndStress) {
  auto solid = make_solid("block", tests::block({8, 8, 8}, {8e-3, 8e-3, 8e-3}), ice_like, full_without_viscosity());
  for (std::size_t n = 0; n < solid.node_count(); ++n) {
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
    // Stored at the points: s:s/4G + p^2/2K per volume.
    double stored = 0;
    for (const PointArrays& point : solid.points)
      for (std::size_t e = 0; e < solid.element_count(); ++e) {
        const auto& s = point.stress;
        const double mean = (s[0][e] + s[1][e] + s[2][e]) / 3;
        double square = 0;
        for (std::size_t c = 0; c < 6; ++c) {
          const double deviator = s[c][e] - (c < 3 ? mean : 0.0);
          square += (c < 3 ? 1 : 2) * deviator * deviator;
        }
        stored += solid.element.volume[e] / 8 *
                  (square / (4 * ice_like.shear_modulus) + mean * mean / (2 * ice_like.bulk_modulus));
      }
    const auto account = energies(solid);
    largest = std::max(largest, account.internal);
    ASSERT_NEAR(account.internal, stored, 2e-3 * start);
    ASSERT_NEAR(account.internal + account.kinetic, start, 1e-12 * start);
  }
  EXPECT_GT(largest, 0.5 * start);
}

TEST(FullIntegration, PackedKernelEqualsThePlainOne) {
  J2Plastic ductile{900, 8.1254e9, 4.4444e9};
  ductile.yield_stress = 1e6;
  for (const Law& law : {Law(ice_like), Law(ductile), Law(brittle())}) {
    auto packed = distorted_block(full(), law);
    tests::Random random;
    for (double& v : packed.velocities) v = 4 * random.symmetric();
    auto plain = packed;
    for (int step = 0; step < 20; ++step) {
      plain = packed;  // step by step: fracture amplifies round-off
      for (auto* solid : {&packed, &plain}) advance_positions(*solid, 5e-8);
      internal_forces(packed, 5e-8);
      internal_forces_scalar(plain, 5e-8);
    }
    for (std::size_t i = 0; i < plain.internal_force.size(); ++i)
      EXPECT_NEAR(packed.internal_force[i], plain.internal_force[i], 1e-10);
    for (std::size_t e = 0; e < plain.element_count(); ++e) {
      EXPECT_NEAR(packed.element.damage[e], plain.element.damage[e], 1e-12);
      EXPECT_NEAR(packed.element.step_limit[e], plain.element.step_limit[e], 1e-16);
      for (std::size_t p = 0; p < 8; ++p)
        EXPECT_NEAR(packed.points[p].plastic_strain[e], plain.points[p].plastic_strain[e], 1e-12);
    }
    EXPECT_NEAR(packed.viscous_energy, plain.viscous_energy, 1e-16);
  }
}

TEST(FullIntegration, GivesTheSameBitsForAnyNumberOfThreads) {
  std::vector<double> first;
  for (int threads : {1, 2}) {
    omp_set_num_threads(threads);
    auto solid = make_solid("block", tests::block({13, 17, 19}, {1e-2, 1e-2, 1e-2}), brittle(), full());
    tests::Random random;
    for (double& v : solid.velocities) v = random.symmetric();
    const std::vector<double> none(solid.velocities.size(), 0.0);
    for (int step = 0; step < 20; ++step) {
      advance_positions(solid, 5e-8);
      internal_forces(solid, 5e-8);
      advance_velocities(solid, none, 5e-8, 5e-8);
    }
    auto bits = solid.positions;
    bits.insert(bits.end(), solid.points[5].damage.begin(), solid.points[5].damage.end());
    bits.push_back(energies(solid).internal);
    if (threads == 1) first = bits;
    EXPECT_EQ(first, bits);
  }
}

TEST(FullIntegration, AtRestExertsNoForceAtAll) {
  const auto solid = distorted_block(full(), brittle());
  for (double force : solid.internal_force) EXPECT_EQ(force, 0);
}

// The corner is pushed past the middle: the volume is still positive, the map at the nearest point is folded.
TEST(FullIntegration, AnElementFoldedAtAPointIsNamed) {
  auto solid = make_solid("ice", tests::block({1, 1, 1}, {1e-3, 1e-3, 1e-3}), ice_like, full());
  std::vector<double> displacement(24, 0.0);
  for (std::size_t i = 0; i < 3; ++i) displacement[i] = 0.9e-3;
  try {
    displace(solid, displacement, 1e-6);
    FAIL() << "accepted";
  } catch (const BadElement& bad) {
    EXPECT_EQ(bad.element, 0u);
  }
}

}  // namespace
}  // namespace polynya::continuum
