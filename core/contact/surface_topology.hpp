#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/compute/state_archive.hpp"

namespace polynya::contact {

/// How a surface goes on across an edge: `smooth` (the two faces belong to one patch), `mirror` (on a symmetry plane,
/// beyond which the mirror image goes on), `rim` (open, or convex and sharp: a patch ends here).
enum class EdgeKind : std::uint8_t { smooth, mirror, rim };

/// An edge along which an edge of another body may lie: convex, turned by more than a degree.
struct ConvexEdge {
  std::array<std::int32_t, 2> vertices{};
  std::array<std::int32_t, 2> faces{};  ///< the triangles on both sides
  bool sharp = false;
};

/// What the triangles of a surface know of each other. Patches are faces joined by edges that are neither open nor turn
/// outward by more than 45 degrees (when the topology was made).
struct SurfaceTopology {
  std::vector<std::array<std::int32_t, 3>> neighbour;  ///< [nt] face across edge 01, 12, 20; -1 at an open edge
  std::vector<std::array<EdgeKind, 3>> edge_kind;      ///< [nt]
  std::vector<std::int32_t> fan_start, fan;            ///< triangles around each vertex
  std::vector<std::uint8_t> rim_vertex;                ///< [nv] 1: a rim ends or passes here
  std::vector<std::int32_t> ring_start, ring;  ///< of each triangle: those of its patch that share a vertex, itself too
  std::vector<ConvexEdge> convex_edges;

  POLYNYA_STATE(neighbour, edge_kind, fan_start, fan, rim_vertex, ring_start, ring, convex_edges)
};

/// triangles [nt][3], positions [nv][3]; mirror: planes x = 0 and y = 0 are planes of symmetry.
SurfaceTopology make_surface_topology(std::span<const std::int32_t> triangles, std::span<const double> positions,
                                      std::array<bool, 2> mirror);

/// For each vertex the triangles that touch it, ascending.
void make_fans(std::span<const std::int32_t> triangles, std::size_t vertices, std::vector<std::int32_t>& start,
               std::vector<std::int32_t>& fan);

}  // namespace polynya::contact
