#include "core/contact/depth.hpp"

namespace polynya::contact {
namespace {

Vector3 corner(const Body& surface, std::size_t triangle, std::size_t k) {
  return row(surface.positions, static_cast<std::size_t>(surface.triangles[3 * triangle + k]));
}

/// Nothing of a normal points across a plane of symmetry on which its feature lies.
Vector3 mirrored(Vector3 normal, const Vector3& place, std::array<bool, 2> mirror) {
  for (std::size_t d = 0; d < 2; ++d)
    if (mirror[d] && place[d] == 0.0) normal[d] = 0;
  return normal;
}

Vector3 edge_normal(const Body& surface, const SurfaceTopology& topology, std::array<bool, 2> mirror,
                    std::size_t triangle, std::size_t edge) {
  const Vector3 own = face_normal(surface, triangle);
  const std::int32_t other = topology.neighbour[triangle][edge];
  if (other >= 0) return own + face_normal(surface, static_cast<std::size_t>(other));
  const Vector3 a = corner(surface, triangle, edge), b = corner(surface, triangle, (edge + 1) % 3);
  return mirrored(own, {a[0] == 0 && b[0] == 0 ? 0.0 : 1.0, a[1] == 0 && b[1] == 0 ? 0.0 : 1.0, 1}, mirror);
}

Vector3 vertex_normal(const Body& surface, const SurfaceTopology& topology, std::array<bool, 2> mirror, std::size_t v) {
  Vector3 sum{};
  for (std::int32_t f = topology.fan_start[v]; f < topology.fan_start[v + 1]; ++f) {
    const auto t = static_cast<std::size_t>(topology.fan[static_cast<std::size_t>(f)]);
    std::size_t k = 0;
    while (static_cast<std::size_t>(surface.triangles[3 * t + k]) != v) ++k;
    const Vector3 x = corner(surface, t, k);
    const Vector3 a = corner(surface, t, (k + 1) % 3) - x, b = corner(surface, t, (k + 2) % 3) - x;
    sum = sum + std::atan2(norm(cross(a, b)), dot(a, b)) * face_normal(surface, t);
  }
  return mirrored(sum, row(surface.positions, v), mirror);
}

Depth around_feature(const Vector3& offset, const Vector3& outward, double smallest, double radius) {
  const double distance = norm(offset), length = norm(outward);
  const bool inside = dot(offset, outward) < 0;
  Depth depth{radius + (inside ? distance : -distance), {}, inside, 0};
  if (distance > smallest)
    depth.push = ((inside ? -1.0 : 1.0) / distance) * offset;
  else if (length > 0)
    depth.push = (1 / length) * outward;
  return depth;
}

Depth beyond_rim(const Vector3& offset, const Vector3& normal, double smallest, double radius, bool was_inside) {
  const double above = dot(offset, normal), distance = norm(offset);
  const Vector3 aside = offset - above * normal;
  const double beyond = norm(aside);
  if (beyond <= smallest) return {radius - above, normal, above < 0, 0};
  if (above >= 0 || !was_inside) return {radius - distance, (1 / distance) * offset, false, beyond};
  const FadedDepth faded = faded_depth(-above, beyond, radius);
  return {faded.value, faded.push_out * normal + (faded.push_aside / beyond) * aside, true, beyond};
}

/// Local number of an edge's first vertex, 3 if the feature is no edge.
std::size_t edge_of(Feature feature) {
  switch (feature) {
    case Feature::edge01:
      return 0;
    case Feature::edge12:
      return 1;
    case Feature::edge20:
      return 2;
    default:
      return 3;
  }
}

std::size_t vertex_of(Feature feature) {
  return feature == Feature::vertex0 ? 0 : feature == Feature::vertex1 ? 1 : 2;
}

}  // namespace

Vector3 face_normal(const Body& surface, std::size_t triangle) {
  const Vector3 a = corner(surface, triangle, 0), b = corner(surface, triangle, 1), c = corner(surface, triangle, 2);
  const Vector3 n = cross(b - a, c - a);
  const double length = norm(n);
  return length > 0 ? (1 / length) * n : Vector3{0, 0, 0};
}

FadedDepth faded_depth(double below, double beyond, double radius) {
  const double distance = std::sqrt(below * below + beyond * beyond);
  if (distance == 0) return {radius, 1, 0};
  const double b = below / distance, s = beyond / distance;
  return {radius + (b * b - s * s) * distance, b * (b * b + 3 * s * s), s * (3 * b * b + s * s)};
}

Depth depth_at(const Body& surface, const SurfaceTopology& topology, std::array<bool, 2> mirror, std::size_t triangle,
               const ClosestPoint& foot, const Vector3& point, double radius, bool was_inside) {
  const Vector3 a = corner(surface, triangle, 0), b = corner(surface, triangle, 1), c = corner(surface, triangle, 2);
  if (foot.feature == Feature::face) {
    const Vector3 normal = face_normal(surface, triangle);
    const double above = dot(point - a, normal);
    return {radius - above, normal, above < 0, 0};
  }
  const Vector3 offset = point - (foot.weights[0] * a + foot.weights[1] * b + foot.weights[2] * c);
  const double smallest = 1e-10 * norm(b - a);
  if (const std::size_t edge = edge_of(foot.feature); edge < 3) {
    if (topology.edge_kind[triangle][edge] == EdgeKind::rim)
      return beyond_rim(offset, face_normal(surface, triangle), smallest, radius, was_inside);
    return around_feature(offset, edge_normal(surface, topology, mirror, triangle, edge), smallest, radius);
  }
  const auto v = static_cast<std::size_t>(surface.triangles[3 * triangle + vertex_of(foot.feature)]);
  if (topology.rim_vertex[v] != 0)
    return beyond_rim(offset, face_normal(surface, triangle), smallest, radius, was_inside);
  return around_feature(offset, vertex_normal(surface, topology, mirror, v), smallest, radius);
}

std::size_t best_at_rim(const Body& surface, const SurfaceTopology& topology, std::size_t triangle,
                        const ClosestPoint& foot, const Vector3& point) {
  if (foot.feature == Feature::face) return triangle;
  Vector3 offset = point;
  for (std::size_t k = 0; k < 3; ++k) offset = offset - foot.weights[k] * corner(surface, triangle, k);
  std::size_t best = triangle;
  double most = dot(offset, face_normal(surface, triangle));
  if (most < 0) return triangle;  // below its plane: the face itself lets go of the point
  const auto consider = [&](std::size_t other) {
    const double above = dot(offset, face_normal(surface, other));
    if (above > most || (above == most && other < best)) most = above, best = other;
  };
  if (const std::size_t edge = edge_of(foot.feature); edge < 3) {
    if (topology.edge_kind[triangle][edge] == EdgeKind::rim && topology.neighbour[triangle][edge] >= 0)
      consider(static_cast<std::size_t>(topology.neighbour[triangle][edge]));
    return best;
  }
  const auto v = static_cast<std::size_t>(surface.triangles[3 * triangle + vertex_of(foot.feature)]);
  if (topology.rim_vertex[v] == 0) return triangle;
  for (std::int32_t f = topology.fan_start[v]; f < topology.fan_start[v + 1]; ++f)
    consider(static_cast<std::size_t>(topology.fan[static_cast<std::size_t>(f)]));
  return best;
}

}  // namespace polynya::contact
