#include "tests/core/scene/scene_files.hpp"

namespace polynya::scene {
namespace {

Scene tube(const std::vector<std::string>& settings) {
  return resolve(case_folder("shock_tube"), {.level = {}, .settings = settings});
}

TEST(GridMotion, EndsTakeTheSpeedOfAllPlanesUnlessTheyHaveTheirOwn) {
  EXPECT_FALSE(tube({}).fluid->grid_motion);
  EXPECT_FALSE(tube({"fluid.grid_motion.x.speed=0"}).fluid->grid_motion);
  const Scene scene =
      tube({"fluid.grid_motion.x.speed=\"40 m/s\"", "fluid.grid_motion.x.upper_speed=-3",
            "fluid.grid_motion.x.times=\"0, 1 ms\"", "fluid.grid_motion.x.lower_displacement=\"0, 4 mm\""});
  const AxisMotion& x = scene.fluid->grid_motion->x;
  EXPECT_EQ(x.lower_speed, 40);
  EXPECT_EQ(x.upper_speed, -3);
  EXPECT_EQ(x.times, (std::vector<double>{0, 1e-3}));
  EXPECT_EQ(x.lower_displacement, (std::vector<double>{0, 4e-3}));
  EXPECT_EQ(x.upper_displacement, (std::vector<double>{0, 0}));
  EXPECT_EQ(to_json(from_json(to_json(scene))), to_json(scene));
}

TEST(GridMotion, FollowsAVehicleInWater) {
  const auto in_water = [](const std::string& whom) {
    return resolve(case_folder("vehicle_in_water"),
                   {.level = {}, .settings = {"fluid.grid_follows=\"" + whom + "\"", "run.end_time=\"2 ms\""}});
  };
  const Scene at_rest = in_water("none"), follows = in_water("vehicle");
  EXPECT_EQ(follows.fluid->grid_follows, "vehicle");
  EXPECT_FALSE(follows.effect("sleeping"));
  // No room is needed for the way that the grid goes along.
  const double way = follows.vehicle->speed * follows.run.end_time;
  EXPECT_GT(way, 0.05);
  EXPECT_LT(follows.fluid->top, at_rest.fluid->top + 1e-12);
  EXPECT_GE(at_rest.fluid->top, at_rest.vehicle->nose_position + way);
  EXPECT_EQ(to_json(from_json(to_json(follows))), to_json(follows));
}

TEST(GridMotion, WhatCannotBeFollowedIsOneSentence) {
  const auto refused = [](const char* scene, std::vector<std::string> settings, const std::string& words) {
    settings.push_back("fluid.grid_follows=\"vehicle\"");
    const std::string message = message_of(case_folder(scene), {.level = {}, .settings = settings});
    EXPECT_NE(message.find(words), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  };
  refused("water_exit", {}, "the grid follows no vehicle beside [ice]");
  refused("sphere_in_water", {}, "there is no [vehicle] to follow");
  refused("vehicle_in_water", {"fluid.outer_boundary=\"wall\""}, "as pistons do");
  refused("vehicle_in_water", {"fluid.sweeps=\"all_orders\""}, "alternating orders");
}

TEST(GridMotion, WhatCannotMoveIsOneSentence) {
  const auto refused = [](const std::string& message, const std::string& words) {
    EXPECT_NE(message.find(words), std::string::npos) << message;
  };
  refused(message_of_settings({"fluid.grid_motion.z.speed=40"}),
          "only with [tube], or with [water] and [air] around no solid");
  const auto of_tube = [](const std::string& setting) {
    return message_of(case_folder("shock_tube"), {.level = {}, .settings = {setting}});
  };
  refused(of_tube("fluid.grid_motion.z.speed=1"),
          "only fluid.shock_viscosity, fluid.sleeping_threshold and fluid.grid_motion.x");
  refused(of_tube("fluid.grid_motion.x.times=\"1, 2\""), "a list with commas that begins with 0");
  refused(of_tube("fluid.grid_motion.x.times=\"0, 2 mm\""), "' 2 mm' is not a time");
  refused(of_tube("fluid.grid_motion.x.times=\"0, 2, 1\""), "must ascend");
  refused(of_tube("fluid.grid_motion.x.lower_displacement=\"0, 1\""),
          "one entry for each of fluid.grid_motion.x.times");
}

}  // namespace
}  // namespace polynya::scene
