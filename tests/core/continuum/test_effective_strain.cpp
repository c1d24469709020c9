#include <gtest/gtest.h>

#include <cmath>

#include "block.hpp"
#include "core/continuum/explicit_solid.hpp"

namespace polynya::continuum {
namespace {

const Elastic soft{1000, 2e9, 1e9};

/// One element whose nodes have moved by x -> F x.
ExplicitSolid deformed(const std::array<double, 9>& f) {
  auto solid = make_solid("element", tests::block({1, 1, 1}, {1e-3, 2e-3, 1.5e-3}), soft);
  for (std::size_t n = 0; n < solid.node_count(); ++n)
    for (std::size_t i = 0; i < 3; ++i) {
      solid.positions[3 * n + i] = 0;
      for (std::size_t j = 0; j < 3; ++j) solid.positions[3 * n + i] += f[3 * i + j] * solid.mesh.nodes[3 * n + j];
    }
  return solid;
}

TEST(EffectiveStrain, IsZeroForRigidRotation) {
  const double c = std::cos(1.1), s = std::sin(1.1);
  EXPECT_LT(effective_strain(deformed({c, -s, 0, s, c, 0, 0, 0, 1}), 0), 1e-14);
}

TEST(EffectiveStrain, IsZeroForChangeOfVolume) {
  EXPECT_LT(effective_strain(deformed({0.7, 0, 0, 0, 0.7, 0, 0, 0, 0.7}), 0), 1e-14);
}

TEST(EffectiveStrain, OfIncompressibleStretchIsItsLogarithm) {
  const double l = 1.35;
  EXPECT_NEAR(effective_strain(deformed({l, 0, 0, 0, 1 / std::sqrt(l), 0, 0, 0, 1 / std::sqrt(l)}), 0), std::log(l),
              1e-14);
}

TEST(EffectiveStrain, OfUniaxialStrainIsTwoThirdsOfTheLogarithm) {
  EXPECT_NEAR(effective_strain(deformed({1, 0, 0, 0, 0.6, 0, 0, 0, 1}), 0), -2.0 / 3.0 * std::log(0.6), 1e-14);
}

TEST(EffectiveStrain, OfSimpleShearFollowsItsPrincipalStretches) {
  const double shear = 0.8, stretch = shear / 2 + std::sqrt(1 + shear * shear / 4);
  EXPECT_NEAR(effective_strain(deformed({1, shear, 0, 0, 1, 0, 0, 0, 1}), 0), 2 / std::sqrt(3.0) * std::log(stretch),
              1e-14);
}

TEST(EffectiveStrain, CheapBoundFindsWhatTheExactValueFinds) {
  auto solid = make_solid("block", tests::block({5, 5, 5}, {1, 1, 1}), soft);
  unsigned seed = 7;
  for (double& x : solid.positions) {
    seed = seed * 1664525u + 1013904223u;
    x += 0.07 * (static_cast<double>(seed) / 4294967296.0 - 0.5);
  }
  for (double critical : {0.1, 0.13, 0.16}) {
    std::vector<std::int32_t> expected;
    for (std::size_t e = 0; e < solid.element_count(); ++e)
      if (effective_strain(solid, e) > critical) expected.push_back(static_cast<std::int32_t>(e));
    EXPECT_EQ(elements_above_strain(solid, critical), expected);
    EXPECT_GT(expected.size(), 0u);
    EXPECT_LT(expected.size(), solid.element_count());
  }
}

}  // namespace
}  // namespace polynya::continuum
