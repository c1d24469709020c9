#include "tests/core/scene/scene_files.hpp"

namespace polynya::scene {
namespace {

/// One line that holds all of these words.
void expect_message(const std::string& message, const std::vector<std::string>& words) {
  EXPECT_FALSE(message.empty());
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  for (const auto& word : words) EXPECT_NE(message.find(word), std::string::npos) << message << "\nlacks: " << word;
}

TEST(SceneErrors, AnUnknownKeyIsNamedWithItsLineAndTheNearestSpelling) {
  const auto file = scene_file("title = \"x\"\n\n[vehicle]\nmass = \"5 g\"\nsped = \"40 m/s\"\n");
  expect_message(message_of(file), {file.string() + ":5: ", "'vehicle.sped'", "did you mean 'vehicle.speed'?"});
}

TEST(SceneErrors, AnUnknownTableIsNamedBeforeItsKeys) {
  const auto file = scene_file("[vehicel]\nmass = \"5 g\"\n");
  expect_message(message_of(file), {":1: ", "unknown table 'vehicel'", "did you mean 'vehicle'?"});
}

TEST(SceneErrors, AKeyOfAnotherTableIsFound) {
  expect_message(message_of_settings({"vehicle.deformable=true"}), {"did you mean 'effects.deformable_vehicle'?"});
  expect_message(message_of_settings({"speed=3"}), {"did you mean 'vehicle.speed'?"});
}

TEST(SceneErrors, AWrongDimensionSaysWhatIsNeeded) {
  const auto file = scene_file("[vehicle]\nmass = \"5 g\"\nspeed = \"40 mm\"\n");
  expect_message(message_of(file),
                 {":3: vehicle.speed = \"40 mm\"", "wrong dimension, found m", "a speed such as \"40 m/s\""});
}

TEST(SceneErrors, BrokenTomlIsOneLine) {
  const auto file = scene_file("[vehicle]\nspeed = 40 m/s\n");
  expect_message(message_of(file), {file.string() + ":2: not valid TOML"});
}

TEST(SceneErrors, AMissingFileIsNamed) {
  expect_message(message_of("/no/such/folder"), {"/no/such/folder: no such file"});
}

struct Impossible {
  std::vector<std::string> settings;
  std::vector<std::string> words;
};

TEST(SceneErrors, ImpossibleValuesSayWhatIsAllowed) {
  const std::vector<Impossible> list{
      {{"ice.thickness=-1 mm"}, {"ice.thickness = \"-1 mm\"", "above 0"}},
      {{"ice.thickness=0"}, {"above 0"}},
      {{"vehicle.speed=-3"}, {"at least 0, at most 1000 m/s"}},
      {{"vehicle.head=ogve"}, {"one of ogive, hemisphere, ellipsoid", "did you mean ogive?"}},
      {{"vehicle.mass=0.1 g"}, {"too small for a hollow hull", "allowed is"}},
      {{"vehicle.mass=5 kg"}, {"too large for a hollow hull", "allowed is"}},
      {{"vehicle.interior=solid"}, {"scene.toml:", "vehicle.mass = \"5 g\"", "solid hull of this shape in aluminium"}},
      {{"vehicle.mass=0"}, {"needs vehicle.mass or vehicle.wall_thickness"}},
      {{"vehicle.wall_thickness=1 mm"}, {"exclude each other"}},
      {{"vehicle.mass=0", "vehicle.wall_thickness=6 mm"}, {"leaves no cavity", "at most 4.5 mm"}},
      {{"vehicle.head_length=4 mm"}, {"ogive", "half a diameter"}},
      {{"vehicle.head=hemisphere", "vehicle.head_length=10 mm"}, {"hemisphere"}},
      {{"vehicle.nose_position=1 mm"}, {"must be below ice.lower_face"}},
      {{"ice.material=ice.papr"}, {"no card of that name", "did you mean 'ice.paper'?"}},
      {{"ice.material=water"}, {"must be johnson_holmquist_2 or j2_plastic or elastic"}},
      {{"materials.\"ice.paper\".damage_constan=1"}, {"did you mean 'damage_constant'?"}},
      {{"materials.\"ice.paper\".shear_modulus=\"3 kg\""}, {"wrong dimension, found kg", "a pressure or stress"}},
      {{"materials.\"ice.paper\".hugoniot_elastic_limit=1e9"}, {"must exceed pressure_at_hugoniot_elastic_limit"}},
      {{"materials.\"ice.fresh\".damage_constant=1"}, {"the scene does not use such a card"}},
      {{"run.end=exit"}, {"one of auto, ice_passed, exited, time"}},
      {{"run.seed=1.5"}, {"a whole number"}},
      {{"ice.critical_strain=true"}, {"a plain number"}},
      {{"resolution.cell=2"}, {"must not exceed ice.thickness"}},
      {{"fluid.length=100 mm"}, {"must not be below that of the ice"}},
      {{"water.depth=0"}, {"0 makes the ice the floor of the water", "clamped"}},
      {{"ice.damping=100"}, {"comes to rest", "beside [vehicle]"}},
      {{"ice.equilibrium=newtn"}, {"one of auto, newton, relaxation", "did you mean newton?"}},
      {{"ice.equilibrium=newton"}, {"this ice starts unloaded", "must be auto, or ice.start equilibrium"}},
      {{"ice.integration=ful"}, {"one of one_point, full", "did you mean full?"}},
      {{"ice.sides=clamped_end"}, {"did you mean clamped_ends?"}},
      {{"vehicle=3"}, {"must be a table, [vehicle]"}},
      {{"vehicle"}, {"must be key=value"}},
  };
  for (const auto& item : list) expect_message(message_of_settings(item.settings), item.words);
}

TEST(SceneErrors, PartsThatCannotStandTogetherAreNamed) {
  expect_message(message_of(scene_file("[water]\n")), {":1: ", "add [air]"});
  expect_message(message_of(scene_file("[tube]\n[ice]\n")), {":2: ", "[ice] cannot stand beside [tube]"});
  expect_message(message_of(scene_file("[tube]\n[fluid]\nlength = 1.0\n")),
                 {":3: ", "fluid.length cannot stand beside [tube]"});
  expect_message(message_of(scene_file("[dam]\nlength = 1.0\n")), {":1: ", "[dam] needs [water] and [air]"});
  expect_message(message_of(scene_file("[dam]\n[water]\ndepth = 1.0\n[air]\n")),
                 {":3: ", "water.depth cannot stand beside [dam]"});
  expect_message(message_of(case_folder("dam_break"), {.level = {}, .settings = {"dam.height=1 m"}}),
                 {"dam.height", "must be below dam.tank_height"});
  expect_message(message_of(case_folder("four_point_bending"), {.level = {}, .settings = {"ice.sides=clamped_ends"}}),
                 {"a beam between rollers is free"});
  expect_message(message_of(case_folder("four_point_bending"), {.level = {}, .settings = {"ice.equilibrium=newton"}}),
                 {"ice.equilibrium", "ice that meets no water starts without loads"});
  expect_message(message_of(case_folder("plate_under_water"), {.level = {}, .settings = {"ice.sides=free"}}),
                 {"water.depth", "clamped sides or ends"});
  expect_message(message_of(scene_file("")), {"an empty scene"});
}

TEST(SceneErrors, ARequiredKeyIsAskedFor) {
  expect_message(message_of(scene_file("[ice]\n[ice.bending]\nload_span = 0.1\n")),
                 {":2: ice.bending.support_span: missing; must be a length"});
}

TEST(SceneErrors, ShockViscosityNeedsAFluidAndOneOfItsTwoForms) {
  expect_message(
      message_of(case_folder("vehicle_drop"), {.level = {}, .settings = {"fluid.shock_viscosity=reference"}}),
      {"[fluid] needs [water] and [air]"});
  expect_message(message_of_settings({"fluid.shock_viscosity=0.06"}), {"one of limited, reference"});
}

TEST(SceneErrors, SweepsOfTheFluidAreThoseAskedFor) {
  for (const std::string name : {"dam_break", "water_exit"}) {
    EXPECT_EQ(resolve(case_folder(name)).fluid->sweeps, "alternating") << name;
    const Scene asked = resolve(case_folder(name), {.level = {}, .settings = {"fluid.sweeps=all_orders"}});
    EXPECT_EQ(asked.fluid->sweeps, "all_orders") << name;
  }
  expect_message(message_of_settings({"fluid.sweeps=xyz"}), {"one of alternating, all_orders"});
}

TEST(SceneErrors, ShockViscosityOfATubeAndOfWaterAndAirIsThatAskedFor) {
  for (const std::string name : {"shock_tube", "water_exit"}) {
    EXPECT_EQ(resolve(case_folder(name)).fluid->shock_viscosity, "limited") << name;
    const Scene asked = resolve(case_folder(name), {.level = {}, .settings = {"fluid.shock_viscosity=reference"}});
    EXPECT_EQ(asked.fluid->shock_viscosity, "reference") << name;
  }
}

}  // namespace
}  // namespace polynya::scene
