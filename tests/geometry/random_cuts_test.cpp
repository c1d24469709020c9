// Bodies at random places: what the cut takes from the cells is what the body has, and what CGAL's exact numbers say.
#include <gtest/gtest.h>

#include "closure.hpp"
#include "random_bodies.hpp"

using namespace random_bodies;

namespace {

void expect_whole(const CutCells& cut, const Shape& body) {
  const double volume = shapes::volume(body);
  EXPECT_LT(std::abs(total_volume(cut) - volume), 1e-12 * volume);
  shapes::Vector sum{};
  double size = 0;
  for (std::size_t e = 0; e < cut.cell.size(); ++e) {
    const double* a = &cut.wall_area[3 * e];
    for (std::size_t d = 0; d < 3; ++d) sum[d] += a[d];
    size += std::hypot(a[0], a[1], a[2]);
    const double cell = grid.cell_volume(cut.cell[e]), free = cell - cut.solid_volume[e];
    EXPECT_LT(std::abs(free + cut.body_volume[e] - cell), 1e-12 * cell);  // no body was clamped
  }
  for (std::size_t d = 0; d < 3; ++d) EXPECT_LT(std::abs(sum[d]), 1e-12 * size);
  const Closure closure = check_closure(cut, grid);
  EXPECT_LT(closure.area, 1e-12);
  EXPECT_LT(closure.pieces, 1e-12);
  EXPECT_LE(closure.fraction, 0.0);
  EXPECT_EQ(cut.corrected_faces + cut.overlapping_cells + cut.loose_edges, 0);
}

}  // namespace

TEST(RandomCuts, ThousandPositionsOfFourBodiesCloseAndAgreeWithTheExactCut) {
  const std::vector<Shape> kinds = bodies();
  std::mt19937 random(41);
  Cutter cutter(grid);
  CutCells cut;
  double worst = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const Shape body = placed_at_random(kinds[static_cast<std::size_t>(trial) % kinds.size()], random);
    cutter.cut(std::array{body.surface()}, cut);
    expect_whole(cut, body);
    if (HasFailure()) FAIL() << "trial " << trial;
    if (trial % 5 != 0) continue;  // exact cuts are slow; test_exact_cut_of_every_cell has the rest
    const std::vector<std::size_t> walls = cells_with_wall(cut);
    worst = std::max(worst, exact_difference(cut, walls[random() % walls.size()], body.surface()));
  }
  std::printf("largest difference from the exact cut: %.1e\n", worst);
  EXPECT_LT(worst, 1e-10);
}
