#include <gtest/gtest.h>

#include "tests/core/contact/bodies.hpp"

using namespace polynya::contact;
using namespace polynya::contact::testing;

TEST(Energy, TenThousandBouncesNeitherGainNorLoseEnergy) {
  const Mesh floor = floor_of();
  PenaltyContact contact({.stiffness_factor = 0.1, .depth_limit = 0.2, .skin = 0.02});
  Mesh ball = point_at({0.1, 0.2, 0.05}, {});
  contact.set_topology(floor.body(), ball.body());
  const double gravity = 10, dt = 1e-3, start = gravity * ball.positions[2];
  double highest = 0;
  int bounces = 0;
  bool was_touching = false;
  while (bounces < 10000) {
    const ContactForces& forces = contact.evaluate(floor.body(), ball.body(), dt);
    const bool touching = forces.active > 0;
    if (touching && !was_touching) ++bounces;
    was_touching = touching;
    const double before = ball.velocities[2];
    kick(ball, forces.secondary, dt, {0, 0, -gravity});
    const double middle = 0.5 * (before + ball.velocities[2]);
    highest = std::max(highest, 0.5 * middle * middle + gravity * ball.positions[2] + forces.stored_energy);
    ball.drift(dt);
  }
  // The step passes the kink of the one-sided spring at a random phase: the energy wanders by the square of
  // (step / contact time) but must not drift.
  EXPECT_LT(highest, 1.1 * start);
  EXPECT_GT(ball.positions[2] * gravity + 0.5 * ball.velocities[2] * ball.velocities[2], 0.8 * start);
}

TEST(Energy, AThousandBouncesOfATumblingBoxOfSpringsNeitherGainNorLoseEnergy) {
  // Eight masses, all joined by springs, fall on a floor with friction 0 and turn as they like: points, edges and both
  // ways.
  Mesh floor = box_of({-3, -3, -1}, {3, 3, 0}, 6, 1e15);
  Mesh box = box_of({-0.3, -0.2, 0.5}, {0.3, 0.2, 0.8}, 1, 8);
  const std::vector<double> rest = box.positions;
  for (std::size_t i = 0; i < box.count(); ++i)
    box.velocities[3 * i] = 2 * (rest[3 * i + 2] - 0.65), box.velocities[3 * i + 1] = -rest[3 * i];
  PenaltyContact contact({.stiffness_factor = 0.1, .depth_limit = 0.1, .skin = 0.05, .two_way = true, .edges = true});
  contact.set_topology(floor.body(), box.body());
  const double dt = 2e-4, gravity = 10, spring = 2e4;
  const auto springs = [&](std::vector<double>& force) {
    double energy = 0;
    for (std::size_t i = 0; i < box.count(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const Vector3 d = row(box.positions, i) - row(box.positions, j), d0 = row(rest, i) - row(rest, j);
        const double stretch = norm(d) - norm(d0);
        energy += 0.5 * spring * stretch * stretch;
        add_to_row(force, i, (-spring * stretch / norm(d)) * d);
        add_to_row(force, j, (spring * stretch / norm(d)) * d);
      }
    return energy;
  };
  double start = 0, highest = 0, last = 0;
  std::size_t touching = 0;
  std::vector<double> force, before;
  for (int n = 0; n < 200000; ++n) {
    const ContactForces& forces = contact.evaluate(floor.body(), box.body(), dt);
    force = forces.secondary;
    double energy = forces.stored_energy + springs(force);
    before = box.velocities;
    kick(box, force, dt, {0, 0, -gravity});
    for (std::size_t k = 0; k < before.size(); ++k) {
      const double middle = 0.5 * (before[k] + box.velocities[k]);
      energy += 0.5 * box.masses[k / 3] * middle * middle;
      if (k % 3 == 2) energy += box.masses[k / 3] * gravity * box.positions[k];
    }
    touching += forces.active;
    if (n == 1) start = energy;
    highest = std::max(highest, energy);
    last = energy;
    // It must not wander off the floor.
    if (std::abs(box.positions[0]) > 2.5 || std::abs(box.positions[1]) > 2.5) {
      Vector3 mean{};
      for (std::size_t i = 0; i < box.count(); ++i) mean = mean + 0.125 * row(box.positions, i);
      box.move({-mean[0], -mean[1], 0});
      contact.set_topology(floor.body(), box.body());
    }
    box.drift(dt);
  }
  EXPECT_GT(touching, 1000u);
  EXPECT_LT(highest, 1.05 * start);
  EXPECT_NEAR(last, start, 0.05 * start);
}

TEST(Energy, ManyPointsOnOneVertexStayStable) {
  // A thousand light points around one light vertex of the surface: pair by pair the stiffness would be within its
  // bound, together they would throw the vertex about.
  for (const double factor : {0.1, 1.0}) {
    Mesh sheet = floor_of(1, 2);
    const std::size_t middle = 4;
    sheet.masses[middle] = 1;
    Mesh points;
    for (int i = 0; i < 1000; ++i) points.add_point({1e-3 * std::cos(i), 1e-3 * std::sin(i), 1e-6}, {0, 0, -1}, 0.5);
    PenaltyContact contact({.stiffness_factor = factor, .depth_limit = 0.1, .skin = 0.05});
    contact.set_topology(sheet.body(), points.body());
    const double dt = 1e-3, start = 0.5 * 500;
    for (int n = 0; n < 2000; ++n) {
      const ContactForces& forces = contact.evaluate(sheet.body(), points.body(), dt);
      kick(points, forces.secondary, dt);
      sheet.velocities[3 * middle + 2] += dt * forces.primary[3 * middle + 2] / sheet.masses[middle];
      points.drift(dt);
      sheet.drift(dt);
      double kinetic = 0.5 * std::pow(sheet.velocities[3 * middle + 2], 2);
      for (std::size_t i = 0; i < points.count(); ++i) kinetic += 0.25 * std::pow(points.velocities[3 * i + 2], 2);
      ASSERT_LT(kinetic, 1.3 * start) << factor << " " << n;
    }
  }
}

TEST(Energy, DampingOnlyRemovesEnergyAndNeverPulls) {
  for (const double damping : {0.1, 0.5, 1.0}) {
    const Mesh floor = floor_of();
    Mesh point = point_at({0.1, 0.2, 0.001}, {0, 0, -1});
    PenaltyContact contact({.damping = damping, .stiffness_factor = 0.01, .depth_limit = 0.2, .skin = 0.1});
    contact.set_topology(floor.body(), point.body());
    const double dt = 1e-3;
    double loss = 0;
    for (int n = 0; n < 200; ++n) {
      const ContactForces& forces = contact.evaluate(floor.body(), point.body(), dt);
      EXPECT_GE(forces.secondary[2], 0);
      loss += forces.damping_loss;
      EXPECT_GE(loss, 0);
      kick(point, forces.secondary, dt);
      point.drift(dt);
    }
    EXPECT_GT(point.velocities[2], 0);
    EXPECT_NEAR(loss, 0.5 - 0.5 * point.velocities[2] * point.velocities[2], 0.02 * 0.5);
    // A linear oscillator that is let go where spring and damper cancel: e = exp(-zeta/sqrt(1 - zeta^2) acos(2 zeta^2 -
    // 1)) for the time until that happens (zeta < 1).
    if (damping < 1) {
      const double root = std::sqrt(1 - damping * damping);
      const double restitution = std::exp(-damping / root * std::atan2(2 * damping * root, 2 * damping * damping - 1));
      EXPECT_NEAR(point.velocities[2], restitution, 0.06);
    }
  }
}

TEST(Energy, DampingThatAnExplicitStepCannotBearIsRefused) {
  EXPECT_THROW(PenaltyContact({.damping = 0.9, .stiffness_factor = 1}), std::invalid_argument);
  EXPECT_THROW(PenaltyContact({.damping = -0.1}), std::invalid_argument);
}

TEST(Energy, AFallingBoundOfStiffnessIsBooked) {
  const Mesh floor = floor_of();
  Mesh point = point_at({0.1, 0.2, 0.001}, {0, 0, -5});
  PenaltyContact contact({.stiffness_factor = 0.1, .depth_limit = 0.2, .skin = 0.1});
  contact.set_topology(floor.body(), point.body());
  contact.evaluate(floor.body(), point.body(), 1e-3);
  point.drift(1e-3);
  const double before = contact.evaluate(floor.body(), point.body(), 1e-3).stored_energy;
  // The step doubles: the stiffness falls to a quarter, and does not rise again.
  const ContactForces& longer = contact.evaluate(floor.body(), point.body(), 2e-3);
  EXPECT_NEAR(longer.stored_energy, 0.25 * before, 1e-12 * before);
  EXPECT_NEAR(longer.released_energy, 0.75 * before, 1e-12 * before);
  const ContactForces& shorter = contact.evaluate(floor.body(), point.body(), 1e-3);
  EXPECT_NEAR(shorter.stored_energy, 0.25 * before, 1e-12 * before);
  EXPECT_NEAR(shorter.released_energy, 0, 1e-12 * before);
}
