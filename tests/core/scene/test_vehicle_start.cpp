#include <cmath>

#include "core/scene/vehicle_shape.hpp"
#include "tests/core/scene/scene_files.hpp"

namespace polynya::scene {
namespace {

void expect_words(const std::string& message, const std::vector<std::string>& words) {
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  for (const auto& word : words) EXPECT_NE(message.find(word), std::string::npos) << message << "\nlacks: " << word;
}

std::string refusal(const std::vector<std::string>& settings) {
  return message_of(case_folder("vehicle_drop"), {.level = {}, .settings = settings});
}

Scene drop(std::vector<std::string> settings) {
  return resolve(case_folder("vehicle_drop"), {.level = {}, .settings = std::move(settings)});
}

TEST(VehicleStart, WhatASymmetryCannotMirrorIsRefusedWithAReason) {
  // cases/vehicle_drop asks for a quarter.
  expect_words(refusal({"vehicle.angle=20 deg"}), {"vehicle.angle", "plane x = 0", "quarter", "half", "full"});
  expect_words(refusal({"vehicle.offset_x=1 mm"}), {"vehicle.offset_x", "quarter model cannot hold"});
  expect_words(refusal({"vehicle.pitch_rate=5 rad/s"}), {"vehicle.pitch_rate", "quarter"});
  expect_words(refusal({"symmetry=half", "vehicle.offset_y=1 mm"}), {"vehicle.offset_y", "plane y = 0", "\"full\""});
  expect_words(refusal({"symmetry=half", "vehicle.spin=5 rad/s"}),
               {"vehicle.spin", "one hand", "half model", "\"full\""});
  EXPECT_EQ(refusal({"symmetry=half", "vehicle.angle=20 deg", "vehicle.offset_x=1 mm"}), "");
  EXPECT_EQ(refusal({"symmetry=full", "vehicle.offset_y=1 mm"}), "");
}

TEST(VehicleStart, TheSymmetryFollowsFromTheStartWhereNothingIsSaid) {
  EXPECT_EQ(drop({"symmetry=auto"}).symmetry, Symmetry::quarter);
  EXPECT_EQ(drop({"symmetry=auto", "vehicle.angle=5 deg"}).symmetry, Symmetry::half);
  EXPECT_EQ(drop({"symmetry=auto", "vehicle.offset_y=1 mm"}).symmetry, Symmetry::full);
}

TEST(VehicleStart, OnlyARigidVehicleTurnsOrCarriesBallast) {
  expect_words(refusal({"symmetry=full", "vehicle.spin=5 rad/s"}), {"vehicle.spin", "effects.deformable_vehicle"});
  expect_words(refusal({"vehicle.ballast=1 g at 0, 0, -30 mm"}), {"vehicle.ballast", "effects.deformable_vehicle"});
  const Scene scene = drop({"symmetry=full", "effects.deformable_vehicle=off", "vehicle.spin=5 rad/s",
                            "vehicle.ballast=1 g at 0, 1 mm, -30 mm; 2 g at 0, 0, -50 mm"});
  EXPECT_EQ(scene.vehicle->spin, 5);
  const std::vector<double> ballast{1e-3, 0, 1e-3, -30e-3, 2e-3, 0, 0, -50e-3};
  ASSERT_EQ(scene.vehicle->ballast.size(), ballast.size());
  for (std::size_t i = 0; i < ballast.size(); ++i) EXPECT_NEAR(scene.vehicle->ballast[i], ballast[i], 1e-15);
  expect_words(refusal({"effects.deformable_vehicle=off", "vehicle.ballast=1 g"}), {"three lengths"});
}

TEST(VehicleStart, ATiltedBluntHeadStartsLowerSoThatItsEdgeStaysBelowTheIce) {
  Vehicle v;
  v.head = "ellipsoid", v.head_length = 1e-6, v.diameter = 0.01, v.length = 0.1, v.angle = 0.5;
  EXPECT_NEAR(highest_above_nose(v), 0.005 * std::sin(0.5), 1e-4);
  EXPECT_NEAR(lowest_below_nose(v), 0.1 * std::cos(0.5) + 0.005 * std::sin(0.5), 1e-12);
  expect_words(refusal({"symmetry=half", "vehicle.head=hemisphere", "vehicle.head_length=5 mm", "vehicle.angle=1.2",
                        "vehicle.nose_position=-1 mm"}),
               {"vehicle.nose_position", "inside the ice"});
}

/// A box of 10 x 8 x 60 mm as an OBJ file in mm beside the scene; one triangle may be left out.
std::filesystem::path scene_with_box(const std::string& vehicle, bool whole = true) {
  const auto file = scene_file("symmetry = \"full\"\n[vehicle]\nspeed = 40\n" + vehicle + "[run]\nend_time = 1e-3\n");
  std::ofstream box(file.parent_path() / "box.obj");
  for (int i = 0; i < 8; ++i) box << "v " << (i & 1) * 10 << ' ' << (i >> 1 & 1) * 8 << ' ' << (i >> 2) * 60 << '\n';
  box << "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\n";
  if (whole) box << "f 2 4 8 6\n";
  return file;
}

TEST(VehicleStart, AHullFromAFileIsReadBesideTheSceneInItsUnit) {
  const Scene scene = resolve(scene_with_box("surface_file = \"box.obj\"\nfile_unit = \"mm\"\n"));
  EXPECT_NEAR(scene.vehicle->surface->volume, 10e-3 * 8e-3 * 60e-3, 1e-18);
  EXPECT_NEAR(scene.vehicle->length, 60e-3, 1e-15);
  EXPECT_NEAR(scene.vehicle->diameter, 2 * std::hypot(5e-3, 4e-3), 1e-15);
  EXPECT_FALSE(scene.vehicle->deformable);
  const Scene again = from_json(to_json(scene));
  EXPECT_EQ(again.vehicle->surface->file, scene.vehicle->surface->file);
}

TEST(VehicleStart, AHullFromAFileIsRefusedInOneSentence) {
  expect_words(message_of(scene_with_box("surface_file = \"box.obj\"\n")), {"vehicle.file_unit", "missing", "mm"});
  expect_words(message_of(scene_with_box("surface_file = \"box.obj\"\nfile_unit = \"mm\"\n", false)),
               {"vehicle.surface_file", "is open: 4 edge(s)", "near (10"});
  expect_words(message_of(scene_with_box("surface_file = \"no.obj\"\nfile_unit = \"mm\"\n")), {"cannot be read"});
  expect_words(message_of(scene_with_box("surface_file = \"box.obj\"\nfile_unit = \"mm\"\nlength = 0.1\n")),
               {"vehicle.length", "cannot stand beside vehicle.surface_file"});
  expect_words(message_of(scene_with_box("file_unit = \"mm\"\nmass = 0.005\n")), {"needs vehicle.surface_file"});
  expect_words(message_of(scene_with_box("surface_file = \"box.obj\"\nfile_unit = \"mm\"\n"),
                          {.level = {}, .settings = {"symmetry=quarter"}}),
               {"vehicle.surface_file", "symmetry = \"full\""});
}

}  // namespace
}  // namespace polynya::scene
