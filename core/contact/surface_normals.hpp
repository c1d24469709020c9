#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/contact/closest_point.hpp"

namespace polynya::contact {

/// Normals of a triangulated surface that give the sign of the distance to it whichever feature is closest: unit
/// normals of faces, angle-weighted pseudo-normals of vertices, sums of face normals on edges
/// (Baerentzen & Aanaes 2005, IEEE TVCG 11:243).
struct SurfaceNormals {
  std::vector<Vector3> face;
  std::vector<Vector3> vertex;  ///< not normalised
  std::vector<std::array<std::int32_t, 3>> neighbour;  ///< face across edge 01, 12, 20; -1 at an open edge
};

/// Topology part: neighbours across edges. triangles [nt][3].
SurfaceNormals make_surface_normals(std::span<const std::int32_t> triangles, std::size_t vertices);

/// Geometry part for new positions [nv][3]. `mirror` tells which coordinate planes (x = 0, y = 0) mirror the surface:
/// vertices on them get no normal component across.
void update_surface_normals(SurfaceNormals& normals, std::span<const double> positions,
                            std::span<const std::int32_t> triangles, std::array<bool, 2> mirror);

/// Outward normal (not normalised) at a feature of triangle t.
Vector3 pseudo_normal(const SurfaceNormals& normals, std::span<const std::int32_t> triangles, std::size_t t,
                      Feature feature);

}  // namespace polynya::contact
