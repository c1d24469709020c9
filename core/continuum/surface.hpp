#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/continuum/hex_mesh.hpp"

namespace polynya::continuum {

/// The plane normal . x = offset; the normal has length 1.
struct Plane {
  std::array<double, 3> normal{};
  double offset = 0;  ///< m
};

/// [e][6]: the element behind each face, -1 where there is none. Faces in the order of element_faces.
using FaceNeighbours = std::vector<std::int32_t>;

/// The local nodes of the six faces of a hexahedron, each counter-clockwise seen from outside.
inline constexpr std::array<std::array<int, 4>, 6> element_faces{
    {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};

/// Outward oriented triangles of a boundary.
struct BoundarySurface {
  std::vector<std::int32_t> nodes;      ///< mesh nodes on the surface, ascending
  std::vector<std::int32_t> triangles;  ///< [t][3], indices into `nodes`, outward by the right-hand rule
  std::vector<std::int32_t> elements;   ///< [t], the element a triangle belongs to
};

/// Pairs of elements that share a face. Throws std::runtime_error if more than two elements share one.
FaceNeighbours face_neighbours(const HexMesh& mesh);

/// Faces with exactly one living element, except faces whose four reference nodes lie on one of the planes (within
/// 1e-6 of the face's size). alive: [e], nonzero = living. A face gives two triangles.
BoundarySurface boundary_surface(const HexMesh& mesh, const FaceNeighbours& neighbours, std::span<const double> alive,
                                 std::span<const Plane> excluded);

/// Faces with one element only whose four nodes are all among `nodes`, ascending: 6 x element + local face.
std::vector<std::int32_t> outer_faces_within(const HexMesh& mesh, const FaceNeighbours& neighbours,
                                             std::span<const std::int32_t> nodes);

/// Nodes of the face 6 x element + local face, counter-clockwise seen from outside.
std::array<std::int32_t, 4> nodes_of_face(const HexMesh& mesh, std::int32_t face);

/// Nodes whose reference position lies on the plane (within tolerance, m), ascending.
std::vector<std::int32_t> nodes_on_plane(const HexMesh& mesh, const Plane& plane, double tolerance);

}  // namespace polynya::continuum
