#include "core/contact/penalty_contact.hpp"

#include <gtest/gtest.h>

#include <numbers>

using namespace polynya::contact;

namespace {

/// A horizontal square plate of two triangles facing up at z = 0, too heavy to move.
struct Floor {
  std::vector<double> positions{-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0};
  std::vector<double> velocities = std::vector<double>(12, 0.0);
  std::vector<double> masses = std::vector<double>(4, 1e12);
  std::vector<std::int32_t> triangles{0, 1, 2, 0, 2, 3};
  PrimarySurface surface() const { return {positions, velocities, masses, triangles}; }
};

struct Point {
  std::vector<double> position, velocity, mass{1.0}, radius{0.0};
  std::vector<std::int64_t> id{42};
  SecondaryPoints points() const { return {position, velocity, mass, radius, id}; }
};

}  // namespace

TEST(PenaltyContact, ForcesOnBothSidesCancelToRounding) {
  Floor floor;
  floor.masses.assign(4, 2.0);
  floor.velocities = {1, 0, 0, 0, 2, 0, 0, 0, 1, 3, 0, 0};
  PenaltyContact contact({.friction = 0.3, .stiffness_factor = 0.1, .depth_limit = 0.2, .mirror = {}});
  contact.set_topology(floor.triangles, 4);
  const Point point{.position = {0.3, -0.2, -0.05}, .velocity = {0.5, 0.25, -1}};
  const ContactForces& forces = contact.evaluate(floor.surface(), point.points(), 1e-3);
  ASSERT_EQ(forces.active, 1u);
  for (int d = 0; d < 3; ++d) {
    double sum = forces.secondary[d];
    for (int v = 0; v < 4; ++v) sum += forces.primary[3 * v + d];
    EXPECT_NEAR(sum, 0.0, 1e-10 * std::abs(forces.secondary[2]));
  }
}

TEST(PenaltyContact, TenThousandBouncesNeitherGainNorLoseEnergy) {
  const Floor floor;
  PenaltyContact contact({.friction = 0, .stiffness_factor = 0.1, .depth_limit = 0.2, .mirror = {}});
  contact.set_topology(floor.triangles, 4);
  Point ball{.position = {0.1, 0.2, 0.05}, .velocity = {0, 0, 0}};
  const double gravity = 10, dt = 1e-3;
  const double start = gravity * ball.position[2];
  double highest = 0;
  int bounces = 0;
  bool was_touching = false;
  while (bounces < 10000) {
    const ContactForces& forces = contact.evaluate(floor.surface(), ball.points(), dt);
    const bool touching = forces.active > 0;
    if (touching && !was_touching) ++bounces;
    was_touching = touching;
    const double velocity_before = ball.velocity[2];
    ball.velocity[2] += dt * (forces.secondary[2] - gravity);
    const double middle = 0.5 * (velocity_before + ball.velocity[2]);
    const double energy = 0.5 * middle * middle + gravity * ball.position[2] + forces.stored_energy;
    highest = std::max(highest, energy);
    ball.position[2] += dt * ball.velocity[2];
  }
  // The step passes the kink of the one-sided spring at a random phase: the energy wanders by the square of
  // (step / contact time) but must not drift.
  EXPECT_LT(highest, 1.1 * start);
  EXPECT_GT(ball.position[2] * gravity + 0.5 * ball.velocity[2] * ball.velocity[2], 0.8 * start);
}

TEST(PenaltyContact, BlockOnAnInclineSlidesWithTheCoulombAcceleration) {
  const Floor floor;
  const double friction = 0.3, angle = 30 * std::numbers::pi / 180, gravity = 10, dt = 1e-4;
  PenaltyContact contact({.friction = friction, .stiffness_factor = 0.1, .depth_limit = 0.2, .mirror = {}});
  contact.set_topology(floor.triangles, 4);
  Point block{.position = {-0.5, 0, 0}, .velocity = {0, 0, 0}};
  block.position[2] = -gravity * std::cos(angle) * dt * dt / 0.1;  // static penetration under its own weight
  for (int n = 0; n < 2000; ++n) {
    const ContactForces& forces = contact.evaluate(floor.surface(), block.points(), dt);
    block.velocity[0] += dt * (forces.secondary[0] + gravity * std::sin(angle));
    block.velocity[2] += dt * (forces.secondary[2] - gravity * std::cos(angle));
    for (int d = 0; d < 3; ++d) block.position[d] += dt * block.velocity[d];
  }
  const double expected = gravity * (std::sin(angle) - friction * std::cos(angle)) * 2000 * dt;
  EXPECT_NEAR(block.velocity[0], expected, 0.005 * expected);
}

TEST(PenaltyContact, BlockOnAShallowInclineSticks) {
  const Floor floor;
  const double friction = 0.3, angle = 10 * std::numbers::pi / 180, gravity = 10, dt = 1e-4;
  PenaltyContact contact({.friction = friction, .stiffness_factor = 0.1, .depth_limit = 0.2, .mirror = {}});
  contact.set_topology(floor.triangles, 4);
  Point block{.position = {-0.5, 0, -gravity * std::cos(angle) * dt * dt / 0.1}, .velocity = {0, 0, 0}};
  for (int n = 0; n < 2000; ++n) {
    const ContactForces& forces = contact.evaluate(floor.surface(), block.points(), dt);
    block.velocity[0] += dt * (forces.secondary[0] + gravity * std::sin(angle));
    block.velocity[2] += dt * (forces.secondary[2] - gravity * std::cos(angle));
    for (int d = 0; d < 3; ++d) block.position[d] += dt * block.velocity[d];
  }
  // The regularised law creeps at the speed whose friction balances the slope: 5 g sin(angle) dt.
  EXPECT_LE(block.velocity[0], 5.1 * gravity * std::sin(angle) * dt);
}

TEST(PenaltyContact, ParticleTouchesWithItsRadiusAndNotBeyond) {
  const Floor floor;
  PenaltyContact contact({.friction = 0, .stiffness_factor = 0.1, .depth_limit = 0.2, .mirror = {}});
  contact.set_topology(floor.triangles, 4);
  Point particle{.position = {0, 0.1, 0.09}, .velocity = {0, 0, 0}};
  particle.radius = {0.1};
  EXPECT_NEAR(contact.evaluate(floor.surface(), particle.points(), 1e-3).deepest, 0.01, 1e-12);
  particle.position[2] = 0.11;
  EXPECT_EQ(contact.evaluate(floor.surface(), particle.points(), 1e-3).active, 0u);
}
