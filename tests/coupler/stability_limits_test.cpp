#include "coupler/stability_limits.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace polynya;

namespace {

/// Water under 1e5 Pa of air against a wall of 3 kg/m^2 that may move 0.7 of its mass.
double limit(const scene::MaterialCard& card) {
  scene::Scene scene;
  scene.fluid.emplace().water = "water";
  scene.fluid->atmospheric_pressure = 1e5;
  scene.materials["water"] = card;
  coupler::LightestWall wall;
  wall.areal_mass = 3;
  return coupler::lag_limit(wall, scene);
}

}  // namespace

TEST(StabilityLimits, EveryLawOfWaterBoundsTheSpanByItsImpedance) {
  const double mie = limit({"water", "mie_grueneisen", {{"density", 1000}, {"sound_speed", 1480}}, {}});
  EXPECT_DOUBLE_EQ(mie, 2.1 / (1000 * 1480.0));
  const double stiffened = limit({"water",
                                  "stiffened_gas",
                                  {{"density", 1000}, {"ratio_of_specific_heats", 4.4}, {"stiffening_pressure", 6e8}},
                                  {}});
  EXPECT_DOUBLE_EQ(stiffened, 2.1 / (1000 * std::sqrt(4.4 * (6e8 + 1e5) / 1000)));
  const double tait = limit(
      {"water", "tait", {{"density", 1000}, {"reference_pressure", 1e5}, {"stiffness", 3e8}, {"exponent", 7}}, {}});
  EXPECT_DOUBLE_EQ(tait, 2.1 / (1000 * std::sqrt(7 * 3e8 / 1000)));
}
