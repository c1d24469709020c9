#include "core/scene/body_motion.hpp"

#include <numbers>

#include "tests/core/scene/scene_files.hpp"

namespace polynya::scene {
namespace {

const std::string surroundings =
    "[run]\nend_time = \"4 ms\"\n[water]\n[air]\n[fluid]\nlength = \"80 mm\"\nwidth = \"80 mm\"\n";

Scene scene_with(const std::string& keys) {
  return resolve(scene_file(
      surroundings + "[body.block]\nshape = \"box\"\nlength = \"8 mm\"\nwidth = \"6 mm\"\nheight = \"4 mm\"\n" + keys));
}
const Body& block(const Scene& scene) {
  return scene.fluid->bodies->at("block");
}

TEST(BodyMotion, PlaceIsTheIntegralOfTheTableOfVelocities) {
  const Scene scene = scene_with(
      "position = \"0, 0, -40 mm\"\nvelocity = \"0, 0, 0 at 0; 2 m/s, 0, 4 m/s at 1 ms; 2 m/s, 0, 0 at 3 ms\"\n");
  const Body& body = block(scene);
  EXPECT_DOUBLE_EQ(velocity_at(body, 0.5e-3)[2], 2);
  EXPECT_DOUBLE_EQ(velocity_at(body, 2e-3)[2], 2);
  EXPECT_DOUBLE_EQ(velocity_at(body, 9e-3)[0], 2);
  EXPECT_NEAR(pose_at(body, 0.5e-3).position[2], -40e-3 + 0.5e-3, 1e-15);
  EXPECT_NEAR(pose_at(body, 2e-3).position[2], -40e-3 + 2e-3 + 3e-3, 1e-15);
  EXPECT_NEAR(pose_at(body, 4e-3).position[2], -40e-3 + 2e-3 + 4e-3, 1e-15);
  EXPECT_NEAR(pose_at(body, 4e-3).position[0], 1e-3 + 6e-3, 1e-15);
}

TEST(BodyMotion, TurningIsRightHandedThroughTheReferencePoint) {
  const Scene scene = scene_with(
      "position = \"1 mm, 0, -40 mm\"\nrotation_rate = \"0 at 0; 1000 rad/s at 1 ms\"\nrotation_axis = \"y\"\n");
  const Body& body = block(scene);
  EXPECT_DOUBLE_EQ(rotation_at(body, 0.25e-3), 250);
  EXPECT_NEAR(pose_at(body, 2e-3).turned, 0.5 + 1, 1e-12);
  const Vector p = placed(body, {{1e-3, 0, -40e-3}, std::numbers::pi / 2}, {3e-3, 2e-3, 0});  // x turns to -z
  EXPECT_NEAR(p[0], 1e-3, 1e-15);
  EXPECT_NEAR(p[1], 2e-3, 1e-15);
  EXPECT_NEAR(p[2], -43e-3, 1e-15);
}

TEST(BodyMotion, AnglesTurnAboutXThenYThenZ) {
  const Scene scene = scene_with("position = \"0, 0, -40 mm\"\nangles = \"90 deg, 0, 90 deg\"\n");
  Vector low{1, 1, 1}, high{-1, -1, -1};
  for (const auto& p : body_surface(block(scene), 1e-3).points)
    for (std::size_t d = 0; d < 3; ++d) low[d] = std::min(low[d], p[d]), high[d] = std::max(high[d], p[d]);
  // About x: 8, 4, 6; then about z: 4, 8, 6.
  EXPECT_NEAR(high[0] - low[0], 4e-3, 1e-15);
  EXPECT_NEAR(high[1] - low[1], 8e-3, 1e-15);
  EXPECT_NEAR(high[2] - low[2], 6e-3, 1e-15);
}

TEST(BodyMotion, SymmetryIsThatOfBodiesAndMotion) {
  const std::string place = "position = \"0, 0, -40 mm\"\n";
  EXPECT_EQ(scene_with(place).symmetry, Symmetry::quarter);
  EXPECT_EQ(scene_with(place + "velocity = \"1 m/s, 0, 0\"\n").symmetry, Symmetry::half);
  EXPECT_EQ(scene_with(place + "rotation_rate = \"1 rad/s\"\n").symmetry, Symmetry::full);
  EXPECT_EQ(scene_with("position = \"0, 1 mm, -40 mm\"\n").symmetry, Symmetry::full);
}

TEST(BodyMotion, BoxAndGridHoldAllThatTheBodyPassesThrough) {
  const Scene scene = scene_with("position = \"0, 0, -40 mm\"\nvelocity = \"0, 0, 5 m/s\"\n");
  EXPECT_NEAR(block(scene).low[2], -42e-3, 1e-15);
  EXPECT_NEAR(block(scene).high[2], -18e-3, 1e-12);
  EXPECT_NEAR(block(scene).volume, 192e-9, 1e-20);
}

}  // namespace
}  // namespace polynya::scene
