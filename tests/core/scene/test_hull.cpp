#include <cmath>
#include <numbers>

#include "core/scene/vehicle_shape.hpp"
#include "tests/core/scene/scene_files.hpp"

namespace polynya::scene {
namespace {

Vehicle hull(const std::string& head, double head_length) {
  Vehicle v;
  v.head = head, v.head_length = head_length, v.diameter = 0.01, v.length = 0.1, v.interior = "hollow";
  return v;
}

TEST(Hull, VolumesAreThoseOfGeometry) {
  using std::numbers::pi;
  const double r = 0.005;
  EXPECT_NEAR(hull_volume(hull("hemisphere", r)) / (pi * r * r * (0.1 - r) + 2.0 / 3 * pi * r * r * r), 1, 1e-9);
  EXPECT_NEAR(hull_volume(hull("ellipsoid", 0.01)) / (pi * r * r * 0.09 + 2.0 / 3 * pi * r * r * 0.01), 1, 1e-9);
  // Tangent ogive, R = (r^2 + L^2) / 2r: pi (L R^2 - L^3/3 - (R - r) R^2 asin(L/R)).
  const double l = 0.01, arc = (r * r + l * l) / (2 * r);
  const double ogive = pi * (l * arc * arc - l * l * l / 3 - (arc - r) * arc * arc * std::asin(l / arc));
  EXPECT_NEAR(hull_volume(hull("ogive", l)) / (pi * r * r * 0.09 + ogive), 1, 1e-9);
}

TEST(Hull, AFullySolidAluminiumVehicleOfThePaperWeighsAbout21Gram) {
  EXPECT_NEAR(2700 * hull_volume(hull("hemisphere", 0.005)), 0.021, 0.0005);
}

TEST(Hull, TheWallFollowsFromTheMass) {
  Vehicle v = hull("ogive", 0.01);
  v.mass = 0.005;
  const double wall = wall_from_mass(v, 2700);
  EXPECT_NEAR(2700 * shell_volume(v, wall), 0.005, 1e-9);
  EXPECT_GT(wall, 0.5e-3);
  EXPECT_LT(wall, 0.8e-3);
}

TEST(Hull, TwentyGramsSolidIsAcceptedAndTwentyGramsHollowIsNot) {
  EXPECT_EQ(base_scene({"vehicle.interior=solid", "vehicle.mass=21 g"}).vehicle->mass, 0.021);
  EXPECT_EQ(base_scene({"vehicle.interior=solid", "vehicle.mass=0"}).vehicle->mass, 0);
  EXPECT_FALSE(message_of_settings({"vehicle.mass=20.3 g"}).empty());
}

}  // namespace
}  // namespace polynya::scene
