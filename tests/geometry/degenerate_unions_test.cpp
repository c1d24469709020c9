// Ten thousand pairs of boxes that touch, share planes, edges and corners, or are the same.
#include "union_boxes.hpp"

TEST(DegenerateUnions, TenThousandPairsAreExactAndClose) {
  union_boxes::expect_degenerate_pairs(7, 10000);
}

TEST(DegenerateUnions, TwoThousandPairsTurnedTogetherKeepTheirVolume) {
  union_boxes::expect_turned_pairs(13, 2000);
}
