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

/// A block of ice, one element, and its surface. `width` along x and y about the middle of the stack.
struct Block {
  continuum::ExplicitSolid solid;
  continuum::BoundarySurface surface;
  Mesh mesh;
  std::vector<double> force;

  Block(double low, double width) {
    continuum::HexMesh hexahedron;
    for (const double z : {low, low + edge})
      for (const auto& c : {std::array{0, 0}, {1, 0}, {1, 1}, {0, 1}})
        for (const double x : {width * (c[0] - 0.5), width * (c[1] - 0.5), z}) hexahedron.nodes.push_back(x);
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

/// What became of a stack of three blocks after many windows.
struct Rest {
  double sunk = 0, sideways = 0;  ///< m, most
  double late_motion = 0;         ///< m, most that any vertex moved in the second half
  double highest = 0, last = 0;   ///< J, energy above that of the start
  double swing = 0;               ///< J, energy of the swing about the static depth of all joints
  double static_depth = 0;        ///< m, of all joints together
  std::size_t searches = 0;
};

Rest stack(const std::array<double, 3>& widths, double damping, int windows) {
  std::vector<Block> blocks;
  for (std::size_t k = 0; k < 3; ++k) blocks.emplace_back(static_cast<double>(k) * edge, widths[k]);
  const Mesh floor = floor_of(1, 3);
  const ContactLaw law{.friction = 0.3,
                       .damping = damping,
                       .stiffness_factor = 0.1,
                       .depth_limit = 0.02,
                       .skin = 0.01,
                       .mirror = {},
                       .two_way = true,
                       .edges = true};
  std::vector<PenaltyContact> contacts(3, PenaltyContact(law));
  contacts[0].set_topology(floor.body(), blocks[0].mesh.body());
  for (std::size_t k = 1; k < 3; ++k) contacts[k].set_topology(blocks[k - 1].mesh.body(), blocks[k].mesh.body());
  const double dt = 0.5 * continuum::stable_step(blocks[0].solid);
  for (Block& block : blocks) block.kick(0);

  Rest rest;
  // Four corners of an eighth of the mass M each: between two blocks factor (M/16)/dt^2 per corner, both ways together,
  // and the same on the floor, whose vertices are elsewhere. 3 + 2 + 1 blocks' weight on three joints. And the blocks
  // shorten under 2.5 + 1.5 + 0.5 blocks' weight.
  rest.static_depth =
      6 * 4 * gravity * dt * dt / law.stiffness_factor + 4.5 * density * gravity * edge * edge / youngs_modulus;
  rest.swing = rest.static_depth * density * edge * edge * edge * gravity * 3;
  double start = 0;
  std::vector<double> halfway;
  for (int n = 0; n < windows; ++n) {
    for (Block& block : blocks) block.drift(dt);
    double energy = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Body lower = k == 0 ? floor.body() : blocks[k - 1].mesh.body();
      const ContactForces& forces = contacts[k].evaluate(lower, blocks[k].mesh.body(), dt);
      if (k > 0) blocks[k - 1].add(forces.primary);
      blocks[k].add(forces.secondary);
      energy += forces.stored_energy;
    }
    std::vector<double> moved;
    for (Block& block : blocks) {
      block.kick(dt);
      energy += block.energy();
      for (std::size_t k = 0; k < 24; ++k) moved.push_back(block.solid.positions[k] - block.solid.mesh.nodes[k]);
    }
    if (n == 0) start = energy;
    if (n == windows / 2) halfway = moved;
    for (std::size_t k = 0; k < moved.size(); ++k) {
      if (k % 3 == 2)
        rest.sunk = std::max(rest.sunk, -moved[k]);
      else
        rest.sideways = std::max(rest.sideways, std::abs(moved[k]));
      if (n > windows / 2) rest.late_motion = std::max(rest.late_motion, std::abs(moved[k] - halfway[k]));
    }
    rest.highest = std::max(rest.highest, energy - start);
    rest.last = energy - start;
  }
  rest.searches = contacts[2].searches();
  std::printf(
      "sunk %.2f and sideways %.1e of the static depth, late motion %.1e m, energy %.1e of the swing's, at most %.1e\n",
      rest.sunk / rest.static_depth, rest.sideways / rest.static_depth, rest.late_motion, rest.last / rest.swing,
      rest.highest / rest.swing);
  return rest;
}

}  // namespace

TEST(Stack, ComesToRestAndStaysForAHundredThousandWindows) {
  // Let go without having settled, a little damping takes the swing out. Each block a little smaller than the one below: equal ones
  // stand corner on corner, an unstable place from which rounding pushes them (docs/limits.md).
  const Rest rest = stack({1.2 * edge, 1.1 * edge, edge}, 0.2, 100000);
  EXPECT_LT(rest.highest, 1e-6 * rest.swing);
  EXPECT_LT(rest.sunk, 3 * rest.static_depth);
  EXPECT_LT(rest.sideways, 0.1 * rest.static_depth);
  EXPECT_LT(rest.late_motion, 1e-6 * rest.static_depth);
  EXPECT_EQ(rest.searches, 1u);
}

TEST(Stack, WithoutDampingNeitherGainsEnergyNorDriftsInAHundredThousandWindows) {
  // Each block a little smaller than the one below. They bounce all the time.
  const Rest rest = stack({1.2 * edge, 1.1 * edge, edge}, 0, 100000);
  EXPECT_LT(rest.highest, 0.05 * rest.swing);
  EXPECT_LT(rest.sunk, 3 * rest.static_depth);
  EXPECT_LT(rest.sideways, rest.static_depth);
}
