#include "core/contact/surface_topology.hpp"

#include <algorithm>
#include <cmath>

#include "core/contact/vector3.hpp"

namespace polynya::contact {
namespace {

constexpr double rim_cosine = 0.70710678118654757;     // 45 degrees
constexpr double sharp_cosine = 0.86602540378443865;   // 30 degrees
constexpr double turned_cosine = 0.99984769515639127;  // 1 degree

struct HalfEdge {
  std::uint64_t key;  // of both directions
  std::int32_t slot;  // 3 x triangle + edge
  bool forward;
};

std::vector<HalfEdge> sorted_half_edges(std::span<const std::int32_t> triangles) {
  std::vector<HalfEdge> edges(triangles.size());
  for (std::size_t slot = 0; slot < triangles.size(); ++slot) {
    const std::size_t t = slot / 3, e = slot % 3;
    const auto from = static_cast<std::uint64_t>(triangles[slot]);
    const auto to = static_cast<std::uint64_t>(triangles[3 * t + (e + 1) % 3]);
    edges[slot] = {std::min(from, to) << 32 | std::max(from, to), static_cast<std::int32_t>(slot), from < to};
  }
  std::sort(edges.begin(), edges.end(),
            [](const HalfEdge& a, const HalfEdge& b) { return a.key != b.key ? a.key < b.key : a.slot < b.slot; });
  return edges;
}

/// Where more than two faces meet in an edge, those that come first in the list belong together: faces of one element
/// are listed together.
void pair_faces(std::span<const std::int32_t> triangles, SurfaceTopology& topology) {
  topology.neighbour.assign(triangles.size() / 3, {-1, -1, -1});
  std::vector<HalfEdge> edges = sorted_half_edges(triangles);
  for (std::size_t a = 0; a < edges.size(); ++a) {
    auto& mine =
        topology.neighbour[static_cast<std::size_t>(edges[a].slot / 3)][static_cast<std::size_t>(edges[a].slot % 3)];
    if (mine >= 0) continue;
    for (std::size_t b = a + 1; b < edges.size() && edges[b].key == edges[a].key; ++b) {
      auto& other =
          topology.neighbour[static_cast<std::size_t>(edges[b].slot / 3)][static_cast<std::size_t>(edges[b].slot % 3)];
      if (other >= 0 || edges[b].forward == edges[a].forward) continue;
      mine = edges[b].slot / 3;
      other = edges[a].slot / 3;
      break;
    }
  }
}

Vector3 unit_normal(std::span<const std::int32_t> triangles, std::span<const double> positions, std::size_t t) {
  const Vector3 a = row(positions, triangles[3 * t]), b = row(positions, triangles[3 * t + 1]),
                c = row(positions, triangles[3 * t + 2]);
  const Vector3 n = cross(b - a, c - a);
  const double length = norm(n);
  return length > 0 ? (1 / length) * n : Vector3{0, 0, 0};
}

void classify_edges(std::span<const std::int32_t> triangles, std::span<const double> positions,
                    std::array<bool, 2> mirror, SurfaceTopology& topology) {
  topology.edge_kind.assign(triangles.size() / 3, {EdgeKind::smooth, EdgeKind::smooth, EdgeKind::smooth});
  topology.rim_vertex.assign(positions.size() / 3, 0);
  for (std::size_t t = 0; t < topology.neighbour.size(); ++t)
    for (std::size_t e = 0; e < 3; ++e) {
      const std::int32_t from = triangles[3 * t + e], to = triangles[3 * t + (e + 1) % 3];
      const std::int32_t other = topology.neighbour[t][e];
      EdgeKind& kind = topology.edge_kind[t][e];
      if (other < 0) {
        kind = EdgeKind::rim;
        for (std::size_t d = 0; d < 2; ++d)
          if (mirror[d] && positions[3 * static_cast<std::size_t>(from) + d] == 0.0 &&
              positions[3 * static_cast<std::size_t>(to) + d] == 0.0)
            kind = EdgeKind::mirror;
      } else {
        const auto o = static_cast<std::size_t>(other);
        const Vector3 mine = unit_normal(triangles, positions, t), theirs = unit_normal(triangles, positions, o);
        const Vector3 along =
            row(positions, static_cast<std::size_t>(to)) - row(positions, static_cast<std::size_t>(from));
        const bool convex = dot(cross(mine, theirs), along) > 0;
        const double cosine = dot(mine, theirs);
        if (convex && cosine < rim_cosine) kind = EdgeKind::rim;
        if (convex && cosine<turned_cosine&& static_cast<std::size_t>(other)> t)
          topology.convex_edges.push_back({{from, to}, {static_cast<std::int32_t>(t), other}, cosine < sharp_cosine});
      }
      if (kind == EdgeKind::rim)
        topology.rim_vertex[static_cast<std::size_t>(from)] = topology.rim_vertex[static_cast<std::size_t>(to)] = 1;
    }
}

std::vector<std::int32_t> number_patches(const SurfaceTopology& topology) {
  std::vector<std::int32_t> patch(topology.neighbour.size(), -1), open;
  std::int32_t count = 0;
  for (std::size_t first = 0; first < patch.size(); ++first) {
    if (patch[first] >= 0) continue;
    patch[first] = count;
    open.push_back(static_cast<std::int32_t>(first));
    while (!open.empty()) {
      const auto t = static_cast<std::size_t>(open.back());
      open.pop_back();
      for (std::size_t e = 0; e < 3; ++e) {
        const std::int32_t other = topology.neighbour[t][e];
        if (other < 0 || topology.edge_kind[t][e] == EdgeKind::rim || patch[static_cast<std::size_t>(other)] >= 0)
          continue;
        patch[static_cast<std::size_t>(other)] = count;
        open.push_back(other);
      }
    }
    ++count;
  }
  return patch;
}

void make_rings(std::span<const std::int32_t> triangles, SurfaceTopology& topology) {
  const std::vector<std::int32_t> patch = number_patches(topology);
  topology.ring_start.assign(1, 0);
  topology.ring.clear();
  for (std::size_t t = 0; t < patch.size(); ++t) {
    const auto begin = static_cast<std::ptrdiff_t>(topology.ring.size());
    for (std::size_t k = 0; k < 3; ++k) {
      const auto v = static_cast<std::size_t>(triangles[3 * t + k]);
      for (std::int32_t f = topology.fan_start[v]; f < topology.fan_start[v + 1]; ++f) {
        const std::int32_t other = topology.fan[static_cast<std::size_t>(f)];
        if (patch[static_cast<std::size_t>(other)] == patch[t]) topology.ring.push_back(other);
      }
    }
    std::sort(topology.ring.begin() + begin, topology.ring.end());
    topology.ring.erase(std::unique(topology.ring.begin() + begin, topology.ring.end()), topology.ring.end());
    topology.ring_start.push_back(static_cast<std::int32_t>(topology.ring.size()));
  }
}

}  // namespace

void make_fans(std::span<const std::int32_t> triangles, std::size_t vertices, std::vector<std::int32_t>& start,
               std::vector<std::int32_t>& fan) {
  start.assign(vertices + 1, 0);
  for (const std::int32_t v : triangles) ++start[static_cast<std::size_t>(v) + 1];
  for (std::size_t v = 0; v < vertices; ++v) start[v + 1] += start[v];
  fan.resize(triangles.size());
  std::vector<std::int32_t> next(start.begin(), start.end() - 1);
  for (std::size_t slot = 0; slot < triangles.size(); ++slot)
    fan[static_cast<std::size_t>(next[static_cast<std::size_t>(triangles[slot])]++)] =
        static_cast<std::int32_t>(slot / 3);
}

SurfaceTopology make_surface_topology(std::span<const std::int32_t> triangles, std::span<const double> positions,
                                      std::array<bool, 2> mirror) {
  SurfaceTopology topology;
  pair_faces(triangles, topology);
  make_fans(triangles, positions.size() / 3, topology.fan_start, topology.fan);
  classify_edges(triangles, positions, mirror, topology);
  make_rings(triangles, topology);
  return topology;
}

}  // namespace polynya::contact
