#pragma once
#include "core/contact/vector3.hpp"

namespace polynya::contact {

/// Which part of a triangle a closest point lies on.
enum class Feature { face, edge01, edge12, edge20, vertex0, vertex1, vertex2 };

struct ClosestPoint {
  Vector3 weights{};  ///< barycentric coordinates of the closest point, sum 1
  Feature feature = Feature::face;
  double squared_distance = 0;  ///< m^2
};

/// Point of triangle (a, b, c) closest to p, by Voronoi regions (Ericson, Real-Time Collision Detection, 5.1.5).
ClosestPoint closest_point_on_triangle(const Vector3& p, const Vector3& a, const Vector3& b, const Vector3& c);

}  // namespace polynya::contact
