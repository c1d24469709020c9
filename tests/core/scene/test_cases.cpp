#include "tests/core/scene/scene_files.hpp"

namespace polynya::scene {
namespace {

TEST(Cases, AllResolveAtAllLevels) {
  int count = 0;
  for (const auto& item : std::filesystem::directory_iterator(std::filesystem::path(POLYNYA_SOURCE_DIR) / "cases")) {
    if (!std::filesystem::exists(item.path() / "scene.toml")) continue;
    if (wanted_mesh(item.path(), {})) continue;  // ./polynya reads the file: tests/end_to_end/test_meshed_ice.py
    for (const std::string level : {"quick", "standard", "fine"})
      EXPECT_EQ(message_of(item.path(), {.level = level, .settings = {}}), "") << item.path();
    ++count;
  }
  EXPECT_GE(count, 4);
}

TEST(Cases, TheBaseSceneIsThatOfThePaper) {
  const Scene scene = base_scene();
  EXPECT_EQ(scene.name, "water_exit");
  EXPECT_EQ(scene.symmetry, Symmetry::quarter);
  EXPECT_DOUBLE_EQ(scene.vehicle->speed, 40);
  EXPECT_DOUBLE_EQ(scene.vehicle->nose_position, -4e-3);
  EXPECT_DOUBLE_EQ(scene.vehicle->mass, 5e-3);
  EXPECT_DOUBLE_EQ(scene.ice->thickness, 10e-3);
  EXPECT_DOUBLE_EQ(scene.ice->critical_strain, 0.35);
  EXPECT_DOUBLE_EQ(scene.fluid->waterline, 9e-3);  // draught 900 / 1000 of 10 mm
  EXPECT_LE(scene.fluid->bottom, -0.12);
  EXPECT_DOUBLE_EQ(scene.fluid->vapour_pressure, 2339);
  EXPECT_DOUBLE_EQ(scene.run.end_time, 1.5e-3);
  EXPECT_EQ(scene.run.end, "ice_passed");
  EXPECT_EQ(scene.participants.size(), 3u);
}

TEST(Cases, TheEndFollowsSpeedAndThickness) {
  EXPECT_NEAR(base_scene({"vehicle.speed=80"}).run.end_time, 0.75e-3, 1e-12);
  EXPECT_GT(base_scene({"ice.thickness=40 mm"}).run.end_time, 1.5 * 1.69e-3);  // the paper is through in 1.69 ms
  EXPECT_DOUBLE_EQ(base_scene({"run.end_time=2 ms"}).run.end_time, 2e-3);
}

TEST(Cases, WaterWithoutIceIsAtZero) {
  const Scene scene = resolve(scene_file("[vehicle]\nmass = \"5 g\"\n[water]\n[air]\n"));
  EXPECT_EQ(scene.fluid->waterline, 0);
  EXPECT_EQ(scene.run.end, "exited");
  EXPECT_DOUBLE_EQ(scene.vehicle->nose_position, -4e-3);
  EXPECT_FALSE(scene.effect("conversion"));
}

TEST(Cases, AVehicleAloneFliesForATime) {
  EXPECT_EQ(resolve(scene_file("[run]\nend_time = \"1 ms\"\n[vehicle]\nmass = \"5 g\"\n")).run.end, "time");
  EXPECT_NE(message_of(scene_file("[run]\nend = \"exited\"\n[vehicle]\nmass = \"5 g\"\n")).find("[ice] or [water]"),
            std::string::npos);
}

TEST(Cases, VehicleDropHasTheGeometryOfTheBaseScene) {
  const Scene drop = resolve(case_folder("vehicle_drop")), base = base_scene();
  const auto a = to_json(drop), b = to_json(base);
  for (const char* part : {"vehicle", "ice", "resolution", "contact", "run"}) EXPECT_EQ(a.at(part), b.at(part)) << part;
  EXPECT_FALSE(drop.fluid.has_value());
}

}  // namespace
}  // namespace polynya::scene
