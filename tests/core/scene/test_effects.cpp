#include "core/scene/effects.hpp"
#include "tests/core/scene/scene_files.hpp"

namespace polynya::scene {
namespace {

TEST(Effects, EveryEffectIsDecidedWithAReason) {
  for (const std::string name : {"water_exit", "vehicle_drop", "beam_bending", "shock_tube", "dam_break"}) {
    const Scene scene = resolve(case_folder(name));
    for (const auto& effect : effect_names()) {
      EXPECT_EQ(scene.effects.at(effect).requested, "auto") << name << ' ' << effect;
      EXPECT_FALSE(scene.effects.at(effect).reason.empty()) << name << ' ' << effect;
    }
    EXPECT_EQ(scene.effects.size(), effect_names().size());
  }
}

TEST(Effects, TheBaseSceneHasAllThatThisVersionOffers) {
  const Scene scene = base_scene();
  for (const std::string name : {"fluid", "deformable_vehicle", "ice_failure", "conversion", "cavitation", "gravity",
                                 "friction", "non_reflecting_boundaries", "symmetry", "interface_reconstruction"})
    EXPECT_TRUE(scene.effect(name)) << name;
}

TEST(Effects, WhatDoesNotExistYetIsOffAndCannotBeAskedFor) {
  for (const std::string name : {"gradient_correction", "artificial_stress", "debris_drag"}) {
    EXPECT_FALSE(base_scene().effect(name));
    EXPECT_EQ(base_scene().effects.at(name).reason, "not available in this version");
    EXPECT_FALSE(base_scene({"effects." + name + "=off"}).effect(name));
    EXPECT_NE(message_of_settings({"effects." + name + "=on"}).find("not available in this version"),
              std::string::npos);
  }
}

TEST(Effects, FluidSleepsWhereAutoFindsItAtRestAtTheStart) {
  const Scene dam = resolve(case_folder("dam_break"));
  EXPECT_TRUE(dam.effect("sleeping"));
  EXPECT_EQ(dam.fluid->sleeping_threshold, 1e-7);
  EXPECT_NE(dam.effects.at("sleeping").reason.find("1e-07"), std::string::npos) << dam.effects.at("sleeping").reason;
  EXPECT_FALSE(base_scene().effect("sleeping"));
  EXPECT_EQ(base_scene().fluid->sleeping_threshold, 0);
  EXPECT_TRUE(base_scene({"fluid.start=impulsive"}).effect("sleeping"));
  const Scene asked = base_scene({"effects.sleeping=on", "fluid.sleeping_threshold=1e-6"});
  EXPECT_EQ(asked.fluid->sleeping_threshold, 1e-6);
  EXPECT_FALSE(resolve(case_folder("vehicle_drop")).effect("sleeping"));
  EXPECT_NE(
      message_of(case_folder("vehicle_drop"), {.level = {}, .settings = {"effects.sleeping=on"}}).find("no fluid"),
      std::string::npos);
}

TEST(Effects, IceSleepsWhereAutoFindsItAtRestUnderForcesThatBalance) {
  const Scene heavy = resolve(case_folder("vehicle_drop"));
  EXPECT_FALSE(base_scene().effect("ice_sleeping"));
  EXPECT_EQ(base_scene().ice->sleeping_threshold, 0);
  const Scene light = resolve(case_folder("vehicle_drop"), {.level = {}, .settings = {"effects.gravity=off"}});
  EXPECT_TRUE(light.effect("ice_sleeping"));
  EXPECT_EQ(light.ice->sleeping_threshold, 1e-7);
  EXPECT_NE(light.effects.at("ice_sleeping").reason.find("1e-07"), std::string::npos);
  EXPECT_EQ(heavy.effect("ice_sleeping"), heavy.run.gravity == 0);
  const Scene asked = base_scene({"effects.ice_sleeping=on", "ice.sleeping_threshold=1e-6"});
  EXPECT_EQ(asked.ice->sleeping_threshold, 1e-6);
  EXPECT_NE(message_of(case_folder("ice_ball"), {.level = {}, .settings = {"effects.ice_sleeping=on"}}).find("ball"),
            std::string::npos);
}

TEST(Effects, PlanesBetweenWaterAndAirBelongToEveryFluid) {
  for (const std::string name : {"water_exit", "vehicle_in_water", "dam_break", "shock_tube"})
    EXPECT_TRUE(resolve(case_folder(name)).effect("interface_reconstruction")) << name;
  EXPECT_FALSE(resolve(case_folder("vehicle_drop")).effect("interface_reconstruction"));
  EXPECT_TRUE(base_scene({"effects.interface_reconstruction=on"}).effect("interface_reconstruction"));
  const std::string answer = message_of_settings({"effects.interface_reconstruction=off"});
  EXPECT_NE(answer.find("effects.interface_reconstruction"), std::string::npos) << answer;
  EXPECT_NE(answer.find("allowed here: auto, on"), std::string::npos) << answer;
  EXPECT_FALSE(base_scene({"effects.fluid=off"}).effect("interface_reconstruction"));
}

TEST(Effects, DisplacementByDebrisIsThereForThoseWhoAsk) {
  EXPECT_FALSE(base_scene().effect("debris_displacement"));
  EXPECT_TRUE(base_scene({"effects.debris_displacement=on"}).effect("debris_displacement"));
}

TEST(Effects, FluidOffLeavesNoFluidNoWaterAndNoParticipant) {
  const Scene scene = base_scene({"effects.fluid=off"});
  EXPECT_FALSE(scene.effect("fluid"));
  EXPECT_FALSE(scene.fluid.has_value());
  EXPECT_FALSE(scene.effect("cavitation"));
  EXPECT_FALSE(scene.effect("debris_displacement"));
  EXPECT_FALSE(scene.participants.contains("fluid"));
  EXPECT_FALSE(scene.materials.contains("water"));
  EXPECT_TRUE(scene.participants.contains("ice"));
}

TEST(Effects, AFluidCannotBeSwitchedOnWithoutWater) {
  EXPECT_NE(message_of(case_folder("vehicle_drop"), {.level = {}, .settings = {"effects.fluid=on"}}).find("no [water]"),
            std::string::npos);
}

TEST(Effects, ATubeCannotLoseItsFluid) {
  EXPECT_NE(
      message_of(case_folder("shock_tube"), {.level = {}, .settings = {"effects.fluid=off"}}).find("nothing is left"),
      std::string::npos);
}

TEST(Effects, TheSceneAgreesWithTheDecision) {
  const Scene scene = base_scene({"effects.gravity=off", "effects.friction=off", "effects.deformable_vehicle=off",
                                  "effects.non_reflecting_boundaries=off", "effects.symmetry=off"});
  EXPECT_EQ(scene.run.gravity, 0);
  EXPECT_EQ(scene.contact.friction, 0);
  EXPECT_FALSE(scene.vehicle->deformable);
  EXPECT_EQ(scene.ice->sides, "free");
  EXPECT_EQ(scene.fluid->outer_boundary, "wall");
  EXPECT_EQ(scene.symmetry, Symmetry::full);
}

TEST(Effects, ElasticIceDoesNotFail) {
  EXPECT_FALSE(base_scene({"ice.material=aluminium", "water.surface=5 mm"}).effect("ice_failure"));
}

}  // namespace
}  // namespace polynya::scene
