#include <algorithm>
#include <cmath>
#include <numbers>

#include "bench/kernels.hpp"
#include "core/contact/penalty_contact.hpp"

namespace polynya::bench {
namespace {

constexpr int rings = 40, sectors = 50;  // 2,000 vertices of the hull
constexpr int per_side = 100;            // 20,000 points around it, in two layers

struct Points {
  std::vector<double> positions, velocities, masses, radii;
  std::vector<std::int64_t> ids;
  std::vector<std::int32_t> triangles;

  void add(double x, double y, double z, double speed, double mass, double radius) {
    for (const double c : {x, y, z}) positions.push_back(c);
    for (const double c : {0.0, 0.0, speed}) velocities.push_back(c);
    masses.push_back(mass);
    radii.push_back(radius);
    ids.push_back(static_cast<std::int64_t>(ids.size()));
  }
  contact::Body body() const { return {positions, velocities, masses, radii, ids, triangles}; }
};

/// A hull of 10 mm diameter and 50 mm length that rises at 40 m/s.
Points hull() {
  Points points;
  for (int k = 0; k < rings; ++k)
    for (int s = 0; s < sectors; ++s) {
      const double z = 0.05 * k / (rings - 1), angle = 2 * std::numbers::pi * s / sectors;
      const double radius = 0.005 * std::min(1.0, 0.1 + std::sqrt(std::max(0.0, (0.05 - z) / 0.01)));
      points.add(radius * std::cos(angle), radius * std::sin(angle), z - 0.045, 40, 1e-6, 0);
    }
  for (std::int32_t k = 0; k + 1 < rings; ++k)
    for (std::int32_t s = 0; s < sectors; ++s) {
      const std::int32_t a = sectors * k + s, b = sectors * k + (s + 1) % sectors, c = b + sectors, d = a + sectors;
      points.triangles.insert(points.triangles.end(), {a, b, c, a, c, d});
    }
  return points;
}

/// Loose points 1 mm apart in two layers, 100 mm x 100 mm, through which the hull passes.
Points layers() {
  Points points;
  for (int l = 0; l < 2; ++l)
    for (int j = 0; j < per_side; ++j)
      for (int i = 0; i < per_side; ++i)
        points.add(1e-3 * (i - per_side / 2 + 0.31), 1e-3 * (j - per_side / 2 + 0.17), 1e-3 * l, 0, 9e-7, 0.5e-3);
  return points;
}

}  // namespace

/// 2,000 vertices of a hull against 20,000 points: one evaluation while the hull moves by 2 um, searches included, us.
std::vector<Figure> contact_evaluate() {
  Points vehicle = hull(), ice = layers();
  constexpr double dt = 5e-8;
  contact::PenaltyContact contact({.friction = 0.1, .stiffness_factor = 0.1, .depth_limit = 0.5e-3, .skin = 0.25e-3});
  contact.set_topology(vehicle.body(), ice.body());
  constexpr int steps = 200;
  const double seconds = shortest_time(10, [&] {
    for (int n = 0; n < steps; ++n) {
      for (std::size_t k = 2; k < vehicle.positions.size(); k += 3) vehicle.positions[k] += dt * vehicle.velocities[k];
      contact.evaluate(vehicle.body(), ice.body(), dt);
    }
  });
  return {{"contact.evaluate_us", 1e6 * seconds / steps}};
}

}  // namespace polynya::bench
