// Surface that comes to lie beside a point because what covered it is gone.
#include <gtest/gtest.h>

#include "tests/core/contact/bodies.hpp"

using namespace polynya::contact;
using namespace polynya::contact::testing;

namespace {

constexpr ContactLaw law{.friction = 0, .damping = 0, .stiffness_factor = 0.1, .depth_limit = 0.2, .skin = 0.1};
constexpr double dt = 1e-3;
constexpr double stiffness = 0.1 / (dt * dt);  // of a particle of 1 kg against what hardly moves

/// A floor at z = 0 for x >= 0, and the wall at x = 0 above it.
Mesh floor_with_wall(bool wall) {
  Mesh mesh;
  mesh.add_point({0, -1, 0}, {}, 1e9);
  mesh.add_point({2, -1, 0}, {}, 1e9);
  mesh.add_point({2, 1, 0}, {}, 1e9);
  mesh.add_point({0, 1, 0}, {}, 1e9);
  mesh.triangles = {0, 1, 2, 0, 2, 3};
  if (!wall) return mesh;
  mesh.add_point({0, -1, 2}, {}, 1e9);
  mesh.add_point({0, 1, 2}, {}, 1e9);
  mesh.triangles.insert(mesh.triangles.end(), {0, 3, 5, 0, 5, 4});
  return mesh;
}

}  // namespace

TEST(UncoveredSurface, DoesNotPushAParticleThatLayBesideIt) {
  const Mesh far = floor_of();
  Mesh near = floor_of(1, 1, 0.6);
  near.ids = {10, 11, 12, 13};
  Mesh particle = point_at({0, 0, 0.63}, {0, 0, 0}, 1, 0.1);
  PenaltyContact contact(law);
  contact.set_topology(far.body(), particle.body());
  contact.evaluate(far.body(), particle.body(), dt);
  contact.set_topology(near.body(), particle.body());
  for (int n = 0; n < 100; ++n) {
    kick(particle, contact.evaluate(near.body(), particle.body(), dt).secondary, dt);
    particle.drift(dt);
  }
  EXPECT_EQ(particle.positions[2], 0.63);
  // Pressed on, it springs back with the speed that it came with.
  particle.velocities[2] = -1;
  for (int n = 0; n < 100; ++n) {
    kick(particle, contact.evaluate(near.body(), particle.body(), dt).secondary, dt);
    particle.drift(dt);
    ASSERT_GT(particle.positions[2], 0.625);
  }
  EXPECT_NEAR(particle.velocities[2], 1, 0.05);
}

TEST(UncoveredSurface, NearerThanWhatHoldsAParticleAddsNoForce) {
  const Mesh floor = floor_with_wall(false), corner = floor_with_wall(true);
  Mesh particle = point_at({0.03, 0.1, 0.101}, {0, 0, -2}, 1, 0.1);
  PenaltyContact contact(law);
  contact.set_topology(floor.body(), particle.body());
  contact.evaluate(floor.body(), particle.body(), dt);
  particle.drift(dt);
  ASSERT_NEAR(contact.evaluate(floor.body(), particle.body(), dt).secondary[2], 0.001 * stiffness, 1e-6 * stiffness);
  contact.set_topology(corner.body(), particle.body());
  particle.velocities.assign(3, 0.0);
  const ContactForces& forces = contact.evaluate(corner.body(), particle.body(), dt);
  EXPECT_NEAR(norm(row(forces.secondary, 0)), 0.001 * stiffness, 1e-6 * stiffness);
}
