#include "geometry/exact_cut.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/surface_check.hpp"
#include "shapes.hpp"

using namespace polynya::geometry;
using shapes::Shape;

namespace {

const GridLines grid{
    {shapes::lines(-1.6, 1.7, 13), shapes::lines(-1.65, 1.6, 11, 0.9), shapes::lines(-1.7, 1.6, 15, 1.1)}};

Shape random_body(int kind, std::mt19937& random) {
  Shape body = kind == 0 ? shapes::sphere(2) : kind == 1 ? shapes::cylinder(24) : shapes::box(2);
  shapes::scale_and_move(body, {0.8, 0.6, 0.7}, {0, 0, 0});
  shapes::rotate_randomly(body, random);
  std::uniform_real_distribution<double> uniform(-0.2, 0.2);
  shapes::scale_and_move(body, {1, 1, 1}, {uniform(random), uniform(random), uniform(random)});
  return body;
}

}  // namespace

TEST(ExactCut, AgreesWithTheCutByColumnsInVolumeAndArea) {
  std::mt19937 random(17);
  Cutter cutter(grid);
  CutCells cut;
  for (int kind : {0, 1, 2}) {
    const Shape body = random_body(kind, random);
    cutter.cut(std::array{body.surface()}, cut);
    std::vector<std::size_t> walls;
    for (const WallPiece& piece : cut.pieces) walls.push_back(static_cast<std::size_t>(piece.entry));
    std::ranges::sort(walls);
    walls.erase(std::ranges::unique(walls).begin(), walls.end());
    std::ranges::shuffle(walls, random);
    for (std::size_t s = 0; s < 15; ++s) {
      const std::size_t e = walls[s];
      const ExactCell exact = exact_cut(grid, cut.cell[e], body.surface());
      const double volume = grid.cell_volume(cut.cell[e]);
      EXPECT_NEAR(cut.solid_volume[e] / volume, exact.volume / volume, 1e-12);
      for (std::size_t d = 0; d < 3; ++d)
        EXPECT_NEAR(-cut.wall_area[3 * e + d] / std::cbrt(volume * volume), exact.area[d] / std::cbrt(volume * volume),
                    1e-12);
    }
  }
}

TEST(ExactCut, SampleOfTwoBodiesAgreesAndASpoiledCutIsNoticed) {
  std::mt19937 random(23);
  Shape ball = shapes::sphere(2), plate = shapes::box(6);
  shapes::scale_and_move(ball, {0.4, 0.4, 0.4}, {0.11, -0.07, -0.6});
  shapes::scale_and_move(plate, {1.65, 1.625, 0.3}, {0.05, -0.025, 0.4});
  const std::array bodies{ball.surface(), plate.surface()};
  Cutter cutter(grid);
  CutCells cut;
  cutter.cut(bodies, cut);
  EXPECT_LT(verify_sample(cut, bodies, grid, 1, 20), 1e-12);
  EXPECT_LT(verify_sample(cut, bodies, grid, 2, 20), 1e-12);
  for (std::size_t e = 0; e < cut.cell.size(); ++e) cut.body_volume[2 * e] += 1e-9 * grid.cell_volume(cut.cell[e]);
  EXPECT_NEAR(verify_sample(cut, bodies, grid, 1, 20), 1e-9, 1e-11);
}

TEST(ExactCut, CoincidentPlanesGiveTheSameVolumes) {
  const GridLines cubes = shapes::cube_grid(1.0, 8);
  Shape body = shapes::box(3);
  shapes::scale_and_move(body, {0.5, 0.375, 0.25}, {0.25, 0.125, 0.0});
  Cutter cutter(cubes);
  CutCells cut;
  const std::array bodies{body.surface()};
  cutter.cut(bodies, cut);
  EXPECT_LT(verify_sample(cut, bodies, cubes, 3, 40), 1e-13);
}

TEST(ExactCut, ExactNumbersInTheClippingGiveTheSameCutToRounding) {
  std::mt19937 random(29);
  const Shape body = random_body(0, random);
  Cutter packed(grid), exact(grid);
  exact.set_method(clip_exactly);
  CutCells a, b;
  packed.cut(std::array{body.surface()}, a);
  exact.cut(std::array{body.surface()}, b);
  ASSERT_EQ(a.cell, b.cell);
  for (std::size_t e = 0; e < a.cell.size(); ++e) {
    const double volume = grid.cell_volume(a.cell[e]), face = std::cbrt(volume * volume);
    EXPECT_NEAR(a.body_volume[e] / volume, b.body_volume[e] / volume, 1e-13);
    for (std::size_t d = 0; d < 3; ++d)
      EXPECT_NEAR(a.wall_area[3 * e + d] / face, b.wall_area[3 * e + d] / face, 1e-13);
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    ASSERT_EQ(a.faces[axis].face, b.faces[axis].face);
    for (std::size_t f = 0; f < a.faces[axis].face.size(); ++f)
      EXPECT_NEAR(a.faces[axis].solid[f], b.faces[axis].solid[f], 1e-13);
  }
  ASSERT_EQ(a.pieces.size(), b.pieces.size());
}

TEST(ExactCut, VolumesThatRoundingSpoilsAreKnownAndRecut) {
  // A kilometre from the origin doubles resolve 1e-13 m, with cells of 1 mm: the volumes are wrong in the tenth digit.
  const double far = 1000, size = 1e-3;
  const GridLines cubes{{shapes::lines(far, far + 8 * size, 8), shapes::lines(far, far + 8 * size, 8),
                         shapes::lines(far, far + 8 * size, 8)}};
  std::mt19937 random(31);
  Shape body = shapes::sphere(2);
  shapes::rotate_randomly(body, random);
  shapes::scale_and_move(body, {3 * size, 3 * size, 3 * size}, {far + 4 * size, far + 4 * size, far + 4 * size});
  Cutter cutter(cubes);
  CutCells cut;
  const std::array bodies{body.surface()};
  cutter.cut(bodies, cut);
  const CutCells before = cut;
  const std::size_t recut = recut_uncertain(cut, bodies, cubes);
  EXPECT_GT(recut, 100u);
  EXPECT_LT(verify_sample(cut, bodies, cubes, 5, 60), 1e-11);
  // The bound that made them uncertain was one: no cell was off by more than a few times what it was doubted for.
  double worst = 0;
  for (std::size_t e = 0; e < cut.cell.size(); ++e)
    worst = std::max(worst, std::abs(cut.body_volume[e] - before.body_volume[e]) / cubes.cell_volume(cut.cell[e]));
  EXPECT_GT(worst, 1e-13);
  EXPECT_LT(worst, 32 * 0x1p-53 * far / size * 4);
  // Near the origin nothing is in doubt.
  const Shape near = random_body(1, random);
  Cutter(grid).cut(std::array{near.surface()}, cut);
  EXPECT_TRUE(cut.uncertain.empty());
}

TEST(SurfaceCheck, AcceptsClosedOutwardSurfacesAndMeasuresThem) {
  for (const Shape& body : {shapes::sphere(2), shapes::cylinder(12), shapes::box(3)}) {
    const SurfaceCheck check = check_surface(body.positions, body.triangles);
    EXPECT_TRUE(check.good()) << check.text;
    EXPECT_TRUE(check.closed);
    EXPECT_NEAR(check.volume, shapes::volume(body), 1e-12);
  }
}

TEST(SurfaceCheck, NamesWhatIsWrong) {
  Shape open = shapes::box();
  open.triangles.resize(open.triangles.size() - 3);
  EXPECT_NE(check_surface(open.positions, open.triangles).text.find("open edges"), std::string::npos);

  Shape inward = shapes::box();
  for (std::size_t t = 0; t < inward.triangles.size(); t += 3) std::swap(inward.triangles[t], inward.triangles[t + 1]);
  const SurfaceCheck turned = check_surface(inward.positions, inward.triangles);
  EXPECT_NE(turned.text.find("into the body"), std::string::npos);
  EXPECT_NEAR(turned.volume, -8.0, 1e-12);

  Shape twisted = shapes::box();
  std::swap(twisted.triangles[0], twisted.triangles[1]);
  EXPECT_FALSE(check_surface(twisted.positions, twisted.triangles).manifold);

  Shape folded = shapes::sphere(2);
  folded.positions[0] *= -1.5, folded.positions[1] *= -1.5, folded.positions[2] *= -1.5;
  EXPECT_TRUE(check_surface(folded.positions, folded.triangles).self_intersects);
}

TEST(ExactCut, AgreesInCellsThatTwoTouchingSpheresShare) {
  // Vertices of an icosahedron: opposite ones touch when the spheres stand two radii apart along that diameter.
  const double g = (1.0 + std::sqrt(5.0)) / 2.0, unit = 1 / std::sqrt(1 + g * g), radius = 0.5;
  Shape lower = shapes::sphere(2), upper = lower;
  const shapes::Vector step{-unit, g * unit, 0};
  shapes::scale_and_move(lower, {radius, radius, radius}, {0.013, -0.5, 0.021});
  shapes::scale_and_move(upper, {radius, radius, radius},
                         {0.013 + 2 * radius * step[0], -0.5 + 2 * radius * step[1], 0.021 + 2 * radius * step[2]});
  CutCells cut;
  Cutter(grid).cut(std::array{lower.surface(), upper.surface()}, cut);
  EXPECT_GT(cut.shared_cells, 0);
  EXPECT_EQ(cut.overlapping_cells, 0);
  std::size_t both = 0;
  double total = 0;
  for (std::size_t e = 0; e < cut.cell.size(); ++e) {
    const double cell = grid.cell_volume(cut.cell[e]);
    total += cut.solid_volume[e];
    if (cut.body_volume[2 * e] <= 0 || cut.body_volume[2 * e + 1] <= 0) continue;
    ++both;
    const double first = exact_cut(grid, cut.cell[e], lower.surface()).volume,
                 second = exact_cut(grid, cut.cell[e], upper.surface()).volume;
    EXPECT_NEAR(cut.body_volume[2 * e], first, 1e-12 * cell);
    EXPECT_NEAR(cut.body_volume[2 * e + 1], second, 1e-12 * cell);
    EXPECT_NEAR(cut.solid_volume[e], first + second, 1e-12 * cell);  // with what is left free: the cell
  }
  EXPECT_GT(both, 0u);
  EXPECT_NEAR(total, shapes::volume(lower) + shapes::volume(upper), 1e-12);
}
