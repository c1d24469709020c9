#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/continuum/explicit_solid.hpp"
#include "core/continuum/surface.hpp"
#include "tests/core/contact/bodies.hpp"

using namespace polynya;
using namespace polynya::contact;
using namespace polynya::contact::testing;

namespace {

constexpr double gravity = 9.81, density = 900, youngs_modulus = 9e9, poisson_ratio = 0.3, edge = 0.1;

/// A cube of ice, one element, and its surface.
struct Block {
  continuum::ExplicitSolid solid;
  continuum::BoundarySurface surface;
  Mesh mesh;
  std::vector<double> force;

  explicit Block(double low) {
    continuum::HexMesh hexahedron;
    for (const double z : {low, low + edge})
      for (const auto& c : {std::array{0, 0}, {1, 0}, {1, 1}, {0, 1}})
        for (const double x : {edge * c[0], edge * c[1], z}) hexahedron.nodes.push_back(x);
    for (std::int32_t n = 0; n < 8; ++n) hexahedron.elements.push_back(n);
    solid = continuum::make_solid("block", hexahedron,
                                  continuum::Elastic{density, youngs_modulus / (3 * (1 - 2 * poisson_ratio)),
                                                     youngs_modulus / (2 * (1 + poisson_ratio))});
    const std::vector<double> alive(1, 1.0);
    surface = continuum::boundary_surface(solid.mesh, continuum::face_neighbours(solid.mesh), alive, {});
    for (std::size_t n = 0; n < 8; ++n) mesh.add_point(row(solid.positions, n), {}, solid.masses[n]);
    mesh.triangles = surface.triangles;
    force.assign(24, 0.0);
  }
  void drift(double dt) {
    continuum::advance_positions(solid, dt);
    mesh.positions = solid.positions;
    mesh.velocities = solid.velocities;
    std::fill(force.begin(), force.end(), 0.0);
    for (std::size_t n = 0; n < 8; ++n) force[3 * n + 2] = -gravity * solid.masses[n];
  }
  void add(const std::vector<double>& contact_force) {
    for (std::size_t k = 0; k < 24; ++k) force[k] += contact_force[k];
  }
  void kick(double dt) {
    continuum::internal_forces(solid, dt);
    continuum::advance_velocities(solid, force, dt, dt);
  }
  /// Kinetic, strain and potential energy, J.
  double energy() const {
    const continuum::EnergyAccount e = continuum::energies(solid);
    double sum = e.kinetic + e.internal + e.hourglass;
    for (std::size_t n = 0; n < 8; ++n) sum += gravity * solid.masses[n] * solid.positions[3 * n + 2];
    return sum;
  }
};

}  // namespace

TEST(Stack, OfThreeBlocksStaysAtRestForAHundredThousandWindows) {
  // Corner above corner, looked at both ways, with friction; let go without gaps and without having settled.
  std::vector<Block> blocks;
  for (int k = 0; k < 3; ++k) blocks.emplace_back(k * edge);
  const Mesh floor = floor_of(1, 3);
  const ContactLaw law{.friction = 0.3, .damping = 0, .stiffness_factor = 0.1, .depth_limit = 0.02, .skin = 0.01,
                       .mirror = {}, .two_way = true, .edges = true};
  std::vector<PenaltyContact> contacts;
  for (int k = 0; k < 3; ++k) contacts.emplace_back(law);
  contacts[0].set_topology(floor.body(), blocks[0].mesh.body());
  for (std::size_t k = 1; k < 3; ++k) contacts[k].set_topology(blocks[k - 1].mesh.body(), blocks[k].mesh.body());
  const double dt = 0.5 * continuum::stable_step(blocks[0].solid);
  for (Block& block : blocks) block.kick(0);
  // Weight on a joint's four corners over their stiffness: what the joints sink together.
  const double sunk = 6 * gravity * dt * dt / law.stiffness_factor * 8;
  double start = 0, highest = -1e300, last = 0, sideways = 0, lowest = 0;
  std::size_t searches = 0;
  constexpr int windows = 100000;
  for (int n = 0; n < windows; ++n) {
    for (Block& block : blocks) block.drift(dt);
    double stored = 0;
    const ContactForces& below = contacts[0].evaluate(floor.body(), blocks[0].mesh.body(), dt);
    blocks[0].add(below.secondary);
    stored += below.stored_energy;
    for (std::size_t k = 1; k < 3; ++k) {
      const ContactForces& between = contacts[k].evaluate(blocks[k - 1].mesh.body(), blocks[k].mesh.body(), dt);
      blocks[k - 1].add(between.primary);
      blocks[k].add(between.secondary);
      stored += between.stored_energy;
    }
    double energy = stored;
    for (Block& block : blocks) {
      block.kick(dt);
      energy += block.energy();
      for (std::size_t k = 0; k < 24; ++k) {
        const double moved = block.solid.positions[k] - block.solid.mesh.nodes[k];
        if (k % 3 == 2)
          lowest = std::min(lowest, moved);
        else
          sideways = std::max(sideways, std::abs(moved));
      }
    }
    if (n == 0) start = energy;
    highest = std::max(highest, energy);
    last = energy;
    searches = contacts[2].searches();
  }
  const double potential = sunk * 3 * density * edge * edge * edge * gravity;  // of the swing that can be
  std::printf("sunk %.3e m (at most %.3e), sideways %.3e m, energy %.3e to %.3e of the swing's\n", -lowest, 2 * sunk,
              sideways, (last - start) / potential, (highest - start) / potential);
  EXPECT_LT(highest - start, 0.02 * potential);
  EXPECT_GT(lowest, -2 * sunk);
  EXPECT_LT(sideways, 0.1 * sunk);
  EXPECT_EQ(searches, 1u);
}
