// A body that turns freely or under a torque, against the equations of Euler, which CVODE integrates.
#include <cvode/cvode.h>
#include <gtest/gtest.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "structure_solver/build_vehicle.hpp"
#include "structure_solver/rigid_vehicle.hpp"
#include "structure_solver/torque_free.hpp"
#include "tests/structure_solver/test_scene.hpp"

namespace polynya::structure {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

double spin_energy(const RigidMotion& body) {
  return 0.5 * angular_velocity(body).dot(body.angular_momentum);
}

/// An asymmetric top that tumbles: it starts near the unstable middle axis.
RigidMotion tumbling_top() {
  RigidMotion body;
  body.mass = 1;
  body.inertia = Vector3d(1.0, 2.0, 3.5).asDiagonal();
  body.angular_momentum = {0.3, 4.0, 0.2};
  push(body, Vector3d::Zero(), Vector3d::Zero(), 0, 0);
  return body;
}

/// A torque and a force that are fixed to the body, and gravity.
struct Loads {
  Matrix3d inertia = Matrix3d::Identity(), inverse = Matrix3d::Identity();
  double mass = 1, gravity = 0;
  Vector3d torque{0, 0, 0}, force{0, 0, 0};
};

/// Place, velocity, quaternion (x, y, z, w) and angular velocity in the body's frame: Euler's equations.
int euler(double, N_Vector state, N_Vector slope, void* data) {
  const Loads& l = *static_cast<const Loads*>(data);
  const double* y = N_VGetArrayPointer(state);
  double* f = N_VGetArrayPointer(slope);
  const Eigen::Map<const Eigen::Quaterniond> q(y + 6);
  const Vector3d w = Vector3d::Map(y + 10);
  Eigen::Map<Vector3d>(f + 0) = Vector3d::Map(y + 3);
  Eigen::Map<Vector3d>(f + 3) = q.toRotationMatrix() * l.force / l.mass - Vector3d(0, 0, l.gravity);
  Eigen::Map<Eigen::Quaterniond>(f + 6) = q * Eigen::Quaterniond(0, 0.5 * w.x(), 0.5 * w.y(), 0.5 * w.z());
  Eigen::Map<Vector3d>(f + 10) = l.inverse * (l.torque - w.cross(l.inertia * w));
  return 0;
}

struct Reference {
  Vector3d place, velocity;
  Matrix3d orientation;
};

Reference integrate(Loads loads, const Vector3d& place, const Vector3d& velocity, const Vector3d& angular,
                    double time) {
  loads.inverse = loads.inertia.inverse();
  SUNContext context = nullptr;
  SUNContext_Create(nullptr, &context);
  N_Vector state = N_VNew_Serial(13, context);
  double* y = N_VGetArrayPointer(state);
  Eigen::Map<Vector3d>(y + 0) = place, Eigen::Map<Vector3d>(y + 3) = velocity, Eigen::Map<Vector3d>(y + 10) = angular;
  Eigen::Map<Eigen::Quaterniond>(y + 6) = Eigen::Quaterniond::Identity();
  void* solver = CVodeCreate(CV_ADAMS, context);
  CVodeInit(solver, euler, 0.0, state);
  CVodeSStolerances(solver, 1e-12, 1e-13);
  CVodeSetUserData(solver, &loads);
  CVodeSetMaxNumSteps(solver, 10000000);
  SUNNonlinearSolver iteration = SUNNonlinSol_FixedPoint(state, 0, context);
  CVodeSetNonlinearSolver(solver, iteration);
  double reached = 0;
  EXPECT_EQ(CVode(solver, time, state, &reached, CV_NORMAL), CV_SUCCESS);
  const Reference end{Vector3d::Map(y), Vector3d::Map(y + 3),
                      Eigen::Map<const Eigen::Quaterniond>(y + 6).normalized().toRotationMatrix()};
  CVodeFree(&solver);
  SUNNonlinSolFree(iteration);
  N_VDestroy(state);
  SUNContext_Free(&context);
  return end;
}

TEST(FreeBody, ATorqueFreeTopKeepsEnergyAndAngularMomentumOverAThousandTurnsInStepsOfWindows) {
  RigidMotion body = tumbling_top();
  const Vector3d momentum = body.angular_momentum;
  const double energy = spin_energy(body);
  double turns = 0, farthest = 0;
  long steps = 0;
  for (; turns < 1000; ++steps) {
    const double dt = 0.05;
    turns += dt * angular_velocity(body).norm() / (2 * std::numbers::pi);
    advance(body, dt);
    farthest = std::max(farthest, std::abs(spin_energy(body) / energy - 1));
  }
  EXPECT_EQ(body.angular_momentum, momentum);
  EXPECT_LT(farthest, 1e-8);
  EXPECT_NEAR((body.orientation.transpose() * body.orientation - Matrix3d::Identity()).norm(), 0, 1e-13);
  std::printf("%.0f turns in %ld steps: energy within %.1e\n", turns, steps, farthest);
}

TEST(FreeBody, ATorqueFreeTopKeepsEnergyAndAngularMomentumOverAThousandTurnsByArkode) {
  RigidMotion body = tumbling_top();
  const Vector3d momentum = body.angular_momentum;
  const double energy = spin_energy(body);
  double turns = 0, farthest = 0;
  while (turns < 1000) {
    turns += 0.5 * angular_velocity(body).norm() / (2 * std::numbers::pi);
    advance_torque_free(body, 0.5);
    farthest = std::max(farthest, std::abs(spin_energy(body) / energy - 1));
  }
  EXPECT_EQ(body.angular_momentum, momentum);
  EXPECT_LT(farthest, 1e-8);
  std::printf("%.0f turns: energy within %.1e\n", turns, farthest);
}

TEST(FreeBody, OneFlightByArkodeOfManyTurnsIsThatOfEulersEquations) {
  RigidMotion body = tumbling_top();
  const double time = 100;
  const Reference end = integrate({.inertia = body.inertia}, body.centre, body.velocity, angular_velocity(body), time);
  advance_torque_free(body, time);
  EXPECT_LT((body.orientation - end.orientation).norm(), 1e-7);
}

TEST(FreeBody, AFallingSpinningVehicleFollowsTheReference) {
  scene::Scene scene = solid_scene();
  scene.symmetry = scene::Symmetry::full;
  scene.run.gravity = 9.81;
  scene.vehicle->deformable = false;
  scene.vehicle->angle = 0.4, scene.vehicle->offset_x = 0.03, scene.vehicle->offset_y = -0.02;
  scene.vehicle->spin = 900, scene.vehicle->pitch_rate = 300;
  scene.vehicle->ballast = {0.002, 0.003, 0.001, -0.08};  // no axis of symmetry is left
  const BuiltVehicle vehicle = build_vehicle(scene);
  auto& body = dynamic_cast<RigidVehicle&>(*vehicle.body);
  const RigidMotion start = body.motion();
  EXPECT_NEAR(start.velocity.norm(), 40, 1e-12);
  EXPECT_NEAR(start.velocity.x() / start.velocity.z(), std::tan(0.4), 1e-12);
  const double time = 0.1, energy = body.account().kinetic;
  const Reference end = integrate({.inertia = start.inertia, .mass = start.mass, .gravity = 9.81}, start.centre,
                                  start.velocity, angular_velocity(start), time);
  const int steps = 200;
  const double dt = time / steps;
  body.finish_step({}, 0, dt);
  for (int n = 0; n < steps; ++n) {
    body.advance_positions(dt);
    body.finish_step({}, dt, n + 1 < steps ? dt : 0);
  }
  const double turns = time * angular_velocity(start).norm() / (2 * std::numbers::pi);
  const double place = (body.motion().centre - end.place).norm();
  const double direction = (body.motion().orientation - end.orientation).norm();
  EXPECT_LT(place, 1e-12);
  EXPECT_LT(direction, 1e-8);
  EXPECT_LT((body.motion().velocity - end.velocity).norm(), 1e-10);
  EXPECT_NEAR(body.account().balance() / energy, 1, 1e-9);
  std::printf("%.0f turns: place within %.1e m, directions within %.1e\n", turns, place, direction);
}

TEST(FreeBody, ALoadedBodyConvergesToTheReferenceWithTheSquareOfTheStep) {
  Loads loads{.inertia = Vector3d(1.0, 2.0, 3.5).asDiagonal(),
              .mass = 2,
              .gravity = 9.81,
              .torque = {0.3, -0.2, 0.5},
              .force = {1, 2, -1}};
  const Vector3d angular(0.4, 1.2, -0.7), velocity(1, 2, 3);
  const double time = 4;
  const Reference end = integrate(loads, Vector3d::Zero(), velocity, angular, time);
  const auto solve = [&](int steps) {
    RigidMotion body;
    body.mass = loads.mass, body.inertia = loads.inertia, body.velocity = velocity;
    body.angular_momentum = loads.inertia * angular;
    const double dt = time / steps;
    for (int n = 0; n <= steps; ++n) {
      if (n > 0) advance(body, dt);
      push(body, body.orientation * loads.force - Vector3d(0, 0, loads.mass * loads.gravity),
           body.orientation * loads.torque, n > 0 ? dt : 0, n < steps ? dt : 0);
    }
    return std::pair<Vector3d, Matrix3d>(body.centre, body.orientation);
  };
  const auto coarse = solve(400), fine = solve(800);
  const double error = (fine.second - end.orientation).norm();
  EXPECT_NEAR(std::log2((coarse.second - end.orientation).norm() / error), 2, 0.05);
  EXPECT_NEAR(std::log2((coarse.first - end.place).norm() / (fine.first - end.place).norm()), 2, 0.05);
  EXPECT_LT(((4 * fine.second - coarse.second) / 3 - end.orientation).norm(), 1e-3 * error);
}

}  // namespace
}  // namespace polynya::structure
