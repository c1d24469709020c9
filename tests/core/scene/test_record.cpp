#include "tests/core/scene/scene_files.hpp"

namespace polynya::scene {
namespace {

TEST(RecordOfTheInterface, IsMadeOnlyWhenAskedFor) {
  EXPECT_FALSE(base_scene({}).record);
  EXPECT_FALSE(base_scene({"record.interface=false", "record.times=\"1 us to end\""}).record);
  EXPECT_TRUE(base_scene({"record.interface=true"}).record);
}

TEST(RecordOfTheInterface, SelectionIsResolvedAndSurvivesTheRoundTrip) {
  const Scene scene =
      base_scene({"record.interface=true", "record.participants=ice , structure",
                  "record.times=\"0 to 10 us,20 us to 0.03 ms , 1e-4 to end\"", "record.region.z_min=\"-5 mm\""});
  EXPECT_EQ(scene.record->participants, "ice,structure");
  ASSERT_EQ(scene.record->times.size(), 5u);  // the last one open
  const double ends[] = {0, 1e-5, 2e-5, 3e-5, 1e-4};
  for (std::size_t k = 0; k < 5; ++k) EXPECT_DOUBLE_EQ(scene.record->times[k], ends[k]);
  EXPECT_TRUE(scene.record->windows.empty());
  EXPECT_TRUE(scene.record->has_region());
  EXPECT_DOUBLE_EQ(*scene.record->z_min, -5e-3);
  EXPECT_FALSE(scene.record->x_max);
  EXPECT_EQ(to_json(from_json(to_json(scene))), to_json(scene));
  const Scene by_number = base_scene({"record.interface=true", "record.windows=\"0 to 100, 250, 300 to end\""});
  EXPECT_EQ(by_number.record->windows, (std::vector<std::int64_t>{0, 100, 250, 250, 300}));
  EXPECT_EQ(to_json(from_json(to_json(by_number))), to_json(by_number));
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
  refused({"record.times=\"2 us to 1 us\""}, "must ascend; allowed here: all, or intervals such as");
  refused({"record.times=\"0 to 2 mm\""}, "'2 mm' is not a time");
  refused({"record.times=\"0 to end, 1\""}, "nothing comes after the end");
  refused({"record.times=\"\""}, "record.times");
  refused({"record.windows=\"1.5\""}, "'1.5' is not a window");
  refused({"record.windows=\"0 to 5\"", "record.times=\"0 to 1\""}, "together with record.times");
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
