// Pressures and forces on named sets of the ice's mesh.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "core/results/mesh_file.hpp"
#include "tests/ice_solver/ice_bodies.hpp"

namespace polynya::ice {
namespace {

using Kind = SetLoad::Kind;

/// The block of 4 x 3 x 5 mm whose nodes are shifted at random, so that no face is flat.
continuum::HexMesh distorted_block() {
  const auto folder = std::filesystem::path(::testing::TempDir()) / "polynya_set_loads";
  std::filesystem::create_directories(folder);
  const std::string path = folder / "mesh.h5";
  const std::string command =
      "/usr/bin/python3 -B " POLYNYA_SOURCE_DIR "/tests/ice_solver/write_mesh.py " + path + " none";
  if (std::system(command.c_str()) != 0) throw std::runtime_error(command);
  const results::MeshFile file = results::read_mesh_file(path);
  return {file.nodes, file.elements};
}

std::vector<std::int32_t> nodes_where(const continuum::HexMesh& mesh, auto&& condition) {
  std::vector<std::int32_t> chosen;
  for (std::size_t n = 0; n < mesh.node_count(); ++n)
    if (condition(&mesh.nodes[3 * n])) chosen.push_back(static_cast<std::int32_t>(n));
  return chosen;
}

IceOptions bar_options(int cells) {
  IceOptions options = testing::block_options(1, 1, cells, 0.01);
  options.mesh = plate_mesh(options.x, options.y, options.z);
  return options;
}

TEST(SetLoads, PressureAllAroundPressesADistortedBlockUniformly) {
  IceOptions options;
  options.law = testing::elastic_ice();
  options.conversion = false;
  options.mesh = distorted_block();
  const double pressure = 1e5;
  options.loads = {
      {Kind::pressure, "top", nodes_where(*options.mesh, [](const double*) { return true; }), {{0}, {pressure}}}};
  IceBody block = make_ice(options);
  const auto report = settle(block, std::vector<double>(3 * block.solid.node_count(), 0.0));
  EXPECT_EQ(report.method, continuum::EquilibriumMethod::newton);
  internal_forces(block, 0);
  for (std::size_t e = 0; e < block.solid.element_count(); ++e)
    for (std::size_t c = 0; c < 6; ++c)
      EXPECT_NEAR(block.solid.element.stress[c][e], c < 3 ? -pressure : 0, 1e-4 * pressure) << e << ' ' << c;
}

TEST(SetLoads, PressureOnAClosedSurfaceNeitherPushesNorTurns) {
  IceOptions options;
  options.law = testing::elastic_ice();
  options.mesh = distorted_block();
  options.loads = {
      {Kind::pressure, "top", nodes_where(*options.mesh, [](const double*) { return true; }), {{0}, {1e5}}}};
  IceBody block = make_ice(options);
  const auto forces = block.set_loads.at(block.solid);
  double sum[3]{}, moment[3]{}, scale = 0;
  for (std::size_t n = 0; n < block.solid.node_count(); ++n) {
    const double *f = &forces[3 * n], *x = &block.solid.positions[3 * n];
    for (std::size_t c = 0; c < 3; ++c) {
      sum[c] += f[c], scale += std::abs(f[c]);
      moment[c] += x[(c + 1) % 3] * f[(c + 2) % 3] - x[(c + 2) % 3] * f[(c + 1) % 3];
    }
  }
  EXPECT_GT(scale, 1);
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(sum[c], 0, 1e-13 * scale);
    EXPECT_NEAR(moment[c], 0, 1e-13 * scale * 5e-3);
  }
}

TEST(SetLoads, AStepOfPressureSendsTheElasticWaveOfABar) {
  // Poisson's ratio 0: waves of the bar and of the bulk agree, c = sqrt(2 G / rho), and the end moves at p / (rho c).
  IceOptions options = bar_options(200);
  const double density = 900, shear = 4.4444e9;
  options.law = continuum::Elastic{density, 2 * shear / 3, shear};
  const double speed = std::sqrt(2 * shear / density), length = 2.0, pressure = 1e5, rise = 50e-6;
  options.loads = {{Kind::pressure,
                    "top",
                    nodes_where(*options.mesh, [](const double* x) { return x[2] == 0; }),
                    {{0, rise}, {0, pressure}}}};
  IceBody bar = make_ice(options);
  double dt = testing::start(bar);
  while (bar.solid.time < 0.7 * length / speed) dt = testing::advance(bar, dt);
  const double moved = pressure / (density * speed) * (bar.solid.time - 0.5 * rise);
  EXPECT_NEAR(bar.solid.positions[2], moved, 0.005 * moved);
  const double front = speed * (bar.solid.time - 0.5 * rise);
  const auto stress_at = [&](double z) { return bar.solid.element.stress[2][static_cast<std::size_t>(z / 0.01)]; };
  EXPECT_NEAR(stress_at(0.4 * front), -pressure, 0.01 * pressure);
  EXPECT_NEAR(stress_at(front), -0.5 * pressure, 0.1 * pressure);
  EXPECT_NEAR(stress_at(front + 0.3), 0, 1e-3 * pressure);
}

TEST(SetLoads, AForceGivesItsImpulseAndItsWorkToAFreeBody) {
  for (const bool on_faces : {true, false}) {
    IceOptions options = bar_options(6);
    const auto set = nodes_where(*options.mesh, [&](const double* x) {
      return on_faces ? x[2] == 0 : x[0] == 0 && x[1] == 0;  // an edge has no face
    });
    options.loads = {{Kind::force, "top", set, {{0, 20e-6, 40e-6}, {0, 0, 0, 3, -4, 12, 0, 0, 0}}}};
    IceBody bar = make_ice(options);
    double dt = testing::start(bar);
    const double balance = account_of(bar).balance();
    while (bar.solid.time < 60e-6) dt = testing::advance(bar, dt);
    const Account account = account_of(bar);
    const double impulse[3] = {60e-6, -80e-6, 240e-6};  // N s: half the peak over 40 us
    for (std::size_t c = 0; c < 3; ++c) {
      // Sampled at steps of about 1.4 us: the triangle to second order.
      EXPECT_NEAR(account.momentum[c], impulse[c], 0.01 * std::abs(impulse[c]));
      EXPECT_NEAR(account.momentum[c], account.boundary_impulse[c], 1e-12 * std::abs(impulse[c]));
    }
    EXPECT_GT(account.set_load_work, 1e-9);
    EXPECT_NEAR(account.set_load_work, account.external_work, 1e-12 * account.set_load_work);
    EXPECT_NEAR(account.balance(), balance, 1e-12 * account.set_load_work);
  }
}

TEST(SetLoads, ASupportCarriesTheForceOnItsOwnNodes) {
  IceOptions options = bar_options(4);
  const auto floor = nodes_where(*options.mesh, [](const double* x) { return x[2] == 0; });
  options.supports = {{.nodes = floor, .components = 7, .non_reflecting = false}};
  options.loads = {{Kind::force, "top", floor, {{0}, {0, 0, 50}}}};
  IceBody bar = make_ice(options);
  double dt = testing::start(bar);
  for (int step = 0; step < 50; ++step) dt = testing::advance(bar, dt);
  const Account account = account_of(bar);
  EXPECT_EQ(account.kinetic, 0);
  EXPECT_EQ(account.momentum[2], 0);
  EXPECT_NEAR(account.boundary_impulse[2], 0, 1e-18);
  EXPECT_EQ(account.set_load_work, 0);
}

TEST(SetLoads, PushFacesOfLivingElementsAndNodesWithMassOnly) {
  IceOptions options = bar_options(3);
  options.debris = Debris::free_masses;
  const auto end = nodes_where(*options.mesh, [](const double* x) { return x[2] == 0; });
  options.loads = {{Kind::pressure, "top", end, {{0}, {1e5}}}, {Kind::force, "top", end, {{0}, {0, 0, 5}}}};
  IceBody bar = make_ice(options);
  const auto total = [&] {
    double sum = 0;
    for (const double force : bar.set_loads.at(bar.solid)) sum += force;
    return sum;
  };
  EXPECT_NEAR(total(), 1e5 * 1e-4 + 5, 1e-12);
  convert_elements(bar, testing::elements_where(bar, [](const auto& centre) { return centre[2] < 0.01; }));
  EXPECT_EQ(total(), 0);
}

TEST(SetLoads, APressureNeedsAFace) {
  IceOptions options = bar_options(2);
  options.loads = {{Kind::pressure, "top", {0, 1}, {{0}, {1e5}}}};
  try {
    make_ice(options);
    ADD_FAILURE() << "the set was taken";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("ice.pressures.top: the set has no face"), std::string::npos);
  }
}

}  // namespace
}  // namespace polynya::ice
