#include <gtest/gtest.h>

#include <cmath>

#include "core/compute/pack.hpp"
#include "core/continuum/law.hpp"

namespace polynya::continuum {
namespace {

/// Table 1 of Diao, Fang & Cao 2025 completed, with the tensile limit T and the rate constant C free.
JohnsonHolmquist2 ice(double tensile, double rate_constant, double bulking = 0) {
  return johnson_holmquist_2_from_card("ice", {{"density", 900},
                                               {"shear_modulus", 4.4444e9},
                                               {"bulk_modulus", 8.1254e9},
                                               {"hugoniot_elastic_limit", 5.2e9},
                                               {"pressure_at_hugoniot_elastic_limit", 3.4381e9},
                                               {"intact_strength_constant", 1.4},
                                               {"intact_strength_exponent", 0.8918},
                                               {"strain_rate_constant", rate_constant},
                                               {"fractured_strength_constant", 0.09},
                                               {"fractured_strength_exponent", 1.2},
                                               {"maximum_tensile_pressure", tensile},
                                               {"damage_constant", 0.05},
                                               {"damage_exponent", 0.5},
                                               {"bulking_fraction", bulking}});
}

TEST(JohnsonHolmquist2, StrengthFollowsThePublishedFormula) {
  const auto law = ice(1e6, 0.05);
  const double p = 2e7, rate = 300, factor = 1 + 0.05 * std::log(rate), hel = 2642.85e6, php = 3438.1e6;
  const auto y = strength(law, p, rate, true, true);
  EXPECT_NEAR(y.intact, hel * 1.4 * std::pow((p + 1e6) / php, 0.8918) * factor, 1e-12 * hel);
  EXPECT_NEAR(y.fractured, hel * 0.09 * std::pow(p / php, 1.2) * factor, 1e-12 * hel);
  EXPECT_NEAR(y.fracture_strain, 0.05 * std::pow((p + 1e6) / php, 0.5), 1e-15);
  EXPECT_EQ(strength(law, -1.5e6, 1.0, true, true).intact, 0);
  EXPECT_EQ(strength(law, -0.5e6, 1.0, true, true).fractured, 0);
  EXPECT_EQ(strength(law, p, 1e-3, false, false).intact, strength(law, p, 1.0, false, false).intact);
}

TEST(JohnsonHolmquist2, UnconfinedStrengthsAreThoseTheTableImplies) {
  // Solved independently from the printed constants for several tensile limits, MPa.
  const double rows[][3] = {
      {0.5, 0.75, 5.6}, {0.99, 1.43, 8.8}, {1.0, 1.445, 8.83}, {2.0, 2.77, 14.3}, {3.0, 4.06, 19.1}};
  for (const auto& [tensile, tension, compression] : rows) {
    EXPECT_NEAR(uniaxial_tensile_strength(ice(tensile * 1e6, 0.2287), 1) / 1e6, tension, 0.006);
    EXPECT_NEAR(unconfined_compressive_strength(ice(tensile * 1e6, 0.2287), 1) / 1e6, compression, 0.06);
  }
}

TEST(JohnsonHolmquist2, UnconfinedStrengthGrowsWithTheRateAsTabulated) {
  const double rates[] = {1, 10, 100, 1000};
  const double printed[] = {8.8, 59, 635, 5065}, gentle[] = {8.8, 12.6, 18.5, 28.2}, weak[] = {8.8, 10.4, 12.2, 14.5};
  for (int k = 0; k < 4; ++k) {
    EXPECT_NEAR(unconfined_compressive_strength(ice(1e6, 0.2287), rates[k]) / 1e6, printed[k], 0.008 * printed[k]);
    EXPECT_NEAR(unconfined_compressive_strength(ice(1e6, 0.05), rates[k]) / 1e6, gentle[k], 0.06);
    EXPECT_NEAR(unconfined_compressive_strength(ice(1e6, 0.02287), rates[k]) / 1e6, weak[k], 0.06);
  }
}

TEST(JohnsonHolmquist2, TensionIsCutOffAndSinksWithDamage) {
  const auto law = ice(1e6, 0);
  PointState<double> state;
  const Tensor<double> swelling{10, 0, 0, 0, 10, 0, 0, 0, 10};
  for (int step = 0; step < 200; ++step) update_stress(law, state, swelling, 1e-6);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(state.stress[c], 1e6, 1e-6);
  EXPECT_EQ(state.damage, 0);
  for (int step = 0; step < 3; ++step) update_stress(law, state, Tensor<double>{10, 5, 0, 5, 10, 0, 0, 0, 10}, 1e-6);
  EXPECT_EQ(state.damage, 1);  // no strength at P* + T* = 0: any shear fractures
  for (int c = 0; c < 6; ++c) EXPECT_NEAR(state.stress[c], 0, 1e-6);
}

TEST(JohnsonHolmquist2, OneStepFarBeyondTheStrengthEndsOnTheFracturedSurface) {
  const auto law = ice(1e6, 0);
  PointState<double> state;
  const Tensor<double> crushing{-1e3, 3e5, 0, 0, -1e3, 0, 0, 0, -1e3};
  update_stress(law, state, crushing, 1e-6);
  EXPECT_EQ(state.damage, 1);
  update_stress(law, state, Tensor<double>{}, 1e-6);
  const double p = -(state.stress[0] + state.stress[1] + state.stress[2]) / 3;
  SymmetricTensor<double> deviator = state.stress;
  for (int c = 0; c < 3; ++c) deviator[c] += p;
  EXPECT_NEAR(equivalent_stress(deviator), strength(law, p, 0.0, true, false).fractured, 1e-6 * p);
}

TEST(JohnsonHolmquist2, PackedPointsEqualPlainOnes) {
  using compute::Pack;
  const auto law = ice(1e6, 0.05, 1);
  PointState<Pack> packed;
  Tensor<Pack> gradient{};
  for (int c = 0; c < 9; ++c)
    gradient[c] = Pack([&](auto lane) { return 30.0 * std::sin(3.0 * c + lane) - (c % 4 ? 0 : 40); });
  for (int step = 0; step < 500; ++step) update_stress(law, packed, gradient, Pack(1e-7));
  for (std::size_t lane = 0; lane < Pack::size(); ++lane) {
    PointState<double> plain;
    Tensor<double> own;
    for (int c = 0; c < 9; ++c) own[c] = gradient[c][lane];
    for (int step = 0; step < 500; ++step) update_stress(law, plain, own, 1e-7);
    for (int c = 0; c < 6; ++c) EXPECT_NEAR(plain.stress[c], packed.stress[c][lane], 1e-3);
    EXPECT_NEAR(plain.damage, packed.damage[lane], 1e-11);
  }
}

}  // namespace
}  // namespace polynya::continuum
