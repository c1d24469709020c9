// Wedges that enter water at constant speed, as fine as the pressure peak asks for, against Zhao and Faltinsen (1993).
// The jet at the edge of the wetted part is about tan^2 / (2 pi) of c thick and the peak beside it as wide. The edge
// runs along at 1.5 cot times the wedge's speed; what compressibility adds is of the order of the square of its Mach
// number: 0.4 % at 40 degrees, 1.0 % at 30, 1.1 % at 20.
#include <gtest/gtest.h>

#include "tests/fluid_solver/wedge_entry.hpp"

using namespace polynya::fluid::test;

namespace {

void expect_similarity(const Entered& entered) {
  EXPECT_NEAR(entered.force, 1, 0.08);
  EXPECT_NEAR(entered.median, 1, 0.10);
  EXPECT_NEAR(entered.raw, 1, 0.20);
  EXPECT_LT(entered.inside, 1e-6);
}

}  // namespace

TEST(WaterEntryFine, WedgeOf40DegreesAt60Cells) {
  expect_similarity(enter(at_40, 60, 0.04, POLYNYA_BINARY_DIR "/wedge_40.csv"));
}

TEST(WaterEntryFine, WedgeOf30DegreesAt100Cells) {
  expect_similarity(enter(at_30, 100, 0.04, POLYNYA_BINARY_DIR "/wedge_30.csv"));
}

TEST(WaterEntryFine, WedgeOf20DegreesAt100Cells) {
  expect_similarity(enter(at_20, 100, 0.025, POLYNYA_BINARY_DIR "/wedge_20.csv"));
}
