// A fluid that runs alone around prescribed bodies gets the same overlap as one that a coupler sends it.
#include <gtest/gtest.h>

#include "coupler/fluid_side.hpp"
#include "fluid_solver/overlap_message.hpp"
#include "fluid_solver/prescribed_bodies.hpp"
#include "geometry/hull/simple_bodies.hpp"

using namespace polynya;

namespace {

struct Ball {
  std::vector<double> positions, velocities;
  std::vector<std::int32_t> triangles;

  /// Turns about z through the origin, and rises.
  Ball(double diameter, const geometry::Point& centre, double rise, double turn) {
    const geometry::TriangleSoup surface = geometry::sphere_surface(diameter, 0.1);
    for (const geometry::Point& p : surface.points) {
      const geometry::Point at{p[0] + centre[0], p[1] + centre[1], p[2] + centre[2]};
      positions.insert(positions.end(), at.begin(), at.end());
      velocities.insert(velocities.end(), {-turn * at[1], turn * at[0], rise});
    }
    for (const geometry::Triangle& t : surface.triangles)
      for (const std::size_t corner : t) triangles.push_back(static_cast<std::int32_t>(corner));
  }
  geometry::BodySurface view() const { return {positions, velocities, triangles}; }
};

void expect_same(const std::vector<double>& a, const std::vector<double>& b, double most) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t n = 0; n < a.size(); ++n) EXPECT_NEAR(a[n], b[n], most);
}

}  // namespace

TEST(OverlapPaths, DirectAndByMessageAreTheSame) {
  std::vector<double> line;
  for (int i = 0; i <= 16; ++i) line.push_back(-1.6 + 0.2 * i);
  const fluid::Grid grid(line, line, line);
  const geometry::GridLines lines{{line, line, line}};
  const Ball large(1.6, {0.03, -0.02, -0.3}, 2, 0.5), small(0.8, {0.01, 0.05, 0.93}, -1, 0);  // they share cells
  geometry::CutCells cut;
  geometry::Cutter(lines).cut(std::array{large.view(), small.view()}, cut);
  ASSERT_GT(cut.shared_cells, 0);
  exchange::Message message("span");
  coupler::add_overlap(message, cut, lines);
  const fluid::Overlap sent = fluid::read_overlap(message, grid), direct = fluid::overlap_of(cut);
  EXPECT_EQ(sent.cell, direct.cell);
  EXPECT_EQ(sent.walled, direct.walled);
  EXPECT_EQ(sent.face, direct.face);
  for (std::size_t d = 0; d < 3; ++d) expect_same(sent.face_solid[d], direct.face_solid[d], 0);
  expect_same(sent.solid_volume, direct.solid_volume, 1e-15);
  expect_same(sent.wall_area, direct.wall_area, 0);
  expect_same(sent.wall_size, direct.wall_size, 1e-15);
  expect_same(sent.wall_sweep, direct.wall_sweep, 0);
  expect_same(sent.wall_velocity, direct.wall_velocity, 1e-15);
}

TEST(OverlapPaths, ASecondAndAThirdBodyTakeOnePlaceWithoutLoss) {
  std::vector<double> line;
  for (int i = 0; i <= 16; ++i) line.push_back(-1.6 + 0.2 * i);
  const geometry::GridLines lines{{line, line, line}};
  const Ball a(0.8, {-0.9, 0, 0}, 1, 0), b(0.8, {0.03, 0.02, 0}, 2, 0), c(0.8, {0.86, 0.01, 0.03}, -3, 0);
  geometry::CutCells cut;
  geometry::Cutter(lines).cut(std::array{a.view(), b.view(), c.view()}, cut);
  const fluid::Overlap overlap = fluid::overlap_of(cut);
  std::size_t together = 0;
  for (std::size_t e = 0; e < cut.cell.size(); ++e) {
    together += cut.body_volume[3 * e + 1] > 0 && cut.body_volume[3 * e + 2] > 0;
    EXPECT_DOUBLE_EQ(overlap.wall_sweep[2 * e + 1], cut.wall_sweep[3 * e + 1] + cut.wall_sweep[3 * e + 2]);
    for (std::size_t d = 0; d < 3; ++d)
      EXPECT_DOUBLE_EQ(overlap.wall_area[6 * e + 3 + d], cut.wall_area[9 * e + 3 + d] + cut.wall_area[9 * e + 6 + d]);
  }
  EXPECT_GT(together, 0u);
}
