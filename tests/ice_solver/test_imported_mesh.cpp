// A distorted mesh that has gone through a file, a shuffle and the launcher's renumbering.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <set>

#include "core/continuum/explicit_solid.hpp"
#include "core/results/mesh_file.hpp"
#include "tests/ice_solver/ice_bodies.hpp"

namespace polynya::ice {
namespace {

std::string written_file(const std::string& fault) {
  const auto folder = std::filesystem::path(::testing::TempDir()) / "polynya_imported_mesh" / fault;
  std::filesystem::create_directories(folder);
  const std::string path = folder / "mesh.h5";
  const std::string command =
      "/usr/bin/python3 -B " POLYNYA_SOURCE_DIR "/tests/ice_solver/write_mesh.py " + path + " " + fault;
  if (std::system(command.c_str()) != 0) throw std::runtime_error(command);
  return path;
}

continuum::ExplicitSolid solid_from_file() {
  const results::MeshFile file = results::read_mesh_file(written_file("none"));
  // Without bulk viscosity, whose stress is no linear function of the field.
  return continuum::make_solid("file", {file.nodes, file.elements}, testing::elastic_ice(), {0, 0, 1, 0.05, 0.01});
}

TEST(MeshFromAFile, FollowsALinearFieldExactlyThroughItsDistortedElements) {
  auto solid = solid_from_file();
  const double gradient[3][3] = {{900, -300, 200}, {500, 400, 100}, {-600, 250, 700}};  // 1/s
  for (int step = 0; step < 200; ++step) {
    for (std::size_t n = 0; n < solid.node_count(); ++n)
      for (std::size_t i = 0; i < 3; ++i) {
        double speed = 0;
        for (std::size_t j = 0; j < 3; ++j) speed += gradient[i][j] * solid.positions[3 * n + j];
        solid.velocities[3 * n + i] = speed;
      }
    continuum::advance_positions(solid, 1e-7);
    continuum::internal_forces(solid, 1e-7);
  }
  const double scale = std::abs(solid.element.stress[0][0]);
  EXPECT_GT(scale, 1e7);
  for (const auto& component : solid.element.stress)
    for (std::size_t e = 1; e < solid.element_count(); ++e) EXPECT_NEAR(component[e], component[0], 1e-11 * scale);
  int inner = 0;
  for (std::size_t n = 0; n < solid.node_count(); ++n) {
    if (solid.living_elements[n] != 8) continue;
    ++inner;  // 1e-6 m^2 is the area of an element's face
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(solid.internal_force[3 * n + i], 0, 1e-11 * scale * 1e-6);
  }
  EXPECT_EQ(inner, 3 * 2 * 4);
}

TEST(MeshFromAFile, TurnsRigidlyWithoutStress) {
  auto solid = solid_from_file();
  const double dt = 1e-6;
  for (int step = 1; step <= 360; ++step) {
    const double c = std::cos(M_PI * step / 180), s = std::sin(M_PI * step / 180);
    for (std::size_t n = 0; n < solid.node_count(); ++n) {
      const double* from = &solid.mesh.nodes[3 * n];
      const double to[3] = {from[0], c * from[1] - s * from[2], s * from[1] + c * from[2]};
      for (std::size_t i = 0; i < 3; ++i) solid.velocities[3 * n + i] = (to[i] - solid.positions[3 * n + i]) / dt;
    }
    continuum::advance_positions(solid, dt);
    continuum::internal_forces(solid, dt);
  }
  // Round-off of 360 steps: some 1e-13 of the moduli, 1e10 Pa.
  for (const auto& component : solid.element.stress)
    for (std::size_t e = 0; e < solid.element_count(); ++e) EXPECT_NEAR(component[e], 0, 10);
}

TEST(MeshFromAFile, KeepsNumbersAndSetsOfTheFile) {
  const results::MeshFile file = results::read_mesh_file(written_file("none"));
  const std::set<std::int64_t> numbers(file.element_numbers.begin(), file.element_numbers.end());
  EXPECT_EQ(numbers.size(), 60u);
  EXPECT_EQ(*numbers.begin(), 10);
  EXPECT_EQ(*numbers.rbegin(), 10 + 3 * 59);
  ASSERT_EQ(file.sets.at("floor").size(), 20u);
  for (const std::int32_t n : file.sets.at("floor")) EXPECT_LT(file.nodes[3 * n + 2], 0.21e-3);
}

TEST(MeshFromAFile, ThatIsDamagedIsRefusedByNameAndFault) {
  const auto refused = [](const std::string& path, const std::string& fault) {
    try {
      results::read_mesh_file(path);
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find(path), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find(fault), std::string::npos) << error.what();
      return;
    }
    ADD_FAILURE() << path << " was taken";
  };
  refused("/no/such/mesh.h5", "the file is missing or damaged");
  refused(written_file("index"), "elements names node 5000 of 120");
  refused(written_file("numbers"), "element_numbers is missing");
  refused(written_file("nodes"), "nodes has no 3 columns");
}

TEST(Supports, HoldTheirComponentsAndLetTheOthersMove) {
  IceOptions options = testing::block_options(3, 2, 1, 0.01);
  options.mesh = plate_mesh(options.x, options.y, options.z);
  options.gravity = 9.81;
  std::vector<std::int32_t> floor;
  for (std::int32_t n = 0; n < static_cast<std::int32_t>(options.mesh->node_count()); ++n)
    if (options.mesh->nodes[3 * static_cast<std::size_t>(n) + 2] == 0) floor.push_back(n);
  options.supports = {{.nodes = floor, .components = 4, .non_reflecting = false}};
  IceBody block = make_ice(options);
  double dt = testing::start(block);
  for (int step = 0; step < 200; ++step) dt = testing::advance(block, dt);
  double widest = 0;
  for (const std::int32_t n : floor) {
    const auto at = static_cast<std::size_t>(3 * n);
    EXPECT_EQ(block.solid.positions[at + 2], 0);
    widest = std::max(widest, std::abs(block.solid.positions[at] - block.solid.mesh.nodes[at]));
  }
  EXPECT_GT(widest, 0);  // it sinks onto its floor and spreads
}

TEST(Supports, ThatMoveLeaveTheStressOfSupportsAtRestAndDoTheWorkThatIsMissing) {
  IceOptions options = testing::block_options(1, 1, 12, 0.01);
  options.mesh = plate_mesh(options.x, options.y, options.z);
  std::vector<std::int32_t> floor;
  for (std::int32_t n = 0; n < static_cast<std::int32_t>(options.mesh->node_count()); ++n)
    if (options.mesh->nodes[3 * static_cast<std::size_t>(n) + 2] == 0) floor.push_back(n);
  options.supports = {{.nodes = floor, .components = 4, .non_reflecting = false}};
  options.gravity = 1000;  // so that the bar is pressed on its support
  IceBody at_rest = make_ice(options);
  options.velocity = -30;
  IceBody moving = make_ice(options);
  double dt = testing::start(at_rest), time = 0;
  ASSERT_NEAR(testing::start(moving), dt, 1e-12 * dt);
  const double balance = account_of(moving).balance(), kinetic = account_of(moving).kinetic;
  for (int step = 0; step < 60; ++step) {
    time += dt;
    const double next = testing::advance(at_rest, dt);
    EXPECT_NEAR(testing::advance(moving, dt), next, 1e-9 * next);
    dt = next;
  }
  const double scale = std::abs(at_rest.solid.element.stress[2][0]);
  EXPECT_GT(scale, 1e4);
  for (std::size_t e = 0; e < moving.solid.element_count(); ++e)
    EXPECT_NEAR(moving.solid.element.stress[2][e], at_rest.solid.element.stress[2][e], 1e-9 * scale);
  for (const std::int32_t n : floor) EXPECT_NEAR(moving.solid.positions[3 * static_cast<std::size_t>(n) + 2], -30 * time, 1e-15);
  EXPECT_NEAR(account_of(moving).balance(), balance, 1e-12 * kinetic);
  // All that the support does is hold the bar up: without it the bar would be as fast as gravity makes it.
  EXPECT_LT(account_of(moving).support_work, -1e-6 * kinetic);
  EXPECT_NEAR(account_of(moving).support_work, account_of(moving).external_work, 1e-12 * kinetic);
}

TEST(Supports, ThatLetWavesLeaveHaveTheImpedanceOfThePlaneTheyLieIn) {
  // A block turned about y and z: its faces lie in no plane of the axes.
  IceOptions options = testing::block_options(2, 3, 2, 0.01);
  auto mesh = plate_mesh(options.x, options.y, options.z);
  const double a = 0.4, b = 0.7;
  const double turn[3][3] = {{std::cos(b) * std::cos(a), -std::sin(b), std::cos(b) * std::sin(a)},
                             {std::sin(b) * std::cos(a), std::cos(b), std::sin(b) * std::sin(a)},
                             {-std::sin(a), 0, std::cos(a)}};
  std::vector<std::int32_t> face;
  for (std::size_t n = 0; n < mesh.node_count(); ++n) {
    const double from[3] = {mesh.nodes[3 * n], mesh.nodes[3 * n + 1], mesh.nodes[3 * n + 2]};
    if (from[0] == 0) face.push_back(static_cast<std::int32_t>(n));
    for (std::size_t i = 0; i < 3; ++i)
      mesh.nodes[3 * n + i] = turn[i][0] * from[0] + turn[i][1] * from[1] + turn[i][2] * from[2];
  }
  auto by_set = continuum::make_solid("set", mesh, testing::elastic_ice());
  auto by_plane = by_set;
  continuum::add_non_reflecting_boundary(by_set, face);
  continuum::add_non_reflecting_boundary(by_plane, {{-turn[0][0], -turn[1][0], -turn[2][0]}, 0});
  ASSERT_EQ(by_set.damped.nodes.size(), 12u);
  for (std::size_t k = 0; k < 12; ++k) {
    const auto other = std::find(by_plane.damped.nodes.begin(), by_plane.damped.nodes.end(), by_set.damped.nodes[k]);
    ASSERT_NE(other, by_plane.damped.nodes.end());
    const auto m = static_cast<std::size_t>(other - by_plane.damped.nodes.begin());
    for (std::size_t c = 0; c < 6; ++c)
      EXPECT_NEAR(by_set.damped.damping[6 * k + c], by_plane.damped.damping[6 * m + c], 1e-9);  // of 1e2 N s/m
  }
}

}  // namespace
}  // namespace polynya::ice
