#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "ice_solver/ball.hpp"
#include "ice_solver/rigid_target.hpp"
#include "tests/ice_solver/ice_bodies.hpp"

namespace polynya::ice {
namespace {

using namespace testing;

IceOptions ball_options(double element, double speed) {
  IceOptions options;
  options.ball = {0.02, element, 0, speed};
  options.law = elastic_ice();
  options.planes = {true, true};
  options.conversion = false;
  return options;
}

TEST(BallMesh, FillsTheBall) {
  for (const SymmetryPlanes planes : {SymmetryPlanes{true, true}, SymmetryPlanes{false, true}, SymmetryPlanes{}}) {
    const double share = (planes.x ? 0.5 : 1) * (planes.y ? 0.5 : 1);
    double missing[2];
    for (int i = 0; i < 2; ++i) {
      const auto mesh = ball_mesh(1, i == 0 ? 0.2 : 0.1, 5, planes);
      const auto solid = continuum::make_solid("ball", mesh, elastic_ice());  // throws if a volume is not positive
      double volume = 0, smallest = 1e300, largest = 0;
      for (std::size_t e = 0; e < solid.element_count(); ++e) {
        volume += solid.element.reference_volume[e];
        smallest = std::min(smallest, solid.element.reference_volume[e]);
        largest = std::max(largest, solid.element.reference_volume[e]);
      }
      missing[i] = 1 - volume / (4.0 / 3 * std::numbers::pi * share);
      EXPECT_LT(largest, 6 * smallest);
      for (std::size_t n = 0; n < mesh.node_count(); ++n)
        EXPECT_LT(std::hypot(mesh.nodes[3 * n], mesh.nodes[3 * n + 1], mesh.nodes[3 * n + 2] - 5), 1 + 1e-12);
    }
    EXPECT_LT(missing[0], 0.04);
    EXPECT_NEAR(missing[1] / missing[0], 0.25, 0.08);  // chords of a sphere: second order
  }
}

TEST(BallMesh, HasNoGapBetweenItsBlocks) {
  const auto mesh = ball_mesh(1, 0.2, 0, {});
  std::map<std::array<std::int32_t, 4>, int> faces;
  constexpr int corners[6][4] = {{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  for (std::size_t e = 0; e < mesh.element_count(); ++e)
    for (const auto& face : corners) {
      std::array<std::int32_t, 4> key;
      for (std::size_t k = 0; k < 4; ++k) key[k] = mesh.elements[8 * e + static_cast<std::size_t>(face[k])];
      std::sort(key.begin(), key.end());
      ++faces[key];
    }
  for (const auto& [face, count] : faces) {
    ASSERT_LE(count, 2);
    if (count == 2) continue;
    for (const std::int32_t n : face) {  // a face of one element lies on the sphere
      const double* at = &mesh.nodes[3 * static_cast<std::size_t>(n)];
      EXPECT_NEAR(std::hypot(at[0], at[1], at[2]), 1, 1e-12);
    }
  }
}

TEST(BallOnARigidPlate, ExchangesMomentumToRoundingAndNoEnergy) {
  const double speed = 2;
  IceBody ball = make_ice(ball_options(0.004, speed));
  const double mass = mass_of(ball), first = 0.8 * stable_step(ball);
  RigidTarget target = make_rigid_target(ball, 0, 0.1, first);
  std::vector<double> node_loads, particle_loads;
  internal_forces(ball, 0);
  push_back(target, ball, node_loads, particle_loads);
  advance_velocities(ball, node_loads, particle_loads, 0, first);
  const double kinetic = account_of(ball).kinetic;
  for (double dt = first; ball.solid.time < 4e-4;) {
    advance_positions(ball, dt);
    internal_forces(ball, dt);
    const double next = std::min(0.8 * stable_step(ball), 1.1 * dt);
    push_back(target, ball, node_loads, particle_loads);
    advance_velocities(ball, node_loads, particle_loads, dt, next);
    book_impulse(target, 0.5 * (dt + next));
    dt = next;
  }
  const Account a = account_of(ball);
  const double rebound = momentum_of(ball)[2] / (mass * speed);
  std::printf(
      "rebound at %.3f of the speed, impulse over momentum %.4f, work of the plate %.1e of the kinetic energy\n",
      rebound, target.impulse / (mass * speed), (a.external_work + target.stored) / kinetic);
  EXPECT_EQ(target.force, 0);  // it has left
  EXPECT_NEAR(target.impulse, mass * speed + momentum_of(ball)[2], 1e-12 * mass * speed);
  // Springs are conservative but for the steps in which nodes come and go.
  EXPECT_NEAR(a.external_work, 0, 0.01 * kinetic);
  EXPECT_NEAR(a.balance(), kinetic, 1e-10 * kinetic);
  EXPECT_GT(rebound, 0.95);  // Hertz: an elastic ball keeps its energy but for waves and bulk viscosity
  EXPECT_LT(rebound, 1.0);
}

}  // namespace
}  // namespace polynya::ice
