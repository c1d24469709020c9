#include "tests/core/scene/scene_files.hpp"

namespace polynya::scene {
namespace {

TEST(RecordOfTheInterface, IsMadeOnlyWhenAskedFor) {
  EXPECT_FALSE(base_scene({}).record);
  EXPECT_FALSE(base_scene({"record.interface=false", "record.from=\"1 us\""}).record);
  EXPECT_TRUE(base_scene({"record.interface=true"}).record);
}

TEST(RecordOfTheInterface, SelectionIsResolvedAndSurvivesTheRoundTrip) {
  const Scene scene = base_scene({"record.interface=true", "record.participants=ice , structure",
                                  "record.from=\"10 us\"", "record.until=\"20 us\"", "record.region.z_min=\"-5 mm\""});
  EXPECT_EQ(scene.record->participants, "ice,structure");
  EXPECT_DOUBLE_EQ(scene.record->from, 1e-5);
  EXPECT_DOUBLE_EQ(*scene.record->until, 2e-5);
  EXPECT_TRUE(scene.record->has_region());
  EXPECT_DOUBLE_EQ(*scene.record->z_min, -5e-3);
  EXPECT_FALSE(scene.record->x_max);
  EXPECT_EQ(to_json(from_json(to_json(scene))), to_json(scene));
}

TEST(RecordOfTheInterface, WhatCannotBeRecordedIsOneSentence) {
  const auto refused = [](const std::vector<std::string>& settings, const std::string& words) {
    std::vector<std::string> all{"record.interface=true"};
    all.insert(all.end(), settings.begin(), settings.end());
    const std::string message = message_of_settings(all);
    EXPECT_NE(message.find(words), std::string::npos) << message;
  };
  refused({"record.participants=ices"}, "'ices' takes no part in this scene; allowed here: all, or some of fluid, ice");
  refused({"record.participants=\" \""}, "takes no part");
  refused({"record.from=\"2 us\"", "record.until=\"1 us\""}, "must not be before record.from");
  refused({"record.region.x_min=1", "record.region.x_max=0"}, "record.region.x_max");
  refused({"record.interface=maybe"}, "one of true, false");
}

TEST(RecordOfTheInterface, OneSolverAloneHasNoMessages) {
  const std::string message =
      message_of(case_folder("beam_bending"), {.level = {}, .settings = {"record.interface=true"}});
  EXPECT_NE(message.find("one solver runs alone; allowed here: false"), std::string::npos) << message;
}

}  // namespace
}  // namespace polynya::scene
