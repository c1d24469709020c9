#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "structure_solver/build_vehicle.hpp"
#include "structure_solver/deformable_vehicle.hpp"
#include "structure_solver/rigid_vehicle.hpp"
#include "tests/structure_solver/test_scene.hpp"

namespace polynya::structure {
namespace {

/// Force on the hull's vertices near the nose at a time; shares are of the modelled part.
struct Pulse {
  double force = 0, duration = 0;  // N of the whole body, s
  std::array<double, 3> direction = {0, 0, -1};
  double depth = 4e-3;  // m, loaded part of the nose
  double at(double time) const {
    return time < duration ? force * std::pow(std::sin(std::numbers::pi * time / duration), 2) : 0;
  }
};

/// Weights of the hull's vertices (sum 1 over the whole body): their masses within the loaded depth.
std::vector<double> nose_weights(const BuiltVehicle& vehicle, double depth, int portions) {
  std::vector<double> weights;
  double sum = 0;
  for (const std::int32_t node : vehicle.mesh.hull_nodes) {
    const bool loaded = vehicle.mesh.hexahedra.nodes[3 * node + 2] >= -0.004 - depth;
    weights.push_back(loaded ? vehicle.node_masses[node] : 0.0);
    sum += weights.back();
  }
  for (double& weight : weights) weight /= sum * portions;
  return weights;
}

struct Flight {
  double impulse = 0;  // N s, of the modelled part
  Account start, end;
  std::vector<double> head_stress;
  double nose = 0;  // m
};

Flight fly(BuiltVehicle& vehicle, const Pulse& pulse, double dt, int steps, int portions) {
  VehicleBody& body = *vehicle.body;
  const std::vector<double> weights = nose_weights(vehicle, pulse.depth, portions);
  std::vector<double> load(3 * body.hull_vertices());
  Flight flight;
  flight.start = body.account();
  body.internal_forces(0);
  body.finish_step({}, 0, dt);
  for (int n = 1; n <= steps; ++n) {
    body.advance_positions(dt);
    body.internal_forces(dt);
    const double force = pulse.at(n * dt);
    for (std::size_t v = 0; v < weights.size(); ++v)
      for (int c = 0; c < 3; ++c) load[3 * v + c] = force * weights[v] * pulse.direction[c];
    body.finish_step(load, dt, dt);
    flight.impulse += dt * force / portions;
    flight.head_stress.push_back(body.account().head_stress);
  }
  flight.end = body.account();
  std::vector<double> positions(3 * body.hull_vertices()), velocities(positions.size());
  body.hull_motion(positions, velocities);
  flight.nose = -1e300;
  for (std::size_t v = 0; v < body.hull_vertices(); ++v) flight.nose = std::max(flight.nose, positions[3 * v + 2]);
  return flight;
}

TEST(VehicleMotion, FreeFlightKeepsSpeedEnergyAndShape) {
  for (const bool deformable : {true, false})
    for (const char* interior : {"hollow", "solid"}) {
      scene::Scene scene = vehicle_scene();
      scene.vehicle->deformable = deformable;
      scene.vehicle->interior = interior;
      if (scene.vehicle->interior == "solid") scene.vehicle->mass = 0;
      BuiltVehicle vehicle = build_vehicle(scene);
      const double dt = std::min(5e-8, 0.9 * vehicle.body->stable_step());
      const Flight flight = fly(vehicle, {}, dt, 2000, 4);
      EXPECT_NEAR(flight.end.speed_z / 40, 1, 1e-12);
      EXPECT_NEAR(flight.end.kinetic / flight.start.kinetic, 1, 1e-12);
      EXPECT_NEAR(flight.nose, -0.004 + 40 * 2001 * dt - 40 * dt, 1e-14);
      EXPECT_LT(flight.end.head_stress, 1) << "Pa, from rounding of the positions";
      EXPECT_LT(std::abs(flight.end.internal), 1e-15 + 1e-12 * flight.end.kinetic);
    }
}

TEST(VehicleMotion, FallsFreely) {
  for (const bool deformable : {true, false}) {
    scene::Scene scene = vehicle_scene();
    scene.run.gravity = 9.81;
    scene.vehicle->deformable = deformable;
    BuiltVehicle vehicle = build_vehicle(scene);
    const double dt = 5e-8;
    const Flight flight = fly(vehicle, {}, dt, 2000, 4);
    const double time = 2000 * dt, rise = flight.end.centre_of_mass_z - flight.start.centre_of_mass_z;
    EXPECT_NEAR(rise, 40 * time - 0.5 * 9.81 * time * time, 1e-14);
    EXPECT_NEAR(flight.end.gravity_work, -9.81 * flight.end.mass * rise, 1e-15);
    EXPECT_NEAR(flight.end.balance(), flight.start.balance(), 1e-12 * flight.start.kinetic);
    EXPECT_NEAR(flight.end.external_work, 0, 1e-12 * flight.start.kinetic);
  }
}

TEST(VehicleMotion, StruckAtTheNoseItGainsTheImpulseAndItsEnergyBalances) {
  for (const bool deformable : {true, false})
    for (const scene::Symmetry symmetry : {scene::Symmetry::half, scene::Symmetry::full}) {
      scene::Scene scene = vehicle_scene();
      scene.symmetry = symmetry;
      scene.vehicle->deformable = deformable;
      BuiltVehicle vehicle = build_vehicle(scene);
      const Pulse pulse{400, 30e-6, {0.6, 0, -0.8}};
      const Flight flight = fly(vehicle, pulse, 5e-8, 1000, symmetry == scene::Symmetry::half ? 2 : 1);
      EXPECT_NEAR(flight.end.momentum[0] - flight.start.momentum[0], 0.6 * flight.impulse, 1e-12 * flight.impulse);
      EXPECT_NEAR(flight.end.momentum[2] - flight.start.momentum[2], -0.8 * flight.impulse, 1e-11 * flight.impulse);
      if (symmetry == scene::Symmetry::full) {
        EXPECT_NEAR(flight.end.momentum[1], 0, 1e-11 * flight.impulse);
      }
      const double exchanged = std::abs(flight.end.external_work);
      EXPECT_GT(exchanged, 0.05);
      // Elastic: to rounding. Rigid: the torque's work has an error of second order in the step.
      EXPECT_NEAR(flight.end.balance(), flight.start.balance(), (deformable ? 1e-9 : 1e-6) * exchanged);
    }
}

TEST(VehicleMotion, RigidAndElasticAgreeUnderASlowLoad) {
  const Pulse slow{20, 400e-6};
  std::array<Flight, 2> flights;
  for (const bool deformable : {true, false}) {
    scene::Scene scene = vehicle_scene();
    scene.vehicle->deformable = deformable;
    BuiltVehicle vehicle = build_vehicle(scene);
    flights[deformable] = fly(vehicle, slow, 6e-8, 7000, 4);
  }
  EXPECT_NEAR(flights[0].end.centre_of_mass_z, flights[1].end.centre_of_mass_z, 1e-13);
  EXPECT_NEAR(flights[0].end.speed_z, flights[1].end.speed_z, 1e-10);
  // 20 N shorten the hull by about F L / (E A) = 1.5 um at most, and it is unloaded at the end.
  EXPECT_NEAR(flights[0].nose, flights[1].nose, 0.3e-6);
}

TEST(VehicleMotion, QuarterEqualsHalfEqualsFull) {
  for (const char* interior : {"hollow", "solid"}) {
    std::array<Flight, 3> flights;
    const scene::Symmetry symmetries[] = {scene::Symmetry::quarter, scene::Symmetry::half, scene::Symmetry::full};
    const int portions[] = {4, 2, 1};
    for (int s = 0; s < 3; ++s) {
      scene::Scene scene = vehicle_scene();
      scene.symmetry = symmetries[s];
      scene.vehicle->interior = interior;
      if (scene.vehicle->interior == "solid") scene.vehicle->mass = 0;
      BuiltVehicle vehicle = build_vehicle(scene);
      flights[s] = fly(vehicle, {500, 20e-6}, 5e-8, 800, portions[s]);
    }
    for (int s = 1; s < 3; ++s) {
      const double ratio = portions[0] / portions[s];
      EXPECT_NEAR(flights[s].end.kinetic / flights[0].end.kinetic, ratio, 1e-10);
      EXPECT_NEAR(flights[s].end.internal / flights[0].end.internal, ratio, 1e-6);
      EXPECT_NEAR(flights[s].nose, flights[0].nose, 1e-12);
      for (std::size_t n = 100; n < 800; n += 100)
        EXPECT_NEAR(flights[s].head_stress[n] / flights[0].head_stress[n], 1, 1e-6) << interior << " step " << n;
    }
  }
}

TEST(VehicleMotion, SpinningRigidHullMovesWithTheVelocitiesItReports) {
  scene::Scene scene = vehicle_scene();
  scene.symmetry = scene::Symmetry::full;
  scene.vehicle->deformable = false;
  BuiltVehicle vehicle = build_vehicle(scene);
  auto& body = dynamic_cast<RigidVehicle&>(*vehicle.body);
  body.set_spin({30, 200, 50});
  const std::size_t n = body.hull_vertices();
  std::vector<double> before(3 * n), after(3 * n), velocities(3 * n);
  const double energy = body.account().kinetic, dt = 1e-6;
  body.finish_step({}, 0, dt);
  for (int step = 0; step < 100; ++step) {
    body.hull_motion(before, velocities);
    body.advance_positions(dt);
    body.hull_motion(after, velocities);
    for (std::size_t i = 0; i < 3 * n; ++i) ASSERT_NEAR(after[i], before[i] + dt * velocities[i], 1e-15);
    body.finish_step({}, dt, dt);
  }
  EXPECT_NEAR(body.account().kinetic / energy, 1, 1e-12);
}

}  // namespace
}  // namespace polynya::structure
