// Ice from a mesh file: what must be known of the file first, and what the scene makes of it.
#include "core/scene/estimate.hpp"
#include "tests/core/scene/scene_files.hpp"

namespace polynya::scene {
namespace {

const std::string head = "[run]\nend_time = \"1 ms\"\n";
const std::string ice = "[ice]\nmesh = \"meshes/../beam.inp\"\nmesh_unit = \"mm\"\n";
const std::string facts =
    R"({"low": [-0.03, 0.0, 0.1], "high": [0.05, 0.02, 0.14], "elements": 400, "nodes": 605, "boundary_faces": 480,
        "volume": 6.4e-5, "thinnest": 0.002})";

Scene resolved(const std::string& text, const std::string& mesh = facts) {
  return resolve(scene_file(text), {.level = {}, .settings = {}, .mesh = mesh});
}

TEST(IceMesh, IsAskedForWithItsPathUnitPlanesAndSets) {
  const auto file = scene_file("symmetry = \"half\"\n" + head + ice +
                               "mesh_pieces = 2\n[ice.supports]\nfloor = \"z\"\nends = \"xyz\"\n");
  const auto wanted = wanted_mesh(file, {});
  ASSERT_TRUE(wanted);
  EXPECT_EQ(wanted->file, (file.parent_path() / "beam.inp").string());
  EXPECT_EQ(wanted->unit, "mm");
  EXPECT_EQ(wanted->pieces, 2);
  EXPECT_EQ(wanted->planes, std::vector<int>{1});
  EXPECT_EQ(wanted->sets, (std::vector<std::string>{"ends", "floor"}));
  EXPECT_FALSE(wanted_mesh(file, {.level = {}, .settings = {}, .mesh = facts}));
  EXPECT_FALSE(wanted_mesh(scene_file(head + "[ice]\n"), {}));
}

TEST(IceMesh, GivesTheIceTheSizeOfItsBoxAndTheEstimateItsCounts) {
  const Scene scene = resolved(head + ice + "[ice.supports]\nends = \"zx\"\n");
  EXPECT_EQ(scene.symmetry, Symmetry::full);
  EXPECT_DOUBLE_EQ(scene.ice->length, 0.1);
  EXPECT_DOUBLE_EQ(scene.ice->width, 0.04);
  EXPECT_DOUBLE_EQ(scene.ice->lower_face, 0.1);
  EXPECT_DOUBLE_EQ(scene.ice->thickness, 0.04);
  EXPECT_EQ(scene.ice->sides, "free");
  EXPECT_EQ(scene.ice->mesh->supports.at("ends"), "xz");
  const Estimate cost = estimate(scene, machine("."));
  EXPECT_EQ(cost.ice_elements, 400u);
  EXPECT_EQ(cost.nodes, 605u);
  const Scene again = from_json(to_json(scene));
  EXPECT_EQ(to_json(again), to_json(scene));
}

TEST(IceMesh, CarriesPressuresAndForcesOverTimeOnItsSets) {
  const std::string text = head + ice +
                           "[ice.pressures]\nends = \"0 at 0; 20 kPa at 1 ms\"\n"
                           "[ice.forces]\nfloor = \"0, 2 N, -10 N\"\n";
  EXPECT_EQ(wanted_mesh(scene_file(text), {})->sets, (std::vector<std::string>{"ends", "floor"}));
  const Scene scene = resolved(text);
  EXPECT_EQ(scene.ice->mesh->pressures.at("ends").times, (std::vector<double>{0, 1e-3}));
  EXPECT_EQ(scene.ice->mesh->pressures.at("ends").rows, (std::vector<double>{0, 2e4}));
  EXPECT_EQ(scene.ice->mesh->forces.at("floor").rows, (std::vector<double>{0, 2, -10}));
  EXPECT_EQ(to_json(from_json(to_json(scene))), to_json(scene));
}

TEST(IceMesh, OpenFacesAreAnEffectThatCanBeSwitchedOff) {
  const std::string text = head + ice + "[ice.supports]\nends = \"non_reflecting\"\nfloor = \"z\"\n";
  EXPECT_TRUE(resolved(text).effect("non_reflecting_boundaries"));
  const Scene closed = resolved(text + "[effects]\nnon_reflecting_boundaries = \"off\"\n");
  EXPECT_EQ(closed.ice->mesh->supports.size(), 1u);
  EXPECT_FALSE(resolved(head + ice).effect("non_reflecting_boundaries"));
}

TEST(IceMesh, FlawsNeedALawWithDamage) {
  EXPECT_EQ(resolved(head + ice + "flaws = 0.05\n").ice->flaws, 0.05);
  const std::string message = message_of(scene_file(head + ice + "flaws = 0.05\nmaterial = \"aluminium\"\n"),
                                         {.level = {}, .settings = {}, .mesh = facts});
  for (const std::string word : {"ice.flaws", "johnson_holmquist_2", "aluminium is elastic"})
    EXPECT_NE(message.find(word), std::string::npos) << message;
}

TEST(IceMesh, StartsWithTheVelocityGivenAndThenNoneOfItSleeps) {
  const Scene scene = resolved(head + ice + "velocity = \"-30 m/s\"\n");
  EXPECT_EQ(scene.ice->mesh->velocity, -30);
  EXPECT_FALSE(scene.effect("ice_sleeping"));
  EXPECT_EQ(from_json(to_json(scene)).ice->mesh->velocity, -30);
  EXPECT_EQ(resolved(head + ice).ice->mesh->velocity, 0);
}

TEST(IceMesh, RefusesWhatDoesNotGoTogetherInOneLine) {
  const auto refused = [](const std::string& text, const std::string& key, const std::string& remedy,
                          const std::string& mesh = facts) {
    const std::string message = message_of(scene_file(text), {.level = {}, .settings = {}, .mesh = mesh});
    EXPECT_NE(message.find(key), std::string::npos) << message;
    EXPECT_NE(message.find(remedy), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  };
  refused(head + "[ice]\nmesh = \"beam.inp\"\n", "ice.mesh_unit", "must be m, cm, mm, um, in or ft");
  refused(head + ice + "length = 1\n", "ice.length", "leave it out");
  refused(head + ice + "[ice.ball]\ndiameter = 1\nspeed = 1\n", "ice.mesh", "[ice.ball]");
  refused(head + ice + "[ice.supports]\nends = \"xx\"\n", "ice.supports.ends", "\"xyz\"");
  refused(head + ice + "[ice.supports]\nends = \"\"\n", "ice.supports.ends", "non_reflecting");
  refused(head + "[ice]\nmesh_pieces = 2\n", "ice.mesh_pieces", "ice.mesh");
  refused(head + "[ice]\nvelocity = \"1 m/s\"\n", "ice.velocity", "ice.mesh");
  refused(head + ice + "velocity = \"1 m\"\n", "ice.velocity", "speed");
  refused(head + "[ice.supports]\nends = \"x\"\n", "ice.supports.ends", "ice.mesh");
  refused(head + ice + "[ice.pressures]\nends = \"1 N\"\n", "ice.pressures.ends", "20 kPa at 1 ms");
  refused(head + ice + "[ice.pressures]\nends = \"1 kPa at 1 ms\"\n", "ice.pressures.ends", "first time must be 0");
  refused(head + ice + "[ice.forces]\nends = \"0, 1 N\"\n", "ice.forces.ends", "must have 3");
  refused(head + "[ice.forces]\nends = \"0, 0, 1 N\"\n", "ice.forces.ends", "ice.mesh");
  refused(head + ice, "ice.mesh", "./polynya", "");
  refused(head + ice, "ice.mesh", "--mesh", "{}");
}

}  // namespace
}  // namespace polynya::scene
