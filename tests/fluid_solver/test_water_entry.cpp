// Wedges that enter water, at constant speed and falling, in seconds: coarse, with bounds to match. At the resolution
// that the pressure peak asks for: test_water_entry_fine.cpp.
#include <gtest/gtest.h>

#include "tests/fluid_solver/falling_wedge.hpp"
#include "tests/fluid_solver/wedge_entry.hpp"

using namespace polynya::fluid::test;

namespace {

// The jet at the edge of the wetted part is one cell thick here (30 degrees) or two (40).
void expect_near_similarity(const Entered& entered) {
  EXPECT_NEAR(entered.force, 1, 0.08);
  EXPECT_NEAR(entered.median, 1, 0.15);
  EXPECT_NEAR(entered.raw, 1, 0.20);
  EXPECT_LT(entered.inside, 1e-6);
}

}  // namespace

TEST(WaterEntry, CoarseWedgeOf30DegreesFeelsTheForceOfSimilarity) {
  expect_near_similarity(enter(at_30, 30, 0.04));
}

TEST(WaterEntry, CoarseWedgeOf40DegreesFeelsTheForceOfSimilarity) {
  expect_near_similarity(enter(at_40, 30, 0.04));
}

TEST(WaterEntry, CoarseFallingWedgeSlowsDownNearlyAsBoundaryElementsSay) {
  const Fallen fallen = drop_wedge(0.008, 0.1, 344);
  EXPECT_LT(fallen.velocity, 0.06);
  EXPECT_LT(fallen.inside, 1e-6);
}
