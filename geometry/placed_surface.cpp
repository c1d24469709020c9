#include "geometry/placed_surface.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/compute/parallel.hpp"

namespace polynya::geometry {
namespace {

// In cells. The first is above the rounding of coordinates and far below the promised accuracy.
constexpr double plane_tolerance = 1e-12;
constexpr double wall_tolerance = 1e-9;
constexpr double wall_reach = 0.5;  // how far a body may shrink from the wall it is cut off at
constexpr double facing = 0.9;      // least cosine between the normals of a wall and a side that rests on it
constexpr std::size_t vertex_chunk = 4096;

double wall_cell(const LineLocator& lines, bool last) {
  const std::int32_t n = lines.intervals();
  return last ? lines.line(n) - lines.line(n - 1) : lines.line(1) - lines.line(0);
}

void put_on_wall(Corner& corner, std::size_t axis, const LineLocator& lines, bool last) {
  corner.x[axis] = last ? lines.lines().back() : lines.lines().front();
  corner.slab[axis] = last ? lines.intervals() : -1;
}

/// A triangle that faces a wall within reach.
bool rests_on_wall(const std::array<const Corner*, 3>& corners, std::size_t axis, const LineLocator& lines, bool last) {
  const double wall = last ? lines.lines().back() : lines.lines().front(), reach = wall_reach * wall_cell(lines, last);
  for (const Corner* corner : corners)
    if (std::abs(corner->x[axis] - wall) >= reach) return false;
  const auto &a = corners[0]->x, &b = corners[1]->x, &c = corners[2]->x;
  std::array<double, 3> normal;
  for (std::size_t d = 0; d < 3; ++d) {
    const std::size_t u = (d + 1) % 3, w = (d + 2) % 3;
    normal[d] = (b[u] - a[u]) * (c[w] - a[w]) - (b[w] - a[w]) * (c[u] - a[u]);
  }
  const double length = std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
  return (last ? normal[axis] : -normal[axis]) > facing * length;
}

/// The plane that x coincides with, or -1.
std::int32_t coincident_plane(double x, std::int32_t slab, const LineLocator& lines) {
  const std::int32_t n = lines.intervals();
  const std::int32_t cell = std::clamp(slab, 0, n - 1);
  const double lower = lines.line(cell), upper = lines.line(cell + 1), width = upper - lower;
  if (std::abs(x - lower) <= (cell == 0 ? wall_tolerance : plane_tolerance) * width) return cell;
  if (std::abs(x - upper) <= (cell + 1 == n ? wall_tolerance : plane_tolerance) * width) return cell + 1;
  return -1;
}

}  // namespace

std::vector<std::array<std::int32_t, 2>> open_edges(std::span<const std::int32_t> triangles, std::size_t vertices) {
  // Edges in buckets by their smaller vertex; a bucket is short, so it is searched linearly.
  std::vector<std::int32_t> start(vertices + 1, 0);
  const auto each_edge = [&](auto&& action) {
    for (std::size_t t = 0; t < triangles.size(); t += 3)
      for (std::size_t e = 0; e < 3; ++e) action(triangles[t + e], triangles[t + (e + 1) % 3]);
  };
  each_edge([&](std::int32_t a, std::int32_t b) { ++start[static_cast<std::size_t>(std::min(a, b)) + 1]; });
  for (std::size_t v = 0; v < vertices; ++v) start[v + 1] += start[v];
  struct Edge {
    std::int32_t other, balance;
  };
  std::vector<Edge> edges(static_cast<std::size_t>(start.back()));
  std::vector<std::int32_t> used(vertices, 0);
  each_edge([&](std::int32_t a, std::int32_t b) {
    const std::size_t low = static_cast<std::size_t>(std::min(a, b));
    const std::int32_t other = std::max(a, b), direction = a < b ? 1 : -1;
    Edge* bucket = edges.data() + start[low];
    Edge* end = bucket + used[low];
    Edge* found = std::find_if(bucket, end, [&](const Edge& edge) { return edge.other == other; });
    if (found == end) {
      *found = {other, 0};
      ++used[low];
    }
    found->balance += direction;
  });
  std::vector<std::array<std::int32_t, 2>> open;
  for (std::size_t v = 0; v < vertices; ++v)
    for (std::int32_t e = start[v]; e < start[v] + used[v]; ++e)
      if (edges[static_cast<std::size_t>(e)].balance != 0)
        open.push_back({static_cast<std::int32_t>(v), edges[static_cast<std::size_t>(e)].other});
  return open;
}

void PlacedSurface::place(const BodySurface& surface, const std::array<LineLocator, 3>& lines) {
  const bool comparable = !update_topology(surface) && known_;
  known_ = false;
  std::swap(before_, corners_);
  place_vertices(surface, lines);
  settle_coincidences(lines);
  attach_facing_sides(lines);
  attach_open_edges(lines);
  if (comparable)
    find_moved(before_);
  else
    moved_.assign(vertices_, 1);
  known_ = true;
}

void PlacedSurface::find_moved(const std::vector<Corner>& before) {
  moved_.resize(vertices_);
  compute::for_chunks(vertices_, vertex_chunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v)
      moved_[v] = before[v].x != corners_[v].x || before[v].slab != corners_[v].slab;
  });
}

bool PlacedSurface::unmoved(std::size_t begin, std::size_t end) const {
  return std::none_of(triangles_.begin() + static_cast<std::ptrdiff_t>(3 * begin),
                      triangles_.begin() + static_cast<std::ptrdiff_t>(3 * end),
                      [&](std::int32_t vertex) { return moved_[static_cast<std::size_t>(vertex)] != 0; });
}

double PlacedSurface::reach(const std::array<LineLocator, 3>& lines) const {
  double most = 0;
  for (const LineLocator& along : lines)
    most = std::max({most, std::abs(along.lines().front()), std::abs(along.lines().back())});
  for (const Corner& corner : corners_)
    for (const double x : corner.x) most = std::max(most, std::abs(x));
  return most;
}

bool PlacedSurface::update_topology(const BodySurface& surface) {
  if (surface.positions.size() % 3 != 0 || surface.velocities.size() != surface.positions.size())
    throw GeometryError("a surface needs three coordinates and three velocities per vertex");
  const std::size_t vertices = surface.positions.size() / 3;
  if (vertices == vertices_ && std::ranges::equal(triangles_, surface.triangles)) return false;
  if (surface.triangles.size() % 3 != 0) throw GeometryError("a surface needs three vertices per triangle");
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    if (surface.triangles[t] < 0 || static_cast<std::size_t>(surface.triangles[t]) >= vertices)
      throw GeometryError("triangle " + std::to_string(t / 3) + " names vertex " +
                          std::to_string(surface.triangles[t]) + ", the surface has " + std::to_string(vertices));
  triangles_.assign(surface.triangles.begin(), surface.triangles.end());
  vertices_ = vertices;
  open_edges_ = open_edges(triangles_, vertices_);
  return true;
}

void PlacedSurface::place_vertices(const BodySurface& surface, const std::array<LineLocator, 3>& lines) {
  corners_.resize(vertices_);
  coincidences_.resize(vertices_ / vertex_chunk + 1);
  for (auto& chunk : coincidences_) chunk.clear();
  std::vector<std::int32_t> not_finite(coincidences_.size(), -1);
  compute::for_chunks(vertices_, vertex_chunk, [&](std::size_t begin, std::size_t end) {
    auto& coincidences = coincidences_[begin / vertex_chunk];
    for (std::size_t v = begin; v < end; ++v) {
      Corner& corner = corners_[v];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double x = surface.positions[3 * v + axis];
        if (!std::isfinite(x)) {
          not_finite[begin / vertex_chunk] = static_cast<std::int32_t>(v);
          return;
        }
        corner.x[axis] = x;
        corner.slab[axis] = lines[axis].below(x);
        const std::int32_t plane = coincident_plane(x, corner.slab[axis], lines[axis]);
        if (plane < 0) continue;
        const bool last = plane == lines[axis].intervals();
        if (plane == 0 || last)
          put_on_wall(corner, axis, lines[axis], last);
        else
          coincidences.push_back({static_cast<std::int32_t>(v), static_cast<std::int32_t>(axis), plane});
      }
    }
  });
  for (std::int32_t vertex : not_finite)
    if (vertex >= 0) throw GeometryError("the position of vertex " + std::to_string(vertex) + " is not finite");
}

void PlacedSurface::settle_coincidences(const std::array<LineLocator, 3>& lines) {
  const bool any = std::ranges::any_of(coincidences_, [](const auto& chunk) { return !chunk.empty(); });
  if (!any) return;
  normals_.resize(vertices_);
  coincides_.assign(vertices_, 0);
  for (const auto& chunk : coincidences_)
    for (const Coincidence& at : chunk) {
      coincides_[static_cast<std::size_t>(at.vertex)] = 1;
      normals_[static_cast<std::size_t>(at.vertex)] = {0, 0, 0};
    }
  for (std::size_t t = 0; t < triangles_.size(); t += 3) {
    const auto vertex = [&](std::size_t c) { return static_cast<std::size_t>(triangles_[t + c]); };
    if (!(coincides_[vertex(0)] | coincides_[vertex(1)] | coincides_[vertex(2)])) continue;
    const auto &a = corners_[vertex(0)].x, &b = corners_[vertex(1)].x, &c = corners_[vertex(2)].x;
    for (std::size_t d = 0; d < 3; ++d) {
      const std::size_t u = (d + 1) % 3, w = (d + 2) % 3;
      const double n = (b[u] - a[u]) * (c[w] - a[w]) - (b[w] - a[w]) * (c[u] - a[u]);
      for (std::size_t k = 0; k < 3; ++k) normals_[vertex(k)][d] += n;
    }
  }
  for (const auto& chunk : coincidences_)
    for (const Coincidence& at : chunk) {
      const auto vertex = static_cast<std::size_t>(at.vertex), axis = static_cast<std::size_t>(at.axis);
      corners_[vertex].x[axis] = lines[axis].line(at.plane);
      corners_[vertex].slab[axis] = normals_[vertex][axis] > 0 ? at.plane : at.plane - 1;
    }
}

void PlacedSurface::attach_facing_sides(const std::array<LineLocator, 3>& lines) {
  facing_.clear();
  for (std::size_t t = 0; t < triangles_.size(); t += 3) {
    const auto corner = [&](std::size_t c) -> Corner& { return corners_[static_cast<std::size_t>(triangles_[t + c])]; };
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::int32_t n = lines[axis].intervals();
      if (corner(0).slab[axis] > 0 && corner(0).slab[axis] < n - 1) continue;  // most of them: far from both walls
      for (const bool last : {false, true}) {
        const auto near = [&](const Corner& a) { return last ? a.slab[axis] >= n - 1 : a.slab[axis] <= 0; };
        if (!near(corner(0)) || !near(corner(1)) || !near(corner(2))) continue;
        if (rests_on_wall({&corner(0), &corner(1), &corner(2)}, axis, lines[axis], last))
          for (std::size_t c = 0; c < 3; ++c)
            facing_.push_back({triangles_[t + c], static_cast<std::int32_t>(axis), last});
      }
    }
  }
  for (const Coincidence& at : facing_) {
    const auto axis = static_cast<std::size_t>(at.axis);
    put_on_wall(corners_[static_cast<std::size_t>(at.vertex)], axis, lines[axis], at.plane != 0);
  }
}

void PlacedSurface::attach_open_edges(const std::array<LineLocator, 3>& lines) {
  loose_edges_ = 0;
  for (const auto& edge : open_edges_) {
    Corner &a = corners_[static_cast<std::size_t>(edge[0])], &b = corners_[static_cast<std::size_t>(edge[1])];
    double nearest = wall_reach;
    std::size_t nearest_axis = 0;
    bool nearest_last = false, beyond = false;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::int32_t n = lines[axis].intervals();
      beyond = beyond || (a.slab[axis] < 0 && b.slab[axis] < 0) || (a.slab[axis] == n && b.slab[axis] == n);
      for (const bool last : {false, true}) {
        const double wall = last ? lines[axis].lines().back() : lines[axis].lines().front();
        const double distance =
            std::max(std::abs(a.x[axis] - wall), std::abs(b.x[axis] - wall)) / wall_cell(lines[axis], last);
        if (distance >= nearest) continue;
        nearest = distance, nearest_axis = axis, nearest_last = last;
      }
    }
    if (beyond) continue;
    if (nearest < wall_reach) {
      put_on_wall(a, nearest_axis, lines[nearest_axis], nearest_last);
      put_on_wall(b, nearest_axis, lines[nearest_axis], nearest_last);
    } else {
      ++loose_edges_;
    }
  }
}

}  // namespace polynya::geometry
