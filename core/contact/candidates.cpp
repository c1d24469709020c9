#include "core/contact/candidates.hpp"

#include <algorithm>

#include "core/compute/parallel.hpp"
#include "core/contact/closest_point.hpp"

namespace polynya::contact {
namespace {

constexpr std::size_t chunk = 512;

bool share_a_triangle(const Body& surface, const SurfaceTopology& topology, std::size_t a, std::int32_t b) {
  for (std::int32_t f = topology.fan_start[a]; f < topology.fan_start[a + 1]; ++f) {
    const std::int32_t* v = &surface.triangles[3 * static_cast<std::size_t>(topology.fan[static_cast<std::size_t>(f)])];
    if (v[0] == b || v[1] == b || v[2] == b) return true;
  }
  return false;
}

Box box_of(const Body& surface, std::size_t t) {
  Box box;
  for (std::size_t k = 0; k < 3; ++k)
    box.include(row(surface.positions, static_cast<std::size_t>(surface.triangles[3 * t + k])));
  return box;
}

}  // namespace

bool Exclusion::excludes(const Body& surface, const SurfaceTopology& topology, std::size_t point,
                         std::size_t triangle) const {
  if (!point_origins.empty()) {
    const Vector3 d = row(point_origins, point) - row(triangle_origins, triangle);
    const double reach = point_reaches[point] + triangle_reaches[triangle];
    if (dot(d, d) < reach * reach) return true;
  }
  if (!neighbours) return false;
  for (std::size_t k = 0; k < 3; ++k)
    if (share_a_triangle(surface, topology, point, surface.triangles[3 * triangle + k])) return true;
  return false;
}

void Candidates::search(const Body& points, const Body& surface, const SurfaceTopology& topology,
                        const Exclusion& exclusion, double reach, const Box& region, std::size_t begin, std::size_t end,
                        Found& found) const {
  found.points.clear();
  found.counts.clear();
  found.triangles.clear();
  for (std::size_t i = begin; i < end; ++i) {
    const Vector3 p = row(points.positions, i);
    if (region.distance(p) > 0) continue;
    const double limit = points.radii[i] + reach;
    const auto first = static_cast<std::ptrdiff_t>(found.triangles.size());
    hash_.visit_near(p, [&](std::int32_t t) {
      const auto triangle = static_cast<std::size_t>(t);
      if (boxes_[triangle].distance(p) > 0) return;
      const std::int32_t* v = &surface.triangles[3 * triangle];
      const ClosestPoint c = closest_point_on_triangle(p, row(surface.positions, static_cast<std::size_t>(v[0])),
                                                       row(surface.positions, static_cast<std::size_t>(v[1])),
                                                       row(surface.positions, static_cast<std::size_t>(v[2])));
      if (c.squared_distance > limit * limit) return;
      if (exclusion.any() && exclusion.excludes(surface, topology, i, triangle)) return;
      found.triangles.push_back(t);
    });
    std::sort(found.triangles.begin() + first, found.triangles.end());
    found.triangles.erase(std::unique(found.triangles.begin() + first, found.triangles.end()), found.triangles.end());
    const auto count = static_cast<std::ptrdiff_t>(found.triangles.size()) - first;
    if (count == 0) continue;
    found.points.push_back(static_cast<std::int32_t>(i));
    found.counts.push_back(static_cast<std::int32_t>(count));
  }
}

void Candidates::build(const Body& points, const Body& surface, const SurfaceTopology& topology,
                       const Exclusion& exclusion, double reach) {
  near_.clear();
  start_.assign(1, 0);
  list_.clear();
  double largest_radius = 0;
  for (const double r : points.radii) largest_radius = std::max(largest_radius, r);
  const double longest_reach = largest_radius + reach;
  const std::size_t triangles = surface.triangle_count();
  boxes_.resize(triangles);
  Box around, region;
  for (std::size_t t = 0; t < triangles; ++t) {
    boxes_[t] = box_of(surface, t);
    boxes_[t].grow(longest_reach);
    around.include(boxes_[t].low);
    around.include(boxes_[t].high);
  }
  for (std::size_t i = 0; i < points.vertex_count(); ++i) {
    const Vector3 p = row(points.positions, i);
    if (around.distance(p) == 0) region.include(p);
  }
  if (region.low[0] > region.high[0]) return;

  double size = 0;
  for (const Box& box : boxes_) size += box.high[0] - box.low[0] + box.high[1] - box.low[1] + box.high[2] - box.low[2];
  hash_.build(boxes_, region, size / (3 * static_cast<double>(triangles)));
  found_.resize((points.vertex_count() + chunk - 1) / chunk);
  compute::for_chunks(points.vertex_count(), chunk, [&](std::size_t begin, std::size_t end) {
    search(points, surface, topology, exclusion, reach, region, begin, end, found_[begin / chunk]);
  });
  for (const Found& found : found_) {
    near_.insert(near_.end(), found.points.begin(), found.points.end());
    list_.insert(list_.end(), found.triangles.begin(), found.triangles.end());
    for (const std::int32_t count : found.counts) start_.push_back(start_.back() + count);
  }
}

}  // namespace polynya::contact
