#pragma once
#include "core/contact/body.hpp"
#include "core/contact/closest_point.hpp"
#include "core/contact/surface_topology.hpp"

namespace polynya::contact {

/// How deep a point of some radius lies in a surface, by the foot of the point on one triangle.
struct Depth {
  double value = 0;     ///< m, positive in contact; continuous as the foot passes from feature to feature
  Vector3 push{};       ///< minus the gradient of the depth: the force on the point is k value push
  bool inside = false;  ///< the point itself is behind the surface, or beyond a rim and came there from behind it
  double beyond = 0;    ///< m, how far beyond a rim, in the plane of the face
};

/// Behind a face: radius + depth along its normal. At a smooth edge or vertex: radius -+ distance, the sign by
/// angle-weighted pseudo-normals (Baerentzen & Aanaes 2005, IEEE TVCG 11:243). Beyond a rim radius - distance, but
/// faded_depth for a point below the face that was behind it just before (`was_inside`).
Depth depth_at(const Body& surface, const SurfaceTopology& topology, std::array<bool, 2> mirror, std::size_t triangle,
               const ClosestPoint& foot, const Vector3& point, double radius, bool was_inside);

/// Where the foot is on a rim, the triangle there (across the edge, around the vertex) whose normal is nearest to the
/// direction of the point; the same triangle elsewhere. All of them have the same depth where the point is above.
std::size_t best_at_rim(const Body& surface, const SurfaceTopology& topology, std::size_t triangle,
                        const ClosestPoint& foot, const Vector3& point);

/// A point that came through a face leaves over its rim, now `beyond` it (m, in the plane) and `below` the plane (m):
/// radius + (below^2 - beyond^2)/distance, which has the value and the slope of the face at beyond = 0 and those of the
/// rim rounded by the radius at below = 0: force and depth fade continuously to the release at beyond = below (for
/// radius 0).
struct FadedDepth {
  double value = 0, push_out = 0, push_aside = 0;  ///< parts of the push along the face's normal and away from the rim
};
FadedDepth faded_depth(double below, double beyond, double radius);

/// Unit normal of a triangle; zero if it has no area.
Vector3 face_normal(const Body& surface, std::size_t triangle);

}  // namespace polynya::contact
