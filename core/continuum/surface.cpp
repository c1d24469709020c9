#include "core/continuum/surface.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace polynya::continuum {
namespace {

struct Face {
  std::array<std::int32_t, 4> sorted;
  std::int32_t slot;  // 6 x element + local face
};

std::array<std::int32_t, 4> face_nodes(const HexMesh& mesh, std::size_t element, std::size_t face) {
  std::array<std::int32_t, 4> nodes;
  for (std::size_t k = 0; k < 4; ++k) nodes[k] = mesh.elements[8 * element + element_faces[face][k]];
  return nodes;
}

bool lies_on(const HexMesh& mesh, const std::array<std::int32_t, 4>& nodes, const Plane& plane) {
  double size = 0;
  for (int i = 0; i < 3; ++i) size += std::pow(mesh.nodes[3 * nodes[2] + i] - mesh.nodes[3 * nodes[0] + i], 2);
  const double tolerance = 1e-6 * std::sqrt(size);
  return std::all_of(nodes.begin(), nodes.end(), [&](std::int32_t n) {
    double distance = -plane.offset;
    for (int i = 0; i < 3; ++i) distance += plane.normal[i] * mesh.nodes[3 * n + i];
    return std::abs(distance) < tolerance;
  });
}

}  // namespace

FaceNeighbours face_neighbours(const HexMesh& mesh) {
  std::vector<Face> faces;
  faces.reserve(6 * mesh.element_count());
  for (std::size_t e = 0; e < mesh.element_count(); ++e)
    for (std::size_t f = 0; f < 6; ++f) {
      auto nodes = face_nodes(mesh, e, f);
      std::sort(nodes.begin(), nodes.end());
      faces.push_back({nodes, static_cast<std::int32_t>(6 * e + f)});
    }
  std::sort(faces.begin(), faces.end(),
            [](const Face& a, const Face& b) { return a.sorted != b.sorted ? a.sorted < b.sorted : a.slot < b.slot; });
  FaceNeighbours neighbours(6 * mesh.element_count(), -1);
  for (std::size_t k = 0; k + 1 < faces.size(); ++k) {
    if (faces[k].sorted != faces[k + 1].sorted) continue;
    if (k + 2 < faces.size() && faces[k + 2].sorted == faces[k].sorted)
      throw std::runtime_error("more than two elements share a face, among them element " +
                               std::to_string(faces[k].slot / 6));
    neighbours[faces[k].slot] = faces[k + 1].slot / 6;
    neighbours[faces[k + 1].slot] = faces[k].slot / 6;
  }
  return neighbours;
}

std::array<std::int32_t, 4> nodes_of_face(const HexMesh& mesh, std::int32_t face) {
  return face_nodes(mesh, static_cast<std::size_t>(face / 6), static_cast<std::size_t>(face % 6));
}

std::vector<std::int32_t> outer_faces_within(const HexMesh& mesh, const FaceNeighbours& neighbours,
                                             std::span<const std::int32_t> nodes) {
  std::vector<std::uint8_t> chosen(mesh.node_count(), 0);
  for (const std::int32_t n : nodes) chosen[static_cast<std::size_t>(n)] = 1;
  std::vector<std::int32_t> faces;
  for (std::int32_t face = 0; face < static_cast<std::int32_t>(neighbours.size()); ++face) {
    if (neighbours[static_cast<std::size_t>(face)] >= 0) continue;
    const auto corners = nodes_of_face(mesh, face);
    if (std::all_of(corners.begin(), corners.end(),
                    [&](std::int32_t n) { return chosen[static_cast<std::size_t>(n)]; }))
      faces.push_back(face);
  }
  return faces;
}

BoundarySurface boundary_surface(const HexMesh& mesh, const FaceNeighbours& neighbours, std::span<const double> alive,
                                 std::span<const Plane> excluded) {
  BoundarySurface surface;
  for (std::size_t e = 0; e < mesh.element_count(); ++e) {
    if (alive[e] == 0) continue;
    for (std::size_t f = 0; f < 6; ++f) {
      const std::int32_t behind = neighbours[6 * e + f];
      if (behind >= 0 && alive[behind] != 0) continue;
      const auto nodes = face_nodes(mesh, e, f);
      const auto hidden = [&](const Plane& plane) { return lies_on(mesh, nodes, plane); };
      if (behind < 0 && std::any_of(excluded.begin(), excluded.end(), hidden)) continue;
      for (const auto& corner : {std::array{0, 1, 2}, std::array{0, 2, 3}}) {
        for (int k : corner) surface.triangles.push_back(nodes[k]);
        surface.elements.push_back(static_cast<std::int32_t>(e));
      }
    }
  }
  surface.nodes = surface.triangles;
  std::sort(surface.nodes.begin(), surface.nodes.end());
  surface.nodes.erase(std::unique(surface.nodes.begin(), surface.nodes.end()), surface.nodes.end());
  std::vector<std::int32_t> local(mesh.node_count(), -1);
  for (std::size_t k = 0; k < surface.nodes.size(); ++k) local[surface.nodes[k]] = static_cast<std::int32_t>(k);
  for (std::int32_t& node : surface.triangles) node = local[node];
  return surface;
}

std::vector<std::int32_t> nodes_on_plane(const HexMesh& mesh, const Plane& plane, double tolerance) {
  std::vector<std::int32_t> found;
  for (std::size_t n = 0; n < mesh.node_count(); ++n) {
    double distance = -plane.offset;
    for (std::size_t i = 0; i < 3; ++i) distance += plane.normal[i] * mesh.nodes[3 * n + i];
    if (std::abs(distance) <= tolerance) found.push_back(static_cast<std::int32_t>(n));
  }
  return found;
}

}  // namespace polynya::continuum
