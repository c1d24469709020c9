#include <gtest/gtest.h>

#include <numeric>

#include "closure.hpp"
#include "geometry/cut_cells.hpp"
#include "shapes.hpp"

using namespace polynya::geometry;
using shapes::Shape;

namespace {

double debris_in(const CutCells& cut) {
  return std::accumulate(cut.debris_volume.begin(), cut.debris_volume.end(), 0.0);
}

void cut_nothing(Cutter& cutter, CutCells& cut) {
  const Shape nothing;
  cutter.cut(std::array{nothing.surface()}, cut);
}

}  // namespace

TEST(Debris, ACubeIsSpreadByItsOverlapWithTheCells) {
  Cutter cutter(shapes::cube_grid(1.0, 10));  // cells of 0.2
  CutCells cut;
  cut_nothing(cutter, cut);
  // A cube of side 0.1 whose centre is 0.03 left of the plane x = 0 and in the middle of cells along y and z.
  cutter.deposit_debris(std::array{-0.03, 0.1, 0.1}, std::array{1e-3}, cut);
  ASSERT_EQ(cut.cell.size(), 2u);
  EXPECT_EQ(cut.cell[0] + 1, cut.cell[1]);
  EXPECT_NEAR(cut.debris_volume[0], 0.8e-3, 1e-15);
  EXPECT_NEAR(cut.debris_volume[1], 0.2e-3, 1e-15);
}

TEST(Debris, AllOfItIsKeptInsideTheWalls) {
  Cutter cutter(shapes::cube_grid(1.0, 10));
  CutCells cut;
  cut_nothing(cutter, cut);
  cutter.deposit_debris(std::array{-0.99, 0.995, 0.0, 0.5, 0.5, 1.5}, std::array{1e-3, 1e-3}, cut);
  EXPECT_NEAR(debris_in(cut), 1e-3, 1e-15);  // the second is outside
  EXPECT_EQ(cut.squeezed_volume, 0.0);
}

TEST(Debris, AFullCellPassesItOnAndATightOneSqueezesIt) {
  const GridLines grid = shapes::cube_grid(1.0, 10);
  Cutter cutter(grid);
  CutCells cut;
  cut_nothing(cutter, cut);
  const double cell = 0.008;
  std::vector<double> positions, volumes;
  for (int p = 0; p < 20; ++p) {
    positions.insert(positions.end(), {0.1, 0.1, 0.1});
    volumes.push_back(cell / 10);
  }
  cutter.deposit_debris(positions, volumes, cut);  // two cells' volume into one cell
  EXPECT_NEAR(debris_in(cut), 2 * cell, 1e-15);
  EXPECT_EQ(cut.squeezed_volume, 0.0);
  for (std::size_t e = 0; e < cut.cell.size(); ++e) EXPECT_LE(cut.debris_volume[e], 0.9 * cell * (1 + 1e-12));

  Shape block = shapes::box(2);  // everything is solid up to the last tenth
  shapes::scale_and_move(block, {1, 1, 0.95}, {0, 0, -0.05});
  cutter.cut(std::array{block.surface()}, cut);
  cutter.deposit_debris(positions, volumes, cut);
  EXPECT_NEAR(debris_in(cut) + cut.squeezed_volume, 2 * cell, 1e-15);
  EXPECT_GT(cut.squeezed_volume, 0.0);
}

TEST(Debris, InsertedCellsKeepEntriesSortedAndPiecesAttached) {
  const GridLines grid = shapes::cube_grid(1.0, 10);
  Cutter cutter(grid);
  CutCells plain, cut;
  Shape ball = shapes::sphere(2);
  shapes::scale_and_move(ball, {0.5, 0.5, 0.5}, {0.01, 0.02, 0.03});
  cutter.cut(std::array{ball.surface()}, plain);
  cutter.cut(std::array{ball.surface()}, cut);
  std::mt19937 random(9);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<double> positions(3 * 200), volumes(200, 2e-4);
  for (double& x : positions) x = uniform(random);
  cutter.deposit_debris(positions, volumes, cut);
  EXPECT_GT(cut.cell.size(), plain.cell.size());
  const Closure closure = check_closure(cut, grid);
  EXPECT_TRUE(closure.sorted);
  EXPECT_LT(closure.area, 1e-12);
  EXPECT_LT(closure.pieces, 1e-12);
  EXPECT_NEAR(debris_in(cut) + cut.squeezed_volume, 200 * 2e-4, 1e-12);
  for (std::size_t e = 0; e < plain.cell.size(); ++e) {
    const auto found = std::ranges::lower_bound(cut.cell, plain.cell[e]) - cut.cell.begin();
    EXPECT_EQ(cut.cell[static_cast<std::size_t>(found)], plain.cell[e]);
    EXPECT_EQ(cut.solid_volume[static_cast<std::size_t>(found)], plain.solid_volume[e]);
  }
  for (std::size_t e = 0; e < cut.cell.size(); ++e)
    EXPECT_LE(cut.debris_volume[e], 0.9 * (grid.cell_volume(cut.cell[e]) - cut.solid_volume[e]) + 1e-17);
}
