#include "core/scene/graded_line.hpp"
#include "tests/core/scene/scene_files.hpp"

#include <algorithm>
#include <cmath>

namespace polynya::scene {
namespace {

bool is_node(const std::vector<double>& line, double value) {
  return std::any_of(line.begin(), line.end(), [&](double x) { return std::abs(x - value) < 1e-12; });
}

void expect_graded(const std::vector<double>& line, double growth, double largest = 1e9) {
  for (std::size_t i = 1; i < line.size(); ++i) {
    EXPECT_GT(line[i], line[i - 1]);
    EXPECT_LE(line[i] - line[i - 1], largest * (1 + 1e-9));
  }
  for (std::size_t i = 2; i < line.size(); ++i) {
    const double ratio = (line[i] - line[i - 1]) / (line[i - 1] - line[i - 2]);
    EXPECT_LE(std::max(ratio, 1 / ratio), growth * (1 + 1e-9)) << "at " << line[i - 1];
  }
}

TEST(GradedLine, HitsItsEndsAndObeysTheGrowth) {
  for (const double hi : {0.1, 0.0731, 0.0304, 0.2})
    for (const double cell : {2e-3, 1e-3, 0.7e-3}) {
      const auto line = graded_line(-0.11, hi, -0.02, 0.025, cell, 1.15);
      EXPECT_EQ(line.front(), -0.11);
      EXPECT_EQ(line.back(), hi);
      EXPECT_NE(std::find(line.begin(), line.end(), -0.02), line.end());
      EXPECT_NE(std::find(line.begin(), line.end(), 0.025), line.end());
      expect_graded(line, 1.15);
    }
}

TEST(GradedLine, IsUniformInTheFinePart) {
  const auto line = graded_line(0, 0.1, 0, 0.02, 2e-3, 1.15);
  for (int i = 0; i <= 10; ++i) EXPECT_NEAR(line[i], i * 2e-3, 1e-15);
  EXPECT_GT(line[11] - line[10], 2e-3);
}

TEST(GradedLine, KeepsBelowTheLargestCell) {
  const auto line = graded_line(0, 0.3, 0, 0.03, 2e-3, 1.15, 5e-3);
  expect_graded(line, 1.15, 5e-3);
  EXPECT_EQ(line.back(), 0.3);
}

TEST(GradedLine, AShortRemainderJoinsTheFinePart) {
  const auto line = graded_line(0, 0.0205, 0, 0.02, 2e-3, 1.15);
  EXPECT_EQ(line.back(), 0.0205);
  EXPECT_EQ(line.size(), 11u);
  expect_graded(line, 1.0 + 1e-9);
}

TEST(GradedLine, WithoutGrowthIsUniform) {
  expect_graded(graded_line(0, 0.1, 0, 0.02, 2e-3, 1.0), 1.0 + 1e-9);
}

TEST(GradedLine, RefusesWhatIsNoInterval) {
  EXPECT_THROW(graded_line(0, 1, 0.5, 0.4, 0.1, 1.1), std::invalid_argument);
  EXPECT_THROW(graded_line(0, 1, 0, 2, 0.1, 1.1), std::invalid_argument);
  EXPECT_THROW(graded_line(0, 1, 0, 1, 0, 1.1), std::invalid_argument);
}

TEST(FluidGridLines, HaveNodesAtBothFacesOfTheIceAndHoldTheVehicle) {
  for (const std::string thickness : {"10 mm", "20 mm", "13 mm"})
    for (const std::string speed : {"20", "40", "80"}) {
      const Scene scene = base_scene({"ice.thickness=" + thickness, "vehicle.speed=" + speed});
      const GridLines lines = fluid_grid_lines(scene);
      EXPECT_TRUE(is_node(lines.z, 0));
      EXPECT_TRUE(is_node(lines.z, scene.ice->thickness));
      EXPECT_LE(lines.z.front(), -0.12);
      EXPECT_GE(lines.z.back(), scene.ice->thickness + 0.03 - 1e-12);
      EXPECT_GT(lines.z.back(), scene.vehicle->nose_position + scene.vehicle->speed * scene.run.end_time);
      expect_graded(lines.z, 1.2);
      expect_graded(lines.x, 1.15);
    }
}

TEST(FluidGridLines, BeginAtTheLowerFaceOfIceThatIsTheFloor) {
  const Scene scene = resolve(case_folder("plate_under_water"));
  const GridLines lines = fluid_grid_lines(scene);
  EXPECT_EQ(lines.z.front(), -0.05);
  EXPECT_TRUE(is_node(lines.z, 0));
  EXPECT_NEAR(lines.z.back(), 2.2, 1e-12);
}

TEST(FluidGridLines, AreFineFromTheTailUpward) {
  const auto lines = fluid_grid_lines(base_scene());
  for (std::size_t i = lines.z.size() - 1; lines.z[i] > -0.104; --i)
    EXPECT_NEAR(lines.z[i] - lines.z[i - 1], 2e-3, 1e-9);
}

TEST(FluidGridLines, RespectTheSymmetry) {
  const auto quarter = fluid_grid_lines(base_scene()), half = fluid_grid_lines(base_scene({"symmetry=half"})),
             full = fluid_grid_lines(base_scene({"symmetry=full"}));
  EXPECT_EQ(quarter.x.front(), 0);
  EXPECT_EQ(quarter.y.front(), 0);
  EXPECT_EQ(half.x.front(), -0.1);
  EXPECT_EQ(half.y.front(), 0);
  EXPECT_EQ(full.y.front(), -0.1);
  EXPECT_EQ(full.cells(), 4 * quarter.cells());
  EXPECT_EQ(half.cells(), 2 * quarter.cells());
  for (std::size_t i = 0; i < full.x.size(); ++i) EXPECT_EQ(full.x[i], -full.x[full.x.size() - 1 - i]);
}

TEST(FluidGridLines, OfATubeAreUniformWithANodeAtTheDiaphragm) {
  const auto lines = fluid_grid_lines(resolve(case_folder("shock_tube")));
  EXPECT_EQ(lines.x.size(), 201u);
  EXPECT_TRUE(is_node(lines.x, 0.5));
  EXPECT_EQ(lines.cells(), 200u);
}

TEST(FluidGridLines, OfADamAreUniformWithNodesAtTheColumnsFaces) {
  const auto lines = fluid_grid_lines(resolve(case_folder("dam_break")));
  EXPECT_TRUE(is_node(lines.x, 0.05715));
  EXPECT_TRUE(is_node(lines.z, 0.1143));
  EXPECT_EQ(lines.cells(), 60u * 25u);
}

TEST(IceGridLines, FillThePlateWithEqualLayers) {
  const Scene scene = base_scene();
  const auto lines = ice_grid_lines(scene);
  EXPECT_EQ(lines.x.front(), 0);
  EXPECT_EQ(lines.x.back(), 0.1);
  EXPECT_EQ(lines.z.size(), 6u);
  EXPECT_EQ(lines.z.back(), 0.01);
  expect_graded(lines.x, 1.15, 0.01);
  for (std::size_t i = 1; lines.x[i] < 0.03 + 1e-12; ++i) EXPECT_NEAR(lines.x[i] - lines.x[i - 1], 2e-3, 1e-12);
}

TEST(IceGridLines, OfABeamHaveNodesAtTheRollers) {
  const Scene scene = resolve(case_folder("beam_bending"), {.level = {}, .settings = {"symmetry=full"}});
  const auto lines = ice_grid_lines(scene);
  for (const double x : {-0.215, -0.1875, -0.0625, 0.0, 0.0625, 0.1875, 0.215}) EXPECT_TRUE(is_node(lines.x, x)) << x;
  EXPECT_EQ(lines.z.size(), 6u);
}

}  // namespace
}  // namespace polynya::scene
