// Ten thousand pairs of boxes that touch, share planes, edges and corners, or are the same.
#include "union_boxes.hpp"

TEST(DegenerateUnions, TenThousandPairsAreExactAndClose) {
  union_boxes::expect_degenerate_pairs(7, 10000);
}
