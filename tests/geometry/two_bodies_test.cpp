#include <gtest/gtest.h>

#include "closure.hpp"
#include "geometry/cut_cells.hpp"
#include "shapes.hpp"

using namespace polynya::geometry;
using shapes::Shape;

namespace {

struct Pair {
  Shape ball = shapes::sphere(3), plate = shapes::box(8);
  GridLines grid = shapes::cube_grid(1.0, 16);
  CutCells cut;

  /// The ball (radius 0.4) with its centre at `height`, the plate between z = 0.11 and 0.47.
  explicit Pair(double height) {
    shapes::scale_and_move(ball, {0.4, 0.4, 0.4}, {0.03, -0.02, height});
    shapes::scale_and_move(plate, {1, 1, 0.18}, {0, 0, 0.29});
    Cutter cutter(grid);
    cutter.cut(std::array{ball.surface(), plate.surface()}, cut);
  }

  /// Volume and wall of one body in every cell that it touches must be those of a cut by this body alone.
  void expect_cut_as_if_alone(std::size_t body) const {
    CutCells alone;
    Cutter(grid).cut(std::array{(body == 0 ? ball : plate).surface()}, alone);
    for (std::size_t a = 0; a < alone.cell.size(); ++a) {
      const auto e = static_cast<std::size_t>(std::ranges::lower_bound(cut.cell, alone.cell[a]) - cut.cell.begin());
      ASSERT_TRUE(e < cut.cell.size() && cut.cell[e] == alone.cell[a]);
      EXPECT_EQ(cut.body_volume[2 * e + body], alone.body_volume[a]);
      for (std::size_t d = 0; d < 3; ++d) {
        EXPECT_EQ(cut.wall_area[(2 * e + body) * 3 + d], alone.wall_area[3 * a + d]);
        EXPECT_EQ(cut.wall_velocity[(2 * e + body) * 3 + d], alone.wall_velocity[3 * a + d]);
      }
    }
  }
};

}  // namespace

TEST(TwoBodies, InOneCellAddUpAndEachIsCutAsIfAlone) {
  const Pair pair(-0.3);  // the ball's top at 0.1, under the plate, in the same layer of cells
  const Closure closure = check_closure(pair.cut, pair.grid);
  EXPECT_LT(closure.area, 1e-12);
  EXPECT_EQ(pair.cut.overlapping_cells, 0);
  EXPECT_EQ(pair.cut.corrected_faces, 0);
  std::size_t shared = 0;
  for (std::size_t e = 0; e < pair.cut.cell.size(); ++e)
    shared += pair.cut.body_volume[2 * e] > 0 && pair.cut.body_volume[2 * e + 1] > 0;
  EXPECT_GT(shared, 0u);
  EXPECT_GE(pair.cut.shared_cells, static_cast<std::int64_t>(shared));  // or wall of one in the plane of a side
  for (std::size_t body : {0u, 1u}) pair.expect_cut_as_if_alone(body);
  EXPECT_NEAR(total_volume(pair.cut), shapes::volume(pair.ball) + shapes::volume(pair.plate), 1e-12);
}

TEST(TwoBodies, OverlapCountsOnceAndStillCloses) {
  const Pair pair(-0.2);  // the ball's top is 0.09 inside the plate
  const Closure closure = check_closure(pair.cut, pair.grid);
  EXPECT_GT(pair.cut.united_cells, 0);
  EXPECT_EQ(pair.cut.overlapping_cells, 0);
  EXPECT_EQ(pair.cut.corrected_faces, 0);
  EXPECT_LT(closure.area, 1e-12);    // of the union, which the fluid sees
  EXPECT_LT(closure.pieces, 1e-12);  // what the bodies feel is what the fluid sees
  EXPECT_LE(closure.fraction, 0.0);
  const double sum = shapes::volume(pair.ball) + shapes::volume(pair.plate);
  const double cap = M_PI * 0.09 * 0.09 * (0.4 - 0.03);  // of a ball; that of facets is smaller
  EXPECT_LT(total_volume(pair.cut), sum - 0.8 * cap);
  EXPECT_GT(total_volume(pair.cut), sum - cap);
}

TEST(PressureForces, UniformAndHydrostaticPressureGiveBuoyancyExactly) {
  const Pair pair(-0.35);
  const CutCells& cut = pair.cut;
  const double gradient = 9810, offset = 101325;
  std::vector<double> pressure(cut.cell.size()), gradients(cut.cell.size(), gradient);
  for (std::size_t e = 0; e < cut.cell.size(); ++e) {
    const auto k = static_cast<std::size_t>(pair.grid.cell_position(cut.cell[e])[2]);
    pressure[e] = offset - gradient * 0.5 * (pair.grid.lines[2][k] + pair.grid.lines[2][k + 1]);
  }
  const auto all = pressure_forces(cut, std::array{pair.ball.surface(), pair.plate.surface()}, pressure, gradients);
  const std::vector<double>& forces = all[0].on_vertices;
  shapes::Vector force{0, 0, 0}, moment{0, 0, 0};
  for (std::size_t v = 0; v < pair.ball.vertices(); ++v) {
    const auto x = pair.ball.vertex(static_cast<std::int32_t>(v));
    for (std::size_t d = 0; d < 3; ++d) {
      force[d] += forces[3 * v + d];
      moment[d] += x[(d + 1) % 3] * forces[3 * v + (d + 2) % 3] - x[(d + 2) % 3] * forces[3 * v + (d + 1) % 3];
    }
  }
  const double buoyancy = gradient * shapes::volume(pair.ball);
  EXPECT_NEAR(force[0] / buoyancy, 0.0, 1e-12);
  EXPECT_NEAR(force[1] / buoyancy, 0.0, 1e-12);
  EXPECT_NEAR(force[2] / buoyancy, 1.0, 1e-12);
  // The centre of buoyancy is the centre of the ball: the moment about the origin is x_c x F. Pressure that varies
  // within a piece acts at its centroid, so the moment is right to second order in the size of the pieces.
  EXPECT_NEAR(moment[0] / buoyancy, -0.02, 1e-4);
  EXPECT_NEAR(moment[1] / buoyancy, -0.03, 1e-4);
}
