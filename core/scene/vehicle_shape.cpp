#include "core/scene/vehicle_shape.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace polynya::scene {
namespace {

/// Volume of revolution of max(hull radius - wall, 0) from the nose to `end`, by Simpson's rule in head and cylinder.
double revolved_volume(const Vehicle& vehicle, double wall, double end) {
  const auto area = [&](double s) {
    const double r = std::max(hull_radius(vehicle, s) - wall, 0.0);
    return std::numbers::pi * r * r;
  };
  constexpr int intervals = 2000;
  const double head = std::min(vehicle.head_length, end), h = head / intervals;
  double sum = area(0) + area(head);
  for (int i = 1; i < intervals; ++i) sum += (i % 2 ? 4 : 2) * area(i * h);
  return sum * h / 3 + area(vehicle.head_length) * std::max(end - vehicle.head_length, 0.0);
}

}  // namespace

double hull_radius(const Vehicle& vehicle, double s) {
  const double radius = 0.5 * vehicle.diameter, head = vehicle.head_length;
  if (vehicle.surface) return s < 0 ? 0 : radius;
  if (s <= 0) return 0;
  if (s >= head) return radius;
  const double ahead = head - s;
  if (vehicle.head == "ogive") {
    const double arc = (radius * radius + head * head) / (2 * radius);
    return std::sqrt(arc * arc - ahead * ahead) + radius - arc;
  }
  return radius * std::sqrt(1 - (ahead / head) * (ahead / head));
}

double highest_above_nose(const Vehicle& vehicle) {
  constexpr int steps = 1000;
  double highest = 0;
  for (int i = 0; i <= steps; ++i) {
    const double s = vehicle.length * i / steps;
    highest =
        std::max(highest, hull_radius(vehicle, s) * std::abs(std::sin(vehicle.angle)) - s * std::cos(vehicle.angle));
  }
  return highest;
}

double lowest_below_nose(const Vehicle& vehicle) {
  return vehicle.length * std::cos(vehicle.angle) + 0.5 * vehicle.diameter * std::abs(std::sin(vehicle.angle));
}

double thickest_wall(const Vehicle& vehicle) {
  const double radius = 0.5 * vehicle.diameter, head = vehicle.head_length;
  if (vehicle.head == "ogive") return 0.9 * radius;
  return 0.9 * std::min({radius, radius * radius / head, head * head / radius});
}

double hull_volume(const Vehicle& vehicle) {
  return revolved_volume(vehicle, 0, vehicle.length);
}

double shell_volume(const Vehicle& vehicle, double wall) {
  return hull_volume(vehicle) - revolved_volume(vehicle, wall, std::max(vehicle.length - wall, 0.0));
}

double wall_from_mass(const Vehicle& vehicle, double density) {
  double thin = 0, thick = 0.5 * vehicle.diameter;
  if (density * hull_volume(vehicle) < vehicle.mass) return 0;
  for (int i = 0; i < 60; ++i) {
    const double wall = 0.5 * (thin + thick);
    (density * shell_volume(vehicle, wall) < vehicle.mass ? thin : thick) = wall;
  }
  return 0.5 * (thin + thick);
}

}  // namespace polynya::scene
