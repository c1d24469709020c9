#pragma once
#include "core/contact/vector3.hpp"

namespace polynya::contact {

/// Where two straight lines a0 + s (a1 - a0) and b0 + t (b1 - b0) come closest.
struct ClosestOnLines {
  double s = 0, t = 0;
  Vector3 apart{};        ///< from the place on a to that on b
  Vector3 normal{};       ///< unit vector perpendicular to both
  bool crossing = false;  ///< false: nearly parallel (sine below 0.05), nothing else is set
};

inline ClosestOnLines closest_on_lines(const Vector3& a0, const Vector3& a1, const Vector3& b0, const Vector3& b1) {
  const Vector3 u = a1 - a0, w = b1 - b0, between = b0 - a0, n = cross(u, w);
  const double uu = dot(u, u), ww = dot(w, w), nn = dot(n, n);
  ClosestOnLines closest;
  if (!(nn > 0.0025 * uu * ww)) return closest;
  closest.crossing = true;
  closest.s = dot(cross(between, w), n) / nn;
  closest.t = dot(cross(between, u), n) / nn;
  closest.apart = between + closest.t * w - closest.s * u;
  closest.normal = (1 / std::sqrt(nn)) * n;
  return closest;
}

}  // namespace polynya::contact
