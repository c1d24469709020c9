#include <gtest/gtest.h>

#include <cmath>

#include "core/compute/pack.hpp"
#include "core/continuum/law.hpp"

namespace polynya::continuum {
namespace {

const J2Plastic copper = j2_plastic_from_card("copper", {{"density", 8930},
                                                         {"youngs_modulus", 117e9},
                                                         {"poisson_ratio", 0.35},
                                                         {"yield_stress", 400e6},
                                                         {"hardening_modulus", 100e6}});

Tensor<double> uniaxial_stretching(double rate) {
  return {rate, 0, 0, 0, 0, 0, 0, 0, 0};
}

double von_mises_of(const PointState<double>& state) {
  SymmetricTensor<double> deviator = state.stress;
  const double mean = (deviator[0] + deviator[1] + deviator[2]) / 3;
  for (int c = 0; c < 3; ++c) deviator[c] -= mean;
  return equivalent_stress(deviator);
}

// In uniaxial strain the deviator turns elastic at 2 G e = 2/3 Y and the plastic strain is 2/3 e - Y/(3 G) of what is
// beyond, exactly, whatever the steps: the return is radial along the path.
TEST(J2Plastic, UniaxialStrainFollowsTheClosedFormInAnyNumberOfSteps) {
  for (const int steps : {1, 7, 1000}) {
    PointState<double> state;
    const double strain = 0.01;
    for (int k = 0; k < steps; ++k) update_stress(copper, state, uniaxial_stretching(strain / steps), 1.0);
    const double g = copper.shear_modulus, h = copper.hardening_modulus;
    const double plastic = (2 * g * strain - copper.yield_stress) / (3 * g + h);
    EXPECT_NEAR(state.plastic_strain, plastic, 1e-12);
    EXPECT_NEAR(von_mises_of(state), copper.yield_stress + h * plastic, 1e-3);
    const double pressure = -(state.stress[0] + state.stress[1] + state.stress[2]) / 3;
    EXPECT_NEAR(pressure / (copper.bulk_modulus * (1 / state.relative_volume - 1)), 1, 1e-12);
  }
}

TEST(J2Plastic, UnloadsElasticallyAndYieldsAgainAtTheHardenedStress) {
  PointState<double> state;
  for (int k = 0; k < 100; ++k) update_stress(copper, state, uniaxial_stretching(1e-4), 1.0);
  const double hardened = state.plastic_strain, before = state.stress[0] - state.stress[1];
  for (int k = 0; k < 10; ++k) update_stress(copper, state, uniaxial_stretching(-1e-4), 1.0);
  EXPECT_EQ(state.plastic_strain, hardened);
  EXPECT_NEAR((before - (state.stress[0] - state.stress[1])) / (2 * copper.shear_modulus * 1e-3), 1, 1e-10);
  for (int k = 0; k < 200; ++k) update_stress(copper, state, uniaxial_stretching(-1e-4), 1.0);
  EXPECT_GT(state.plastic_strain, hardened);
  EXPECT_NEAR(von_mises_of(state), copper.yield_stress + copper.hardening_modulus * state.plastic_strain, 1e-3);
}

TEST(J2Plastic, BeyondTheFailureStrainNeitherShearNorTensionIsCarried) {
  J2Plastic brittle = copper;
  brittle.failure_strain = 0.002;
  PointState<double> state;
  while (state.damage < 1) update_stress(brittle, state, uniaxial_stretching(1e-4), 1.0);
  EXPECT_GE(state.plastic_strain, brittle.failure_strain);
  for (const double stress : state.stress) EXPECT_EQ(stress, 0);
  for (int k = 0; k < 300; ++k) update_stress(brittle, state, uniaxial_stretching(-1e-4), 1.0);
  const double pressure = brittle.bulk_modulus * (1 / state.relative_volume - 1);
  ASSERT_GT(pressure, 1e8);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(state.stress[c] / -pressure, 1, 1e-12);
  EXPECT_NEAR(state.stress[3], 0, 1e-3);
}

TEST(J2Plastic, PacksAndPlainDoublesAgree) {
  PointState<compute::Pack> pack;
  PointState<double> plain;
  for (int k = 0; k < 50; ++k) {
    const Tensor<double> gradient{2e-4, 3e-4, -1e-4, -3e-4, -1e-4, 2e-4, 5e-4, 1e-4, -2e-4};
    Tensor<compute::Pack> gradients;
    for (int c = 0; c < 9; ++c) gradients[c] = gradient[c];
    update_stress(copper, plain, gradient, 1.0);
    update_stress(copper, pack, gradients, compute::Pack(1.0));
  }
  EXPECT_GT(plain.plastic_strain, 0.001);
  EXPECT_NEAR(pack.plastic_strain[0], plain.plastic_strain, 1e-14);
  for (int c = 0; c < 6; ++c) EXPECT_NEAR(pack.stress[c][0], plain.stress[c], 1e-4);
}

}  // namespace
}  // namespace polynya::continuum
