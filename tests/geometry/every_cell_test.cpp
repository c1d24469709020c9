// Every cell with wall of bodies at random places, recut by CGAL's exact numbers.
#include <gtest/gtest.h>

#include "random_bodies.hpp"

using namespace random_bodies;

TEST(RandomCuts, EveryCellOfManyPositionsAgreesWithTheExactCut) {
  const std::vector<Shape> kinds = bodies();
  std::mt19937 random(43);
  Cutter cutter(grid);
  CutCells cut;
  double worst = 0;
  std::size_t cells = 0;
  for (int trial = 0; trial < 48; ++trial) {
    const Shape body = placed_at_random(kinds[static_cast<std::size_t>(trial) % kinds.size()], random);
    cutter.cut(std::array{body.surface()}, cut);
    for (const std::size_t entry : cells_with_wall(cut)) {
      worst = std::max(worst, exact_difference(cut, entry, body.surface()));
      ++cells;
    }
  }
  std::printf("largest difference from the exact cut in %zu cells: %.1e\n", cells, worst);
  EXPECT_LT(worst, 1e-10);
}
