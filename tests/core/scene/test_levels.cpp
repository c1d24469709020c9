#include "tests/core/scene/scene_files.hpp"

namespace polynya::scene {
namespace {

const char* text = R"(
title = "a scene"
[vehicle]
mass = "5 g"
speed = "40 m/s"
[ice]
thickness = "10 mm"
[level.quick.resolution]
cell = "2 mm"
[level.standard]
resolution.cell = "1 mm"
vehicle.speed = "50 m/s"
)";

TEST(Levels, QuickIsTheDefault) {
  const Scene scene = resolve(scene_file(text));
  EXPECT_EQ(scene.level, "quick");
  EXPECT_DOUBLE_EQ(scene.resolution.cell, 2e-3);
  EXPECT_DOUBLE_EQ(scene.vehicle->speed, 40);
}

TEST(Levels, OverrideAnyKey) {
  const Scene scene = resolve(scene_file(text), {.level = "standard", .settings = {}});
  EXPECT_EQ(scene.level, "standard");
  EXPECT_DOUBLE_EQ(scene.resolution.cell, 1e-3);
  EXPECT_DOUBLE_EQ(scene.vehicle->speed, 50);
  EXPECT_DOUBLE_EQ(scene.ice->thickness, 10e-3);
}

TEST(Levels, SettingsWinOverLevelsAndTheLastSettingWins) {
  const Scene scene =
      resolve(scene_file(text), {.level = "standard", .settings = {"vehicle.speed=55", "vehicle.speed=60 m/s"}});
  EXPECT_DOUBLE_EQ(scene.vehicle->speed, 60);
}

TEST(Levels, ALevelThatTheSceneLacksIsRefused) {
  EXPECT_NE(message_of(scene_file(text), {.level = "fine", .settings = {}}).find("no [level.fine]"), std::string::npos);
  EXPECT_NE(message_of(scene_file(text), {.level = "coarse", .settings = {}}).find("one of quick, standard, fine"),
            std::string::npos);
}

TEST(Levels, AMistakeInALevelThatIsNotChosenIsFound) {
  const auto message = message_of(scene_file(std::string(text) + "[level.fine.vehicle]\nsped = 3\n"));
  EXPECT_NE(message.find("scene.toml:14: unknown key 'vehicle.sped'; did you mean 'vehicle.speed'?"), std::string::npos)
      << message;
}

TEST(Settings, TakeBareWordsNumbersTextsAndQuantities) {
  EXPECT_EQ(base_scene({"symmetry=full"}).symmetry, Symmetry::full);
  EXPECT_EQ(base_scene({"symmetry=\"half\""}).symmetry, Symmetry::half);
  EXPECT_DOUBLE_EQ(base_scene({"vehicle.speed=60"}).vehicle->speed, 60);
  EXPECT_DOUBLE_EQ(base_scene({"vehicle.speed=60 m/s"}).vehicle->speed, 60);
  EXPECT_DOUBLE_EQ(base_scene({"vehicle.speed=\"60 m/s\""}).vehicle->speed, 60);
  EXPECT_DOUBLE_EQ(base_scene({"ice.thickness = 20 mm"}).ice->thickness, 0.02);
}

TEST(Settings, ReachTheValuesOfACard) {
  for (const std::string key :
       {"materials.\"ice.paper\".damage_constant=0.1", "materials.ice.paper.damage_constant=0.1"}) {
    const auto card = base_scene({key}).material("ice.paper");
    EXPECT_DOUBLE_EQ(card.value("damage_constant"), 0.1);
    EXPECT_NE(card.origin.at("damage_constant").find("given by the scene"), std::string::npos);
    EXPECT_DOUBLE_EQ(card.value("damage_exponent"), 0.5);
  }
}

}  // namespace
}  // namespace polynya::scene
