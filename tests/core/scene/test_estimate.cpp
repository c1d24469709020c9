#include "core/scene/estimate.hpp"

#include <cmath>

#include "core/scene/graded_line.hpp"
#include "tests/core/scene/scene_files.hpp"

namespace polynya::scene {
namespace {

const Machine plenty{.memory = 1e12, .disk = 1e13, .cores = 2};

TEST(Estimate, CountsWhatTheGridLinesGive) {
  const Scene scene = base_scene();
  const Estimate e = estimate(scene, plenty);
  EXPECT_EQ(e.cells, fluid_grid_lines(scene).cells());
  EXPECT_EQ(e.ice_elements, ice_grid_lines(scene).cells());
}

TEST(Estimate, StepsFollowFromSoundSpeeds) {
  const Scene scene = base_scene({"effects.deformable_vehicle=off"});
  const Estimate e = estimate(scene, plenty);
  const double sound = std::sqrt((8.1254e9 + 4.0 / 3 * 4444.4e6) / 900);
  EXPECT_NEAR(e.ice_step, 0.9 * 2e-3 / sound, 1e-12);
  EXPECT_NEAR(e.fluid_span, 0.5 * 2e-3 / 1480, 1e-12);
  EXPECT_GT(e.windows, e.fluid_steps);
}

TEST(Estimate, TheFineMeshIsAsLargeAsThePapersConvergedOne) {
  const Scene scene = resolve(case_folder("water_exit"), {.level = "fine", .settings = {"symmetry=full"}});
  const Estimate e = estimate(scene, plenty);
  EXPECT_NEAR(static_cast<double>(e.cells + e.ice_elements + e.vehicle_elements), 4.93e6, 0.1e6);
}

TEST(Estimate, SaysWhatDoesNotFit) {
  const Scene scene = base_scene();
  EXPECT_TRUE(estimate(scene, plenty).fits);
  const Estimate cramped = estimate(scene, {.memory = 1e6, .disk = 1e13, .cores = 2});
  EXPECT_FALSE(cramped.fits);
  EXPECT_NE(cramped.reason.find("memory"), std::string::npos);
  EXPECT_NE(estimate(scene, {.memory = 1e12, .disk = 1e3, .cores = 2}).reason.find("disk"), std::string::npos);
}

// A checkpoint of the quick base scene was measured at 37 MB (docs/coupling.md); up to three lie on the disk.
TEST(Estimate, CheckpointsTakeTheirRoomOnTheDisk) {
  const double with = estimate(base_scene(), plenty).disk;
  const double without = estimate(base_scene({"checkpoint.interval=0 s", "checkpoint.wall_interval=0 s"}), plenty).disk;
  EXPECT_NEAR(with - without, 3 * 37e6, 0.3 * 3 * 37e6);
}

TEST(Estimate, EveryCaseCostsSomethingFinite) {
  for (const std::string name : {"water_exit", "vehicle_drop", "beam_bending", "shock_tube", "dam_break"}) {
    const Estimate e = estimate(resolve(case_folder(name)), plenty);
    EXPECT_TRUE(std::isfinite(e.wall_time) && e.wall_time > 0) << name;
    EXPECT_GT(e.windows, 0) << name;
  }
}

}  // namespace
}  // namespace polynya::scene
