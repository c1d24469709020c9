#pragma once
#include <array>

#include "core/scene/scene.hpp"
#include "geometry/hull/triangle_soup.hpp"

/// Bodies whose motion a scene prescribes: their surfaces, and where these are at any time.
namespace polynya::scene {

using Vector = std::array<double, 3>;

/// Where a body is: its reference point, m, and how far it has turned about it since the start, rad.
struct Pose {
  Vector position{};
  double turned = 0;
};

/// Exact: the integrals of tables that are linear between their entries and keep the last value.
Pose pose_at(const Body& body, double time);
/// Velocity of the reference point, m/s, and rate of turning, rad/s.
Vector velocity_at(const Body& body, double time);
double rotation_at(const Body& body, double time);

/// The surface of the body about its reference point, turned by its angles, before it moves. Round bodies have
/// triangles of about `edge` (m). A file's is read again: GeometryError as of its first reading.
geometry::TriangleSoup body_surface(const Body& body, double edge);

/// A point of that surface when the body has this pose.
Vector placed(const Body& body, const Pose& pose, const Vector& point);

/// Whether the model shows one of the mirror images of a body that lies across the plane normal to this axis (0: x,
/// 1: y).
bool mirrored(const Scene& scene, const Body& body, int axis);

}  // namespace polynya::scene
