#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "structure_solver/build_vehicle.hpp"
#include "structure_solver/deformable_vehicle.hpp"
#include "tests/structure_solver/test_scene.hpp"

namespace polynya::structure {
namespace {

constexpr double pressure = 0.5e6;  // Pa, at the nose; falls to nothing at the tail

/// Outward areas of the hull's triangles times minus a pressure that varies along the axis, on their vertices.
std::vector<double> pressure_load(const BuiltVehicle& vehicle) {
  const std::vector<double>& nodes = vehicle.mesh.hexahedra.nodes;
  std::vector<double> load(3 * vehicle.mesh.hull_nodes.size(), 0.0);
  const auto& triangles = vehicle.mesh.hull_triangles;
  for (std::size_t t = 0; t < triangles.size(); t += 3) {
    std::array<std::array<double, 3>, 3> x;
    for (int i = 0; i < 3; ++i)
      for (int c = 0; c < 3; ++c) x[i][c] = nodes[3 * vehicle.mesh.hull_nodes[triangles[t + i]] + c];
    const double z = (x[0][2] + x[1][2] + x[2][2]) / 3, p = pressure * (1 + (z + 0.004) / 0.1);
    for (int c = 0; c < 3; ++c) {
      const int d = (c + 1) % 3, e = (c + 2) % 3;
      const double area = 0.5 * ((x[1][d] - x[0][d]) * (x[2][e] - x[0][e]) - (x[1][e] - x[0][e]) * (x[2][d] - x[0][d]));
      for (int i = 0; i < 3; ++i) load[3 * triangles[t + i] + c] -= p * area / 3;
    }
  }
  return load;
}

/// Largest deviation of a hull vertex' velocity from the rigid body's while a load acts on, and what the body gained.
struct Swing {
  double largest = 0, speed = 0, impulse = 0;
};
Swing swing_under(BuiltVehicle& vehicle, const std::vector<double>& load, int steps) {
  VehicleBody& body = *vehicle.body;
  const double dt = 0.5 * body.stable_step();
  body.internal_forces(0);
  body.finish_step(load, 0, dt);
  Swing swing;
  double force = 0;
  for (std::size_t i = 2; i < load.size(); i += 3) force += load[i];
  std::vector<double> x(load.size()), v(load.size());
  for (int n = 0; n < steps; ++n) {
    body.advance_positions(dt);
    body.internal_forces(dt);
    body.hull_motion(x, v);
    swing.speed = body.account().speed_z;
    for (std::size_t i = 0; i < v.size(); ++i)
      swing.largest = std::max(swing.largest, std::abs(v[i] - (i % 3 == 2 ? swing.speed : 0.0)));
    body.finish_step(load, dt, dt);
  }
  swing.impulse = (0.5 + steps) * dt * force;
  return swing;
}

TEST(Equilibrium, HullThatStartsUnderPressureDoesNotSwing) {
  const scene::Scene scene = vehicle_scene();
  BuiltVehicle sudden = build_vehicle(scene), settled = build_vehicle(scene);
  const std::vector<double> load = pressure_load(settled);
  std::vector<double> before(load.size()), after(load.size()), velocity(load.size());
  settled.body->hull_motion(before, velocity);
  settled.body->settle(load);
  settled.body->hull_motion(after, velocity);
  EXPECT_EQ(before, after);  // the shape of the scene is that under load
  const double free_swing = swing_under(sudden, load, 2000).largest, swing = swing_under(settled, load, 2000).largest;
  EXPECT_GT(free_swing, 0.05);  // of the order of p / (rho c)
  EXPECT_LT(swing, 1e-3 * free_swing);
}

TEST(Equilibrium, LoadsThatDoNotBalanceAccelerateTheBodyAsAWhole) {
  BuiltVehicle vehicle = build_vehicle(vehicle_scene());
  const std::vector<double> load = pressure_load(vehicle);
  vehicle.body->settle(load);
  const Account start = vehicle.body->account();
  const Swing swing = swing_under(vehicle, load, 400);
  ASSERT_GT(std::abs(swing.impulse), 1e-6);
  // What the start's damping takes is in the account.
  EXPECT_NEAR(vehicle.body->account().balance(), start.balance(), 1e-12 * start.kinetic);
  EXPECT_NEAR(vehicle.body->account().momentum[2] - start.momentum[2] -
                  (vehicle.body->account().gravity_impulse - start.gravity_impulse),
              swing.impulse, 1e-9 * std::abs(start.momentum[2]));
}

TEST(Equilibrium, StressOfARodUnderEndLoadIsThatOfTheInertiaBehindIt) {
  // A bar pushed at one end accelerates as a whole; its stress falls linearly to nothing at the other end.
  scene::Scene scene = solid_scene();
  scene.vehicle->head = "ogive";
  BuiltVehicle vehicle = build_vehicle(scene);
  const auto& deformable = dynamic_cast<const DeformableVehicle&>(*vehicle.body);
  const auto& nodes = vehicle.mesh.hexahedra.nodes;
  double tail = 0, sum = 0;
  for (const std::int32_t n : vehicle.mesh.hull_nodes) tail = std::min(tail, nodes[3 * n + 2]);
  std::vector<double> load(3 * vehicle.mesh.hull_nodes.size(), 0.0);
  for (std::size_t v = 0; v < vehicle.mesh.hull_nodes.size(); ++v)
    if (nodes[3 * vehicle.mesh.hull_nodes[v] + 2] < tail + 1e-9) sum += vehicle.node_masses[vehicle.mesh.hull_nodes[v]];
  const double force = 100;  // N, on the modelled quarter
  for (std::size_t v = 0; v < vehicle.mesh.hull_nodes.size(); ++v) {
    const std::int32_t n = vehicle.mesh.hull_nodes[v];
    if (nodes[3 * n + 2] < tail + 1e-9) load[3 * v + 2] = force * vehicle.node_masses[n] / sum;
  }
  vehicle.body->settle(load);
  // Mean axial stress of the elements that cross the middle of the cylinder, against the mass in front of them.
  const continuum::ExplicitSolid& solid = deformable.solid();
  const double station = tail + 0.05;
  double axial = 0, volume = 0, ahead = 0, total = 0;
  for (std::size_t e = 0; e < solid.element_count(); ++e) {
    const double z = continuum::element_centre(solid, e)[2];
    total += solid.element.mass[e];
    if (z > station) ahead += solid.element.mass[e];
    if (std::abs(z - station) > 2.1e-3) continue;
    axial += solid.element.stress[2][e] * solid.element.volume[e];
    volume += solid.element.volume[e];
  }
  const double area = std::numbers::pi * 0.005 * 0.005 / 4;
  EXPECT_NEAR(axial / volume / (-force * ahead / total / area), 1.0, 0.03);
}

}  // namespace
}  // namespace polynya::structure
