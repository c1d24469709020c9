#include <gtest/gtest.h>

#include <numbers>

#include "tests/core/contact/bodies.hpp"

using namespace polynya::contact;
using namespace polynya::contact::testing;

namespace {

constexpr double g = 10, dt = 1e-4, mu = 0.3, factor = 0.1;

/// A point on an incline, in the frame of the incline: z is its normal. Starts at rest at its static depth.
struct Slope {
  Mesh floor, point;
  PenaltyContact contact;
  Vector3 gravity;
  double friction_loss = 0, stored = 0;

  Slope(double angle, Vector3 along, int cells)
      : floor(floor_of(1, cells)),
        point(point_at({0.013, 0.017, -g * std::cos(angle) * dt * dt / factor}, {})),
        contact({.friction = mu, .stiffness_factor = factor, .depth_limit = 0.1, .skin = 0.01}),
        gravity{g * std::sin(angle) * along[0], g * std::sin(angle) * along[1], -g * std::cos(angle)} {
    contact.set_topology(floor.body(), point.body());
    // The static depth is one to which the point came: from just outside.
    const double depth = point.positions[2];
    point.positions[2] = 1e-12;
    contact.evaluate(floor.body(), point.body(), dt);
    point.positions[2] = depth;
    point.velocities[2] = (depth - 1e-12) / dt;
    contact.evaluate(floor.body(), point.body(), dt);
    point.velocities[2] = 0;
  }
  void step() {
    const ContactForces& forces = contact.evaluate(floor.body(), point.body(), dt);
    friction_loss += forces.friction_loss;
    stored = forces.stored_energy;
    kick(point, forces.secondary, dt, gravity);
    point.drift(dt);
  }
};

double radians(double degrees) {
  return degrees * std::numbers::pi / 180;
}

}  // namespace

TEST(Friction, HoldsABlockForEverBelowTheFrictionAngle) {
  // atan 0.3 = 16.7 degrees. The tangential spring is not yet stretched at the start, so the block swings about its
  // equilibrium with g sin(angle) / omega^2, omega^2 = factor / dt^2, and by no more; a leapfrog's swing is longer by
  // up to factor / 4.
  const double angle = radians(8);
  const double amplitude = g * std::sin(angle) * dt * dt / factor;
  Slope slope(angle, {0.6, 0.8, 0}, 7);
  const Vector3 start = row(slope.point.positions, 0);
  for (int n = 0; n < 200000; ++n) {
    slope.step();
    ASSERT_LT(norm(row(slope.point.positions, 0) - start), (2 + factor / 4) * amplitude) << n;
  }
  EXPECT_EQ(slope.friction_loss, 0);
}

TEST(Friction, LetsABlockSlideWithTheCoulombAccelerationAboveTheFrictionAngle) {
  // Over many triangles and along their edges; the normal force is that of the weight to rounding.
  for (const Vector3 along : {Vector3{1, 0, 0}, Vector3{0.6, 0.8, 0}, Vector3{std::sqrt(0.5), std::sqrt(0.5), 0}}) {
    const double angle = radians(30);
    Slope slope(angle, along, 40);
    for (int n = 0; n < 100; ++n) slope.step();
    const Vector3 v0 = row(slope.point.velocities, 0);
    constexpr int steps = 4000;
    for (int n = 0; n < steps; ++n) slope.step();
    const Vector3 a = (1 / (steps * dt)) * (row(slope.point.velocities, 0) - v0);
    const double expected = g * (std::sin(angle) - mu * std::cos(angle));
    EXPECT_NEAR(dot(a, along), expected, 1e-6 * expected);
    EXPECT_LT(norm(a - dot(a, along) * along), 1e-6 * expected);
  }
}

TEST(Friction, DissipatesWhatTheWeightHasDoneBeyondTheMotion) {
  const double angle = radians(30);
  Slope slope(angle, {1, 0, 0}, 5);
  const double start = slope.point.positions[0];
  double velocity = 0;
  for (int n = 0; n < 5000; ++n) {
    velocity = slope.point.velocities[0];
    slope.step();
  }
  // Positions are at the end of steps, velocities in their middle.
  const double middle = 0.5 * (velocity + slope.point.velocities[0]);
  const double path = slope.point.positions[0] - dt * slope.point.velocities[0] - start;
  const double work = g * std::sin(angle) * path;
  EXPECT_NEAR(slope.friction_loss, work - 0.5 * middle * middle, 1e-3 * work);
}

TEST(Friction, CarriesItsSpringAlongWithTheMaterialThatTurns) {
  // A point pressed on a turntable by its weight sticks: it goes round with it.
  Mesh floor = floor_of(1, 6);
  Mesh point = point_at({0.5, 0, 1e-9}, {0, 0, -1e-3});
  const double rate = 1.0;  // rad/s; the centripetal acceleration of 0.5 m/s^2 is below mu g
  PenaltyContact contact(
      {.friction = mu, .damping = 0.3, .stiffness_factor = factor, .depth_limit = 0.1, .skin = 0.01});
  contact.set_topology(floor.body(), point.body());
  const std::vector<double> start = floor.positions;
  point.velocities[1] = 0.5 * rate;
  constexpr double step = 1e-3;
  for (int n = 1; n <= 4000; ++n) {
    const double turn = rate * n * step, c = std::cos(turn), s = std::sin(turn);
    for (std::size_t v = 0; v < floor.count(); ++v) {
      const Vector3 x{c * start[3 * v] - s * start[3 * v + 1], s * start[3 * v] + c * start[3 * v + 1], 0};
      for (std::size_t d = 0; d < 3; ++d) {
        floor.velocities[3 * v + d] = (x[d] - floor.positions[3 * v + d]) / step;
        floor.positions[3 * v + d] = x[d];
      }
    }
    point.drift(step);
    kick(point, contact.evaluate(floor.body(), point.body(), step).secondary, step, {0, 0, -g});
  }
  // It lags by the stretch of the spring and what it took to get there: a thousandth of its way.
  const double turn = rate * 4000 * step;
  EXPECT_NEAR(point.positions[0], 0.5 * std::cos(turn), 2e-3);
  EXPECT_NEAR(point.positions[1], 0.5 * std::sin(turn), 2e-3);
}

TEST(Friction, DissipatesOnlyWhereSomethingSlidesAlsoOverFacesThatTurn) {
  // A deep point is drawn over ridges of 12 degrees. The depth times the angle is no way that it has slid.
  const double angle = 12 * std::numbers::pi / 180, depth = 0.05;
  Mesh ridges;
  const auto outline = [&](int n) { return Vector3{std::sin(n * angle), 0, std::cos(n * angle)}; };
  for (int n = -4; n <= 4; ++n)
    for (const double y : {-1.0, 1.0}) ridges.add_point(outline(n) + Vector3{0, y, 0}, {}, 1e15);
  for (std::int32_t n = 0; n < 8; ++n)
    ridges.triangles.insert(ridges.triangles.end(), {2 * n, 2 * n + 2, 2 * n + 3, 2 * n, 2 * n + 3, 2 * n + 1});
  const auto place = [&](double turn, double below) {
    return Vector3{(1 - below) * std::sin(turn), 0.1, (1 - below) * std::cos(turn)};
  };
  Mesh point = point_at(place(-3.4 * angle, -0.001), {});
  PenaltyContact contact({.friction = mu, .stiffness_factor = factor, .depth_limit = 0.1, .skin = 0.01});
  contact.set_topology(ridges.body(), point.body());
  contact.evaluate(ridges.body(), point.body(), dt);
  Vector3 force{};
  double work = 0, lost = 0, stored = 0;
  constexpr int steps = 40000;
  for (int n = 1; n <= steps; ++n) {
    const double part = static_cast<double>(n) / steps;
    const Vector3 x = place((-3.4 + 6.8 * part) * angle, depth * std::min(1.0, 10 * part));
    const Vector3 step = x - row(point.positions, 0);
    for (std::size_t d = 0; d < 3; ++d) point.velocities[d] = step[d] / dt, point.positions[d] = x[d];
    const ContactForces& forces = contact.evaluate(ridges.body(), point.body(), dt);
    const Vector3 next = row(forces.secondary, 0);
    work += 0.5 * dot(force + next, step);
    lost += forces.friction_loss + forces.released_energy;
    stored = forces.stored_energy;
    force = next;
  }
  EXPECT_GT(lost, stored);
  EXPECT_NEAR(lost + stored, -work, 1e-3 * lost);
}

TEST(Friction, CountsNoSlipThatTheMotionOfANeedleCannotHaveBrought) {
  // A point that has slid stops on a strip far narrower than its spring is long; then the strip widens by half. The
  // spring's anchor lies some hundred widths beside it and goes a hundred times as far.
  constexpr double width = 1e-4, step = 1e-6, depth = 0.05;
  Mesh floor;
  for (const double y : {-1.0, 0.0, width, 1.0})
    for (const double x : {-1.0, 1.0}) floor.add_point({x, y, 0}, {}, 1e15);
  for (std::int32_t n = 0; n < 3; ++n)
    floor.triangles.insert(floor.triangles.end(), {2 * n, 2 * n + 1, 2 * n + 3, 2 * n, 2 * n + 3, 2 * n + 2});
  Mesh point = point_at({0.2, -0.1, 1e-3}, {});
  PenaltyContact contact({.friction = mu, .stiffness_factor = factor, .depth_limit = 0.1, .skin = 0.01});
  contact.set_topology(floor.body(), point.body());
  contact.evaluate(floor.body(), point.body(), dt);
  const auto go_to = [&](const Vector3& x) -> const ContactForces& {
    for (std::size_t d = 0; d < 3; ++d) {
      point.velocities[d] = (x[d] - point.positions[d]) / dt;
      point.positions[d] = x[d];
    }
    return contact.evaluate(floor.body(), point.body(), dt);
  };
  double slid = 0;
  for (int n = 1; n <= 1000; ++n) {
    const double part = n / 1000.0;
    slid +=
        go_to({0.2, -0.1 + (0.1 + 0.5 * width) * part, 1e-3 - (1e-3 + depth) * std::min(1.0, 5 * part)}).friction_loss;
  }
  EXPECT_GT(slid, 0);
  const double normal_force = go_to({0.2, 0.5 * width, -depth}).secondary[2];
  EXPECT_GT(normal_force, 0);
  const std::size_t corner = 3 * 5 + 1;  // y of (1, width, 0)
  double lost = 0;
  floor.velocities[corner] = step / dt;
  for (int n = 0; n < 50; ++n) {
    floor.positions[corner] += step;
    lost += go_to({0.2, 0.5 * width, -depth}).friction_loss;
  }
  EXPECT_LE(lost, mu * normal_force * 2 * 50 * step * (1 + 1e-9));
}

TEST(Friction, DissipatesWhatItSlidesAlsoAlongAndAroundARim) {
  // A deep point is drawn around the rim of a plate, first along it, then beyond it: the push tilts and is longer than 1 there.
  Mesh floor = floor_of(1, 4);
  Mesh point = point_at({-0.8, 0.97, 1e-3}, {});
  PenaltyContact contact({.friction = mu, .stiffness_factor = factor, .depth_limit = 0.1, .skin = 0.01});
  contact.set_topology(floor.body(), point.body());
  contact.evaluate(floor.body(), point.body(), dt);
  Vector3 force{};
  double work = 0, lost = 0, stored = 0, way = 0, largest = 0;
  constexpr int steps = 40000;
  for (int n = 1; n <= steps; ++n) {
    const double part = static_cast<double>(n) / steps;
    const Vector3 x{-0.8 + 1.6 * part, 0.97 + 0.05 * std::min(1.0, 2 * part), -0.05 * std::min(1.0, 10 * part)};
    const Vector3 step = x - row(point.positions, 0);
    for (std::size_t d = 0; d < 3; ++d) point.velocities[d] = step[d] / dt, point.positions[d] = x[d];
    const ContactForces& forces = contact.evaluate(floor.body(), point.body(), dt);
    const Vector3 next = row(forces.secondary, 0);
    work += 0.5 * dot(force + next, step);
    lost += forces.friction_loss + forces.released_energy;
    stored = forces.stored_energy;
    way += norm(step);
    largest = std::max(largest, norm(next));
    force = next;
  }
  EXPECT_GT(lost, stored);
  EXPECT_NEAR(lost + stored, -work, 2e-3 * lost);
  EXPECT_LT(lost, mu * largest * way);
}
