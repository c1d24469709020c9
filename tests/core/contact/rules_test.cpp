// What happens to points that start inside, come through, leave over an edge.
#include <gtest/gtest.h>

#include "tests/core/contact/bodies.hpp"

using namespace polynya::contact;
using namespace polynya::contact::testing;

namespace {

constexpr ContactLaw law{.friction = 0, .damping = 0, .stiffness_factor = 0.1, .depth_limit = 0.2, .skin = 0.1};

/// Force on a point that moves along a path at a depth it came to through the face above.
class Tracked {
 public:
  Tracked(Mesh surface, Vector3 entry, ContactLaw rules = law, double radius = 0)
      : surface_(std::move(surface)), point_(point_at(entry, {}, 1, radius)), contact_(rules) {
    contact_.set_topology(surface_.body(), point_.body());
    to(entry);
  }
  /// Force at the next place on the way.
  Vector3 to(const Vector3& place) {
    for (std::size_t d = 0; d < 3; ++d) {
      point_.velocities[d] = (place[d] - point_.positions[d]) / dt;
      point_.positions[d] = place[d];
    }
    forces_ = contact_.evaluate(surface_.body(), point_.body(), dt);
    return row(forces_.secondary, 0);
  }
  const ContactForces& forces() const { return forces_; }
  static constexpr double dt = 1e-3;
  static constexpr double stiffness = 0.1 / (dt * dt);

 private:
  Mesh surface_, point_;
  PenaltyContact contact_;
  ContactForces forces_;
};

}  // namespace

TEST(Rules, ForcesOnBothSidesCancelToRounding) {
  Mesh floor = floor_of();
  floor.masses.assign(4, 2.0);
  floor.velocities = {1, 0, 0, 0, 2, 0, 0, 0, 1, 3, 0, 0};
  PenaltyContact contact({.friction = 0.3, .damping = 0.2, .stiffness_factor = 0.1, .depth_limit = 0.2});
  Mesh point = point_at({0.3, -0.2, 0.05}, {0.5, 0.25, -100});
  contact.set_topology(floor.body(), point.body());
  contact.evaluate(floor.body(), point.body(), 1e-3);
  point.drift(1e-3);
  const ContactForces& forces = contact.evaluate(floor.body(), point.body(), 1e-3);
  ASSERT_EQ(forces.active, 1u);
  for (std::size_t d = 0; d < 3; ++d) {
    double sum = forces.secondary[d];
    for (std::size_t v = 0; v < 4; ++v) sum += forces.primary[3 * v + d];
    EXPECT_NEAR(sum, 0.0, 1e-10 * std::abs(forces.secondary[2]));
  }
}

TEST(Rules, APointThatStartsInsideIsNotThrownOut) {
  const Mesh floor = floor_of();
  Mesh point = point_at({0.1, 0.2, -0.05}, {0, 0, 0.5});
  PenaltyContact contact(law);
  contact.set_topology(floor.body(), point.body());
  double stored = 0;
  const double dt = 1e-3;
  // It leaves at its own speed.
  for (int n = 0; n < 120; ++n) {
    const ContactForces& forces = contact.evaluate(floor.body(), point.body(), dt);
    stored = std::max(stored, forces.stored_energy);
    kick(point, forces.secondary, dt);
    point.drift(dt);
  }
  EXPECT_EQ(stored, 0);
  EXPECT_EQ(point.velocities[2], 0.5);
  // When it comes back it bounces off the surface, as any other.
  point.velocities[2] = -0.5;
  double lowest = 1;
  for (int n = 0; n < 100; ++n) {
    kick(point, contact.evaluate(floor.body(), point.body(), dt).secondary, dt);
    point.drift(dt);
    lowest = std::min(lowest, point.positions[2]);
  }
  // v / omega = 0.5 x 1e-3 / sqrt(0.1), and the way of a step.
  EXPECT_GT(lowest, -0.0022);
  EXPECT_NEAR(point.velocities[2], 0.5, 0.05);
}

TEST(Rules, APointThatStartsInsideMayNotGoDeeper) {
  const Mesh floor = floor_of();
  Mesh point = point_at({0.1, 0.2, -0.05}, {0, 0, -0.5});
  PenaltyContact contact(law);
  contact.set_topology(floor.body(), point.body());
  const double dt = 1e-3;
  for (int n = 0; n < 200; ++n) {
    kick(point, contact.evaluate(floor.body(), point.body(), dt).secondary, dt);
    point.drift(dt);
    ASSERT_GT(point.positions[2], -0.0522);
  }
  EXPECT_NEAR(point.velocities[2], 0.5, 0.05);
}

TEST(Rules, AFastPointDoesNotPassThroughAThinPlate) {
  // The plate is 5 mm thick, the point passes 40 mm in a step.
  for (const double radius : {0.0, 0.001}) {
    const Mesh plate = box_of({-1, -1, -0.005}, {1, 1, 0}, 4, 1e15);
    Mesh point = point_at({0.13, 0.21, 0.03}, {0, 0, -40}, 1, radius);
    PenaltyContact contact({.stiffness_factor = 0.1, .depth_limit = 0.01, .skin = 0.005});
    contact.set_topology(plate.body(), point.body());
    const double dt = 1e-3;
    double lowest = 0;
    for (int n = 0; n < 30; ++n) {
      kick(point, contact.evaluate(plate.body(), point.body(), dt).secondary, dt);
      point.drift(dt);
      lowest = std::min(lowest, point.positions[2]);
    }
    EXPECT_LT(lowest, -0.05);  // beyond the far side, and yet
    EXPECT_GT(point.positions[2], 0);
    EXPECT_NEAR(point.velocities[2], 40, 4);
  }
}

TEST(Rules, APointDoesNotSlipThroughASeamBetweenTriangles) {
  // Straight through vertices and edges of a floor.
  const Mesh floor = floor_of(1, 8);
  for (int n = 0; n < 200; ++n) {
    const double x = -0.75 + 0.0078125 * n;
    Tracked point(floor, {x, 0.25, 0.01});
    EXPECT_GT(point.to({x, 0.25, -0.01})[2], 0) << x;
    EXPECT_NEAR(point.forces().deepest, 0.01, 1e-15);
  }
}

TEST(Rules, AnOpenSheetDoesNotActBeyondItsEdge) {
  const Mesh floor = floor_of();
  Tracked beside(floor, {1.001, 0, 0.01});
  EXPECT_EQ(beside.to({1.001, 0, -0.01})[2], 0);
  EXPECT_EQ(beside.to({1.001, 0, -0.05})[2], 0);
}

TEST(Rules, ForceFadesContinuouslyWhereAPointLeavesOverAnEdge) {
  // Sharp edges of a box and open edges of a sheet, over a side and over a corner. Steps of a hundredth of the depth
  // change the force by no more than the largest slope of faded_depth: its push turns at most at 4 / depth.
  const double depth = 0.01;
  for (const Mesh& surface : {box_of({-1, -1, -1}, {1, 1, 0}, 3, 1e15), floor_of(1, 3)})
    for (const Vector3 way : {Vector3{1, 0, 0}, Vector3{0.8, 0.6, 0}, Vector3{std::sqrt(0.5), std::sqrt(0.5), 0}}) {
      const Vector3 edge{1, way[1] / way[0], 0};
      const auto place = [&](double beyond, double z) { return edge + beyond * way + Vector3{0, 0, z}; };
      Tracked point(surface, place(-0.05, 0.001));
      Vector3 before = point.to(place(-0.05, -depth));
      EXPECT_NEAR(before[2], Tracked::stiffness * depth, 1e-9 * before[2]);
      double largest_change = 0, stored = point.forces().stored_energy, largest_energy_change = 0;
      for (double beyond = -0.05; beyond < 0.05; beyond += depth / 100) {
        const Vector3 force = point.to(place(beyond, -depth));
        largest_change = std::max(largest_change, norm(force - before));
        largest_energy_change = std::max(largest_energy_change, std::abs(point.forces().stored_energy - stored));
        stored = point.forces().stored_energy;
        before = force;
      }
      EXPECT_LT(largest_change, 0.06 * Tracked::stiffness * depth);
      EXPECT_LT(largest_energy_change, 0.03 * Tracked::stiffness * depth * depth);
      EXPECT_EQ(norm(before), 0);
    }
}

TEST(Rules, ForceOnAParticleTurnsContinuouslyAroundAnEdge) {
  const double radius = 0.1, depth = 0.01;
  Tracked particle(box_of({-1, -1, -1}, {1, 1, 0}, 2, 1e15), {0.8, 0.1, 0.101}, law, radius);
  Vector3 before = particle.to({0.8, 0.1, radius - depth});
  double largest = 0;
  const auto visit = [&](const Vector3& place) {
    const Vector3 force = particle.to(place);
    EXPECT_NEAR(norm(force), Tracked::stiffness * depth, 1e-6 * Tracked::stiffness * depth);
    largest = std::max(largest, norm(force - before));
    before = force;
  };
  for (double x = 0.8; x < 1; x += 0.001) visit({x, 0.1, radius - depth});
  for (double a = 0; a < 1.57; a += 0.01)
    visit({1 + (radius - depth) * std::sin(a), 0.1, (radius - depth) * std::cos(a)});
  for (double z = 0; z < 0.2; z += 0.001) visit({1 + radius - depth, 0.1, -z});
  EXPECT_LT(largest, 0.012 * Tracked::stiffness * depth);  // the turn of a step
}

TEST(Rules, MagnitudeIsContinuousOverABluntEdgeAndDirectionTurnsByItsAngle) {
  // A ridge that turns by 20 degrees; the point keeps its depth below the nearer face.
  const double angle = 10 * 3.14159265358979 / 180, depth = 0.01;
  Mesh ridge;
  for (double x : {-1.0, 0.0, 1.0})
    for (double y : {-1.0, 1.0}) ridge.add_point({x, y, -std::tan(angle) * std::abs(x)}, {}, 1e15);
  ridge.triangles = {0, 2, 3, 0, 3, 1, 2, 4, 5, 2, 5, 3};
  const auto place = [&](double x, double below) {
    return Vector3{x, 0.1, -std::tan(angle) * std::abs(x) - below / std::cos(angle)};
  };
  Tracked point(ridge, place(-0.2, -0.001));
  Vector3 before = point.to(place(-0.2, depth));
  double largest = 0;
  for (double x = -0.2; x < 0.2; x += 0.0003) {
    const Vector3 force = point.to(place(x, depth));
    EXPECT_NEAR(norm(force), Tracked::stiffness * depth, 1e-6 * norm(before));
    largest = std::max(largest, norm(force - before));
    before = force;
  }
  EXPECT_NEAR(largest, 2 * std::sin(angle) * norm(before), 1e-6 * norm(before));
}

TEST(Rules, ACornerExactlyAboveACornerIsCarried) {
  // Equal boxes on each other: the corners of the upper one are as near to the sides of the lower one as to its top.
  Mesh lower = box_of({0, 0, -1}, {1, 1, 0}, 1, 1e15), upper = box_of({0, 0, 0}, {1, 1, 1}, 1, 8);
  PenaltyContact contact(law);
  contact.set_topology(lower.body(), upper.body());
  const double dt = 1e-3;
  for (int n = 0; n < 1000; ++n) {
    const ContactForces& forces = contact.evaluate(lower.body(), upper.body(), dt);
    kick_as_one(upper, forces.secondary, dt, {0, 0, -10});
    upper.drift(dt);
    ASSERT_GT(upper.positions[2], -2.1 * 10 * dt * dt / 0.1 * 2);
    ASSERT_EQ(upper.positions[0], 0);
  }
}

TEST(Rules, OnAPlaneOfSymmetryNothingPushesAcross) {
  // A quarter of a pyramid with its tip on both planes; a particle above the tip and one on a plane's edge.
  Mesh quarter;
  quarter.add_point({0, 0, 0}, {}, 1e15);
  quarter.add_point({1, 0, -0.5}, {}, 1e15);
  quarter.add_point({0, 1, -0.5}, {}, 1e15);
  quarter.triangles = {0, 1, 2};
  ContactLaw mirrored = law;
  mirrored.mirror = {true, true};
  Tracked above(quarter, {0, 0, 0.2}, mirrored, 0.1);
  const Vector3 tip = above.to({0, 0, 0.09});
  EXPECT_EQ(tip[0], 0);
  EXPECT_EQ(tip[1], 0);
  EXPECT_NEAR(tip[2], Tracked::stiffness * 0.01, 1e-9 * tip[2]);
  Tracked inside(quarter, {0.0, 0, 0.01}, mirrored, 0);
  const Vector3 below = inside.to({0, 0, -0.01});
  EXPECT_GT(below[2], 0);
}

TEST(Rules, ParticleTouchesWithItsRadiusAndNotBeyond) {
  Tracked particle(floor_of(), {0, 0.1, 0.12}, law, 0.1);
  EXPECT_EQ(particle.to({0, 0.1, 0.101})[2], 0);
  particle.to({0, 0.1, 0.09});
  EXPECT_NEAR(particle.forces().deepest, 0.01, 1e-12);
}

TEST(Rules, NewParticlesTakeOverTheForceOfThePointsTheyReplace) {
  Mesh floor = floor_of();
  Mesh points = point_at({0, 0, 0.001}, {0, 0, -5});
  PenaltyContact contact(law);
  contact.set_topology(floor.body(), points.body());
  const double dt = 1e-3;
  contact.evaluate(floor.body(), points.body(), dt);
  points.drift(dt);
  const ContactForces before = contact.evaluate(floor.body(), points.body(), dt);
  ASSERT_GT(before.secondary[2], 0);
  // In its place comes a particle that is much deeper within its radius.
  Mesh particle;
  particle.add_point({0, 0, 0.05}, {0, 0, -1e-9}, 2, 0.1);
  particle.ids = {77};
  contact.set_topology(floor.body(), particle.body());
  const ContactForces& after = contact.evaluate(floor.body(), particle.body(), dt);
  EXPECT_NEAR(after.secondary[2], before.secondary[2], 1e-9 * before.secondary[2]);
  EXPECT_NEAR(after.stored_energy + after.released_energy, before.stored_energy, 1e-9 * before.stored_energy);
}

TEST(Rules, NewParticlesAroundANodeShareItsForce) {
  Mesh floor = floor_of();
  Mesh node = point_at({0, 0, 0.001}, {0, 0, -5});
  PenaltyContact contact(law);
  contact.set_topology(floor.body(), node.body());
  const double dt = 1e-3;
  contact.evaluate(floor.body(), node.body(), dt);
  node.drift(dt);
  const double force = contact.evaluate(floor.body(), node.body(), dt).secondary[2];
  ASSERT_GT(force, 0);
  // Four around it, and one in the next element.
  Mesh particles;
  for (const Vector3& x :
       {Vector3{0.05, 0.05, 0.04}, {-0.05, 0.05, 0.04}, {-0.05, -0.05, 0.04}, {0.05, -0.05, 0.04}, {0.15, 0.05, 0.04}})
    particles.add_point(x, {}, 2, 0.05);
  particles.ids = {70, 71, 72, 73, 74};
  contact.set_topology(floor.body(), particles.body());
  const ContactForces& after = contact.evaluate(floor.body(), particles.body(), dt);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(after.secondary[3 * i + 2], force / 4, 1e-9 * force);
  EXPECT_EQ(after.secondary[3 * 4 + 2], 0);
}

TEST(Rules, PartOfTheSpringLeavesWithTheMassThatBecomesAParticle) {
  Mesh floor = floor_of();
  Mesh ice = point_at({0, 0, 0.001}, {0, 0, -5});
  PenaltyContact contact(law);
  contact.set_topology(floor.body(), ice.body());
  const double dt = 1e-3;
  contact.evaluate(floor.body(), ice.body(), dt);
  ice.drift(dt);
  const ContactForces before = contact.evaluate(floor.body(), ice.body(), dt);
  const double force = before.secondary[2];
  ice.masses[0] *= 0.75;
  ice.add_point({0.05, 0.05, 0.04}, {}, 2, 0.05);
  contact.set_topology(floor.body(), ice.body());
  const ContactForces& after = contact.evaluate(floor.body(), ice.body(), dt);
  EXPECT_NEAR(after.secondary[2], 0.75 * force, 1e-9 * force);
  EXPECT_NEAR(after.secondary[5], 0.25 * force, 1e-9 * force);
  EXPECT_NEAR(after.stored_energy + after.released_energy, before.stored_energy, 1e-9 * before.stored_energy);
}

TEST(Rules, ParticlesTakeOverTheForceOfFacesThatVanish) {
  // A tip of the primary body in a face of the secondary; particles come in place of the face.
  Mesh tip = point_at({0, 0, 0.001}, {0, 0, -5}), face = floor_of();
  face.masses.assign(face.count(), 1.0);
  ContactLaw both_ways = law;
  both_ways.two_way = true;
  PenaltyContact contact(both_ways);
  contact.set_topology(tip.body(), face.body());
  const double dt = 1e-3;
  contact.evaluate(tip.body(), face.body(), dt);
  tip.drift(dt);
  const double force = contact.evaluate(tip.body(), face.body(), dt).primary[2];
  ASSERT_GT(force, 0);
  // The primary body needs a face that the particle can touch.
  Mesh hull = box_of({-0.1, -0.1, tip.positions[2]}, {0.1, 0.1, 0.2}, 1, 1e3), particle;
  hull.ids = {100, 101, 102, 103, 104, 105, 106, 107};
  particle.add_point({0, 0, tip.positions[2] - 0.04}, {}, 2, 0.05);
  particle.ids = {70};
  contact.set_topology(hull.body(), particle.body());
  EXPECT_NEAR(contact.evaluate(hull.body(), particle.body(), dt).secondary[2], -force, 1e-9 * force);
}

TEST(Rules, ARigidBodyIsAsStiffAContactAsItsWholeMassAllows) {
  // Light vertices of a heavy rigid plate: the point's mass alone bounds the stiffness. Many points: the sum of what they may have.
  const double dt = 1e-3, depth = 1e-4;
  const auto force_of = [&](double vertex_mass, bool rigid, int points) {
    Mesh floor = floor_of(1, 1), dropped;
    floor.masses.assign(floor.count(), vertex_mass);
    for (int n = 0; n < points; ++n) dropped.add_point({0.1 + 0.001 * n, 0.2, 1e-12}, {0, 0, -(depth + 1e-12) / dt}, 1);
    Body plate = floor.body();
    plate.rigid = rigid;
    PenaltyContact contact(law);
    contact.set_topology(plate, dropped.body());
    contact.evaluate(plate, dropped.body(), dt);
    dropped.drift(dt);
    const ContactForces& forces = contact.evaluate(plate, dropped.body(), dt);
    double sum = 0;
    for (int n = 0; n < points; ++n) sum += forces.secondary[3 * static_cast<std::size_t>(n) + 2];
    return sum;
  };
  const double rate = 0.1 / (dt * dt);
  EXPECT_LT(force_of(0.01, false, 1), 0.05 * rate * depth);  // vertices on their own
  EXPECT_NEAR(force_of(100, true, 1), rate * depth / (1 + 0.01), 1e-9 * rate * depth);
  EXPECT_NEAR(force_of(100, true, 1000), 100 * rate * depth, 1e-6 * rate * depth);
}

TEST(Rules, TouchesOnlyTrianglesThatAreNotItsOwn) {
  // A folded strip: its end comes down on its beginning. Points do not meet the faces around themselves.
  Mesh strip;
  const int n = 10;
  for (int i = 0; i <= n; ++i)
    for (double y : {0.0, 0.1}) strip.add_point({0.1 * i, y, 0}, {}, 1);
  for (std::int32_t i = 0; i < n; ++i) {
    const std::int32_t a = 2 * i, b = a + 2, c = a + 3, d = a + 1;
    strip.triangles.insert(strip.triangles.end(), {a, b, c, a, c, d});
  }
  const std::size_t tip = strip.add_point({0.55, 0.03, 0.01}, {0, 0, -20}, 1);
  SelfContact contact(law);
  const Exclusion exclusion{.neighbours = true};
  contact.set_topology(strip.body());
  EXPECT_EQ(contact.evaluate(strip.body(), exclusion, 1e-3).active, 0u);
  strip.drift(1e-3);
  const ContactForces& forces = contact.evaluate(strip.body(), exclusion, 1e-3);
  EXPECT_EQ(forces.active, 1u);
  EXPECT_GT(forces.secondary[3 * tip + 2], 0);
  double sum = 0;
  for (std::size_t v = 0; v < strip.count(); ++v) sum += forces.secondary[3 * v + 2];
  EXPECT_NEAR(sum, 0, 1e-12 * forces.secondary[3 * tip + 2]);
}

TEST(Rules, WhatWasBondedAtItsOriginDoesNotTouch) {
  Mesh floor = floor_of(1, 4);
  const std::size_t particle = floor.add_point({0.1, 0.1, 0.3}, {0, 0, -400}, 1, 0.1);
  std::vector<double> points(3 * floor.count(), 100.0), triangles(floor.triangles.size(), 0.0);
  for (const double origin : {0.5, 1.5}) {
    Mesh now = floor;
    points[3 * particle] = origin, points[3 * particle + 1] = points[3 * particle + 2] = 0;
    SelfContact contact(law);
    const std::vector<double> point_reach(now.count(), 0.4), triangle_reach(now.body().triangle_count(), 0.6);
    const Exclusion exclusion{.neighbours = false,
                              .point_origins = points,
                              .point_reaches = point_reach,
                              .triangle_origins = triangles,
                              .triangle_reaches = triangle_reach};
    contact.set_topology(now.body());
    contact.evaluate(now.body(), exclusion, 1e-3);
    now.drift(0.6e-3);
    EXPECT_EQ(contact.evaluate(now.body(), exclusion, 1e-3).active, origin > 1 ? 1u : 0u);
  }
}
