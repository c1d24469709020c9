#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "structure_solver/rigid_motion.hpp"

namespace polynya::structure {
namespace {

using Eigen::Vector3d;

double spin_energy(const RigidMotion& body) {
  return 0.5 * angular_velocity(body).dot(body.angular_momentum);
}

TEST(RigidMotion, FallsAsHalfGravityTimesTimeSquared) {
  RigidMotion body;
  body.mass = 0.3;
  const double g = 9.81, dt = 1e-4;
  push(body, {0, 0, -body.mass * g}, Vector3d::Zero(), 0, dt);
  for (int n = 0; n < 10000; ++n) {
    advance(body, dt);
    push(body, {0, 0, -body.mass * g}, Vector3d::Zero(), dt, dt);
  }
  EXPECT_NEAR(body.centre.z(), -0.5 * g, 1e-10);
}

TEST(RigidMotion, TorqueFreeTopKeepsEnergyAndAngularMomentum) {
  RigidMotion body;
  body.mass = 1;
  body.inertia = Vector3d(1.0, 2.0, 3.5).asDiagonal();
  body.angular_momentum = {0.3, 4.0, 0.2};  // near the unstable axis: it tumbles
  const Vector3d momentum = body.angular_momentum;
  const double energy = spin_energy(body);
  double farthest = 0;
  for (int n = 0; n < 20000; ++n) {
    advance(body, 5e-3);
    farthest = std::max(farthest, std::abs(spin_energy(body) / energy - 1));
  }
  EXPECT_LT(farthest, 1e-12);
  EXPECT_EQ(body.angular_momentum, momentum);
  EXPECT_NEAR((body.orientation.transpose() * body.orientation - Eigen::Matrix3d::Identity()).norm(), 0, 1e-14);
}

TEST(RigidMotion, SymmetricTopPrecessesAtTheRateOfTheTextbook) {
  // The axis of a free symmetric top circles the angular momentum at L / I1. The step is of second order, so two runs
  // extrapolate to the exact axis.
  const Vector3d momentum(0, 1.0, 2.0);
  const double time = 3.0;
  const Vector3d exact = Eigen::AngleAxisd(momentum.norm() / 2.0 * time, momentum.normalized()) * Vector3d(0, 0, 1);
  const auto axis = [&](int steps) -> Vector3d {
    RigidMotion body;
    body.inertia = Vector3d(2.0, 2.0, 0.7).asDiagonal();
    body.mass = 1;
    body.angular_momentum = momentum;
    for (int n = 0; n < steps; ++n) advance(body, time / steps);
    return body.orientation.col(2);
  };
  const double coarse = (axis(200) - exact).norm(), fine = (axis(400) - exact).norm();
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.05);
  EXPECT_LT(((4 * axis(400) - axis(200)) / 3 - exact).norm(), 1e-3 * fine);
}

TEST(RigidMotion, WorkOfForcesIsTheChangeOfKineticEnergyWhateverTheSteps) {
  RigidMotion body;
  body.mass = 0.4;
  body.velocity = {1, 2, 3};
  const auto force = [](int n) { return Vector3d(std::sin(0.1 * n), 0.3, std::cos(0.2 * n)); };
  push(body, Vector3d::Zero(), Vector3d::Zero(), 0, 0);
  const double start = body.kinetic_energy;
  double work = 0, before = 0, dt = 0.01;
  push(body, force(0), Vector3d::Zero(), 0, dt);
  for (int n = 1; n < 500; ++n) {
    before = dt;
    dt = 0.01 * (1 + 0.5 * std::sin(n));
    advance(body, before);
    work += 0.5 * before * (force(n - 1) + force(n)).dot(body.velocity);
    push(body, force(n), Vector3d::Zero(), before, dt);
  }
  EXPECT_NEAR(body.kinetic_energy - start - work - body.step_change, 0, 1e-12 * body.kinetic_energy);
}

TEST(RigidMotion, SymmetryAllowsOnlyItsMotions) {
  RigidMotion plane, axial;
  plane.freedom = Freedom::plane;
  axial.freedom = Freedom::axial;
  for (RigidMotion* body : {&plane, &axial}) {
    body->mass = 1;
    body->inertia << 1, 0, 0, 0, 2, 0.3, 0, 0.3, 3;
    push(*body, {1, 2, 3}, {4, 5, 6}, 0.5, 0.5);
    advance(*body, 0.5);
  }
  EXPECT_EQ(plane.velocity, Vector3d(0.5, 0, 1.5));
  EXPECT_EQ(angular_velocity(plane).x(), 0);
  EXPECT_NEAR(angular_velocity(plane).y(), 0.5 * 5 / 2.0, 1e-14);
  EXPECT_EQ(angular_velocity(plane).z(), 0);
  EXPECT_EQ(axial.velocity, Vector3d(0, 0, 1.5));
  EXPECT_EQ(axial.orientation, Eigen::Matrix3d::Identity());
}

TEST(RigidMotion, ResistsAForceAtAPointWithTheMassOfTheWorstDirection) {
  // A push of 1 N s at a point changes that point's velocity along the push by 1 / mass; no direction by more than resistance() says.
  RigidMotion body;
  body.mass = 3;
  body.inertia << 0.5, 0.1, 0, 0.1, 0.6, 0.05, 0, 0.05, 0.04;
  const Vector3d arm(0.05, -0.02, 0.4);
  double most = 0;
  for (int i = 0; i < 200; ++i)
    for (int j = 0; j < 100; ++j) {
      const double a = 2 * std::numbers::pi * i / 200, c = j / 99.0, s = std::sqrt(1 - c * c);
      const Vector3d along(s * std::cos(a), s * std::sin(a), c);
      RigidMotion pushed = body;
      push(pushed, along, arm.cross(along), 1, 1);
      most = std::max(most, along.dot(pushed.velocity + angular_velocity(pushed).cross(arm)));
    }
  EXPECT_NEAR(resistance(body, arm) * most, 1, 1e-3);
  EXPECT_LE(resistance(body, arm) * most, 1 + 1e-12);
  EXPECT_NEAR(resistance(body, Vector3d::Zero()), body.mass, 1e-12);
  body.freedom = Freedom::axial;
  EXPECT_EQ(resistance(body, arm), body.mass);
  body.freedom = Freedom::plane;
  EXPECT_NEAR(1 / resistance(body, arm), 1 / 3.0 + (0.05 * 0.05 + 0.4 * 0.4) / 0.6, 1e-12);
}

}  // namespace
}  // namespace polynya::structure
