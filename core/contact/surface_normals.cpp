#include "core/contact/surface_normals.hpp"

#include <algorithm>
#include <map>

namespace polynya::contact {

SurfaceNormals make_surface_normals(std::span<const std::int32_t> triangles, std::size_t vertices) {
  SurfaceNormals normals;
  const std::size_t count = triangles.size() / 3;
  normals.face.resize(count);
  normals.vertex.resize(vertices);
  normals.neighbour.assign(count, {-1, -1, -1});
  std::map<std::pair<std::int32_t, std::int32_t>, std::pair<std::size_t, int>> open_edges;
  for (std::size_t t = 0; t < count; ++t) {
    for (int e = 0; e < 3; ++e) {
      const std::int32_t from = triangles[3 * t + e], to = triangles[3 * t + (e + 1) % 3];
      const auto opposite = open_edges.find({to, from});
      if (opposite == open_edges.end()) {
        open_edges[{from, to}] = {t, e};
        continue;
      }
      const auto [other, other_edge] = opposite->second;
      normals.neighbour[t][e] = static_cast<std::int32_t>(other);
      normals.neighbour[other][other_edge] = static_cast<std::int32_t>(t);
      open_edges.erase(opposite);
    }
  }
  return normals;
}

void update_surface_normals(SurfaceNormals& normals, std::span<const double> positions,
                            std::span<const std::int32_t> triangles, std::array<bool, 2> mirror) {
  std::fill(normals.vertex.begin(), normals.vertex.end(), Vector3{0, 0, 0});
  for (std::size_t t = 0; t < normals.face.size(); ++t) {
    const Vector3 x[3] = {row(positions, triangles[3 * t]), row(positions, triangles[3 * t + 1]),
                          row(positions, triangles[3 * t + 2])};
    const Vector3 n = cross(x[1] - x[0], x[2] - x[0]);
    const double length = norm(n);
    normals.face[t] = length > 0 ? (1 / length) * n : Vector3{0, 0, 0};
    for (int v = 0; v < 3; ++v) {
      const Vector3 a = x[(v + 1) % 3] - x[v], b = x[(v + 2) % 3] - x[v];
      const double angle = std::atan2(norm(cross(a, b)), dot(a, b));
      Vector3& sum = normals.vertex[triangles[3 * t + v]];
      sum = sum + angle * normals.face[t];
    }
  }
  for (std::size_t v = 0; v < normals.vertex.size(); ++v) {
    for (int d = 0; d < 2; ++d) {
      if (mirror[d] && positions[3 * v + d] == 0.0) normals.vertex[v][d] = 0;
    }
  }
}

Vector3 pseudo_normal(const SurfaceNormals& normals, std::span<const std::int32_t> triangles, std::size_t t,
                      Feature feature) {
  const auto with_neighbour = [&](int edge) {
    const std::int32_t other = normals.neighbour[t][edge];
    return other < 0 ? normals.face[t] : normals.face[t] + normals.face[other];
  };
  switch (feature) {
    case Feature::face: return normals.face[t];
    case Feature::edge01: return with_neighbour(0);
    case Feature::edge12: return with_neighbour(1);
    case Feature::edge20: return with_neighbour(2);
    case Feature::vertex0: return normals.vertex[triangles[3 * t]];
    case Feature::vertex1: return normals.vertex[triangles[3 * t + 1]];
    case Feature::vertex2: return normals.vertex[triangles[3 * t + 2]];
  }
  return normals.face[t];
}

}  // namespace polynya::contact
