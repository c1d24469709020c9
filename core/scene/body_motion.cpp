#include "core/scene/body_motion.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "geometry/hull/import_hull.hpp"
#include "geometry/hull/simple_bodies.hpp"

namespace polynya::scene {
namespace {

/// Entry `column` of a table [times][width] at a time, and the integral of it from 0 on.
struct Sample {
  double value = 0, integral = 0;
};
Sample look_up(const std::vector<double>& times, const std::vector<double>& values, std::size_t width,
               std::size_t column, double time) {
  const auto value = [&](std::size_t n) { return values[n * width + column]; };
  Sample found{value(0), 0};
  for (std::size_t n = 0; n < times.size(); ++n) {
    const bool last = n + 1 == times.size();
    const double part = std::min(time, last ? time : times[n + 1]) - times[n];
    if (part < 0) break;
    const double slope = last ? 0 : (value(n + 1) - value(n)) / (times[n + 1] - times[n]);
    found.value = value(n) + slope * part;
    found.integral += part * (value(n) + 0.5 * slope * part);
  }
  return found;
}

/// Right-handed about an axis (0: x, 1: y, 2: z).
Vector turn(const Vector& p, int axis, double angle) {
  const std::size_t u = static_cast<std::size_t>(axis + 1) % 3, w = static_cast<std::size_t>(axis + 2) % 3;
  const double c = std::cos(angle), s = std::sin(angle);
  Vector q = p;
  q[u] = c * p[u] - s * p[w];
  q[w] = s * p[u] + c * p[w];
  return q;
}

geometry::TriangleSoup shape_of(const Body& body, double edge) {
  if (body.shape == "sphere") return geometry::sphere_surface(body.diameter, edge);
  if (body.shape == "cylinder") return geometry::cylinder_surface(body.diameter, body.height, edge);
  if (body.shape == "box") return geometry::box_surface(body.length, body.width, body.height);
  if (body.shape == "wedge") return geometry::wedge_surface(body.length, body.width, body.height);
  return geometry::import_body(body.file, body.unit);
}

}  // namespace

Vector velocity_at(const Body& body, double time) {
  Vector velocity;
  for (std::size_t d = 0; d < 3; ++d) velocity[d] = look_up(body.times, body.velocity, 3, d, time).value;
  return velocity;
}

double rotation_at(const Body& body, double time) {
  return look_up(body.rotation_times, body.rotation_rate, 1, 0, time).value;
}

Pose pose_at(const Body& body, double time) {
  Pose pose;
  for (std::size_t d = 0; d < 3; ++d)
    pose.position[d] = body.position[d] + look_up(body.times, body.velocity, 3, d, time).integral;
  pose.turned = look_up(body.rotation_times, body.rotation_rate, 1, 0, time).integral;
  return pose;
}

geometry::TriangleSoup body_surface(const Body& body, double edge) {
  geometry::TriangleSoup surface = shape_of(body, edge);
  for (geometry::Point& p : surface.points)
    for (int axis = 0; axis < 3; ++axis)
      if (const double angle = body.angles[static_cast<std::size_t>(axis)]; angle != 0) p = turn(p, axis, angle);
  return surface;
}

Vector placed(const Body& body, const Pose& pose, const Vector& point) {
  Vector p = pose.turned == 0 ? point : turn(point, body.rotation_axis[0] - 'x', pose.turned);
  for (std::size_t d = 0; d < 3; ++d) p[d] += pose.position[d];
  return p;
}

bool mirrored(const Scene& scene, const Body& body, int axis) {
  const bool plane = axis == 0 ? scene.symmetry == Symmetry::quarter : axis == 1 && scene.symmetry != Symmetry::full;
  return plane && body.low[static_cast<std::size_t>(axis)] < 0;
}

}  // namespace polynya::scene
