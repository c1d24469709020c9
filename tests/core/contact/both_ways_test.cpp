#include <gtest/gtest.h>

#include "tests/core/contact/bodies.hpp"

using namespace polynya::contact;
using namespace polynya::contact::testing;

namespace {

constexpr double dt = 1e-3;

/// Total force between two slabs that overlap by `depth`, after they came to it from a distance.
double pressed(Mesh lower, Mesh upper, double depth, const ContactLaw& law) {
  PenaltyContact contact(law);
  contact.set_topology(lower.body(), upper.body());
  upper.move({0, 0, 1e-4});
  contact.evaluate(lower.body(), upper.body(), dt);
  upper.set_velocity({0, 0, -(depth + 1e-4) / dt});
  upper.drift(dt);
  const ContactForces& forces = contact.evaluate(lower.body(), upper.body(), dt);
  double sum = 0;
  for (std::size_t i = 0; i < upper.count(); ++i) sum += forces.secondary[3 * i + 2];
  return sum;
}

ContactLaw law_of(bool two_way, bool edges) {
  return {.friction = 0,
          .damping = 0,
          .stiffness_factor = 0.1,
          .depth_limit = 0.05,
          .skin = 0.05,
          .mirror = {},
          .two_way = two_way,
          .edges = edges};
}

/// A slab n x n squares; its mass is spread over vertices by area, as a solid's is.
Mesh slab(double low, double high, double half, int n, double mass) {
  Mesh mesh = box_of({-half, -half, low}, {half, half, high}, n, mass);
  std::vector<double> area(mesh.count(), 0.0);
  double total = 0;
  for (std::size_t t = 0; t < mesh.body().triangle_count(); ++t) {
    const std::int32_t* v = &mesh.triangles[3 * t];
    const Vector3 a = row(mesh.positions, v[0]);
    const double size = norm(cross(row(mesh.positions, v[1]) - a, row(mesh.positions, v[2]) - a));
    total += size;
    for (int k = 0; k < 3; ++k) area[v[k]] += size / 3;
  }
  for (std::size_t i = 0; i < mesh.count(); ++i) mesh.masses[i] = mass * area[i] / total;
  return mesh;
}

}  // namespace

TEST(BothWays, StiffnessIsNotCountedTwice) {
  // Equal slabs of different meshes on each other, the lower one a little wider and almost without motion: looked at
  // both ways the force is the mean of what it is each way, with edges or without.
  const double depth = 0.001;
  const Mesh lower = slab(-0.2, 0, 1.0, 8, 10), upper = slab(0, 0.2, 0.99, 5, 10);
  const double one = pressed(lower, upper, depth, law_of(false, false));
  const double other = pressed(upper, lower, -depth, law_of(false, false));
  const double both = pressed(lower, upper, depth, law_of(true, false));
  EXPECT_GT(both, 0.45 * std::min(one, std::abs(other)));
  EXPECT_LT(both, 1.05 * std::max(one, std::abs(other)));
  EXPECT_EQ(pressed(lower, upper, depth, law_of(true, true)), both);
}

TEST(BothWays, AFineHeadIsHeldByACoarseFace) {
  // A tip goes down in the middle of a coarse face: no vertex of the face comes near it.
  const auto deepest = [](bool two_way) {
    Mesh head = box_of({-0.05, -0.05, -0.3}, {0.05, 0.05, -1e-4}, 2, 1),
         ice = box_of({-1, -1, 0}, {1, 1, 0.3}, 1, 1e15);
    PenaltyContact contact(law_of(two_way, false));
    contact.set_topology(head.body(), ice.body());
    head.set_velocity({0, 0, 1});
    double highest = -1;
    for (int n = 0; n < 60; ++n) {
      head.drift(dt);
      highest = std::max(highest, head.positions[3 * (head.count() - 1) + 2]);
      kick_as_one(head, contact.evaluate(head.body(), ice.body(), dt).primary, dt);
    }
    return highest;
  };
  EXPECT_GT(deepest(false), 0.04);
  EXPECT_LT(deepest(true), 0.01);
}

TEST(BothWays, IsCalledForWhenThePrimaryIsFiner) {
  const Mesh fine = box_of({0, 0, 0}, {1, 1, 1}, 4, 1), coarse = box_of({0, 0, 0}, {1, 1, 1}, 3, 1);
  EXPECT_TRUE(is_finer(fine.body(), coarse.body()));
  EXPECT_FALSE(is_finer(coarse.body(), fine.body()));
  EXPECT_FALSE(is_finer(fine.body(), fine.body()));
  EXPECT_FALSE(is_finer(fine.body(), point_at({}, {}).body()));
}

namespace {

/// A bar along x with a sharp lower edge (turned by 45 degrees), made of n pieces.
Mesh roof(double height, int n, double half, bool along_x, bool edge_up) {
  Mesh mesh;
  const double s = edge_up ? -0.2 : 0.2;
  for (int i = 0; i <= n; ++i) {
    const double x = half * (2.0 * i / n - 1);
    for (const auto& [side, up] : {std::pair{-0.2, s}, std::pair{0.0, 0.0}, std::pair{0.2, s}})
      mesh.add_point(along_x ? Vector3{x, side, height + up} : Vector3{side, x, height + up}, {}, 1);
  }
  for (std::int32_t i = 0; i < n; ++i)
    for (std::int32_t k = 0; k < 2; ++k) {
      const std::int32_t a = 3 * i + k, b = a + 3, c = b + 1, d = a + 1;
      if (along_x == edge_up)
        mesh.triangles.insert(mesh.triangles.end(), {a, b, c, a, c, d});
      else
        mesh.triangles.insert(mesh.triangles.end(), {a, c, b, a, d, c});
    }
  return mesh;
}

}  // namespace

TEST(EdgeToEdge, CrossingEdgesDoNotPassThroughEachOther) {
  // Two roofs ridge on ridge, at right angles: no vertex of one comes near a face of the other.
  for (const bool edges : {false, true}) {
    Mesh lower = roof(0, 3, 1, true, true), upper = roof(0.02, 3, 0.9, false, false);
    // Ridges at y = 0.0 and x = 0.1, away from vertices.
    upper.move({0.1, 0, 0});
    PenaltyContact contact(law_of(true, edges));
    contact.set_topology(lower.body(), upper.body());
    lower.masses.assign(lower.count(), 1e15);
    upper.set_velocity({0, 0, -1});
    double lowest = 1;
    for (int n = 0; n < 60; ++n) {
      upper.drift(dt);
      lowest = std::min(lowest, upper.positions[3 * 1 + 2]);
      const ContactForces& forces = contact.evaluate(lower.body(), upper.body(), dt);
      if (forces.active > 0) {
        EXPECT_NEAR(forces.secondary[3 * 1 + 0], 0, 1e-9 * std::abs(forces.secondary[3 * 1 + 2]));
        EXPECT_GE(forces.secondary[3 * 1 + 2], 0);
      }
      kick_as_one(upper, forces.secondary, dt);
    }
    if (edges) {
      EXPECT_GT(lowest, -0.02);
      EXPECT_NEAR(upper.velocities[2], 1, 0.1);
    } else {
      EXPECT_LT(lowest, -0.03);
    }
  }
}

TEST(EdgeToEdge, ForceGoesOverContinuouslyToTheNextPieceAndFadesAtTheEnd) {
  const double depth = 0.01;
  Mesh lower = roof(0, 5, 1, true, true), upper = roof(0.01, 2, 0.9, false, false);
  lower.masses.assign(lower.count(), 1e15);
  PenaltyContact contact(law_of(false, true));
  contact.set_topology(lower.body(), upper.body());
  upper.move({0.03, 0.05, 0});
  contact.evaluate(lower.body(), upper.body(), dt);
  upper.set_velocity({0, 0, -(0.01 + depth) / dt});
  upper.drift(dt);
  const auto force = [&] {
    const ContactForces& forces = contact.evaluate(lower.body(), upper.body(), dt);
    Vector3 sum{};
    for (std::size_t i = 0; i < upper.count(); ++i) sum = sum + row(forces.secondary, i);
    return sum;
  };
  Vector3 before = force();
  EXPECT_GT(before[2], 0);
  upper.set_velocity({1e-4 / dt, 0, 0});
  double largest = 0;
  const double start = norm(before);
  for (double x = 0.03; x < 1.03; x += 1e-4) {
    upper.drift(dt);
    const Vector3 now = force();
    largest = std::max(largest, norm(now - before));
    if (x < 0.98) {
      EXPECT_NEAR(now[0], 0, 1e-9 * start);
    }
    before = now;
  }
  EXPECT_EQ(norm(before), 0);
  EXPECT_LT(largest, 0.07 * start);
}
