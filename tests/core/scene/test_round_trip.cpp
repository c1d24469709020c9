#include "tests/core/scene/scene_files.hpp"

namespace polynya::scene {
namespace {

TEST(ResolvedScene, SurvivesTheRoundTripBitForBit) {
  for (const std::string name : {"water_exit", "vehicle_drop", "beam_bending", "shock_tube", "dam_break"}) {
    const auto json = to_json(resolve(case_folder(name)));
    const auto file = scene_file("").parent_path() / "scene.json";
    std::ofstream(file) << json.dump(2);
    const Scene again = load_resolved_scene(file.string());
    EXPECT_EQ(to_json(again), json) << name;
    for (const auto& [key, card] : again.materials) EXPECT_EQ(card.name, key);
  }
}

std::string load_error(const std::string& text) {
  const auto file = scene_file("").parent_path() / "broken.json";
  std::ofstream(file) << text;
  try {
    load_resolved_scene(file.string());
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return {};
}

TEST(ResolvedScene, ErrorsNameFileAndKey) {
  auto json = to_json(base_scene());
  json["vehicle"]["speed"] = "fast";
  EXPECT_NE(load_error(json.dump()).find("broken.json: vehicle.speed: wrong type, found \"fast\""), std::string::npos);
  json["vehicle"].erase("speed");
  EXPECT_NE(load_error(json.dump()).find("broken.json: vehicle.speed: missing"), std::string::npos);
  EXPECT_NE(load_error("{").find("not a JSON document"), std::string::npos);
  EXPECT_THROW(load_resolved_scene("/no/such/scene.json"), std::runtime_error);
}

TEST(ResolvedScene, UnknownEffectsAndMaterialsAreOutOfRange) {
  EXPECT_THROW(base_scene().effect("magic"), std::out_of_range);
  EXPECT_THROW(base_scene().material("wood"), std::out_of_range);
}

}  // namespace
}  // namespace polynya::scene
