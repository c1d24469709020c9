#include "core/contact/edge_contact.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "core/contact/closest_lines.hpp"
#include "core/contact/depth.hpp"

namespace polynya::contact {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

struct Ends {
  Vector3 a, b;
};

Ends ends_of(const Body& body, const ConvexEdge& edge) {
  return {row(body.positions, static_cast<std::size_t>(edge.vertices[0])),
          row(body.positions, static_cast<std::size_t>(edge.vertices[1]))};
}

Ends ends_before(const Body& body, const ConvexEdge& edge, const Ends& now, double dt) {
  return {now.a - dt * row(body.velocities, static_cast<std::size_t>(edge.vertices[0])),
          now.b - dt * row(body.velocities, static_cast<std::size_t>(edge.vertices[1]))};
}

Box box_of(const Body& body, const ConvexEdge& edge) {
  Box box;
  box.include(ends_of(body, edge).a);
  box.include(ends_of(body, edge).b);
  return box;
}

bool within(double fraction) {
  return fraction >= 0 && fraction <= 1;
}

constexpr double cone_tolerance = 0.02;  // rad
constexpr double rounding = 1e-14;       // of coordinates: edges that touch count as apart

/// Is the direction between the normals of the edge's two faces?
bool in_cone(const Body& body, const ConvexEdge& edge, const Vector3& direction) {
  const Ends ends = ends_of(body, edge);
  const Vector3 along = ends.b - ends.a;
  const Vector3 n1 = face_normal(body, static_cast<std::size_t>(edge.faces[0])),
                n2 = face_normal(body, static_cast<std::size_t>(edge.faces[1]));
  const Vector3 into_first = (1 / norm(along)) * cross(n1, along), into_second = (-1 / norm(along)) * cross(n2, along);
  return dot(direction, into_first) < cone_tolerance && dot(direction, into_second) < cone_tolerance;
}

/// The pair's common normal, pointing out of the primary body.
Vector3 outward(const Body& primary, const ConvexEdge& edge, const Vector3& normal) {
  const Vector3 faces = face_normal(primary, static_cast<std::size_t>(edge.faces[0])) +
                        face_normal(primary, static_cast<std::size_t>(edge.faces[1]));
  return dot(normal, faces) < 0 ? -1.0 * normal : normal;
}

/// Where the two edges are closest, if they passed through each other in the last step from outside; else not crossing.
ClosestOnLines passage(const Body& primary, const Body& secondary, const ConvexEdge& e, const ConvexEdge& f,
                       double dt) {
  const Ends a = ends_of(primary, e), b = ends_of(secondary, f);
  const ClosestOnLines now = closest_on_lines(a.a, a.b, b.a, b.b);
  if (!now.crossing || !within(now.s) || !within(now.t)) return {};
  const Vector3 n = outward(primary, e, now.normal);
  if (dot(now.apart, n) >= 0) return {};
  const Ends a0 = ends_before(primary, e, a, dt), b0 = ends_before(secondary, f, b, dt);
  const ClosestOnLines before = closest_on_lines(a0.a, a0.b, b0.a, b0.b);
  if (!before.crossing) return {};
  const Vector3 m = dot(before.normal, n) < 0 ? -1.0 * before.normal : before.normal;
  if (dot(before.apart, m) < -rounding * (norm(a.a) + norm(a.b - a.a))) return {};
  return in_cone(primary, e, n) && in_cone(secondary, f, -1.0 * n) ? now : ClosestOnLines{};
}

void edges_at_vertices(const SurfaceTopology& topology, std::vector<std::int32_t>& start,
                       std::vector<std::int32_t>& list) {
  start.assign(topology.fan_start.size(), 0);
  for (const ConvexEdge& edge : topology.convex_edges)
    for (const std::int32_t v : edge.vertices) ++start[static_cast<std::size_t>(v) + 1];
  for (std::size_t v = 0; v + 1 < start.size(); ++v) start[v + 1] += start[v];
  list.resize(2 * topology.convex_edges.size());
  std::vector<std::int32_t> next(start.begin(), start.end());
  for (std::size_t e = 0; e < topology.convex_edges.size(); ++e)
    for (const std::int32_t v : topology.convex_edges[e].vertices)
      list[static_cast<std::size_t>(next[static_cast<std::size_t>(v)]++)] = static_cast<std::int32_t>(e);
}

std::size_t nearer_end(const ConvexEdge& edge, double fraction) {
  return static_cast<std::size_t>(edge.vertices[fraction < 0.5 ? 0 : 1]);
}

/// How far outside [0, 1] a fraction lies, signed.
double overshoot(double fraction) {
  return fraction < 0 ? fraction : fraction > 1 ? fraction - 1 : 0.0;
}

}  // namespace

void EdgeContact::set_topology(const Body& primary, const Body& secondary, const SurfaceTopology& first,
                               const SurfaceTopology& second, std::vector<LostForce>& lost) {
  const auto names_of = [](const Body& body, const SurfaceTopology& topology) {
    std::vector<Names> names;
    for (const ConvexEdge& edge : topology.convex_edges) {
      const std::int64_t a = body.ids[static_cast<std::size_t>(edge.vertices[0])],
                         b = body.ids[static_cast<std::size_t>(edge.vertices[1])];
      names.push_back({a, b});
    }
    return names;
  };
  const auto by_name = [](const std::vector<Names>& names) {
    std::map<std::pair<std::int64_t, std::int64_t>, std::int32_t> found;
    for (std::size_t e = 0; e < names.size(); ++e) found[{names[e].a, names[e].b}] = static_cast<std::int32_t>(e);
    return found;
  };
  const std::vector<Names> names_first = names_of(primary, first), names_second = names_of(secondary, second);
  next_.clear();
  if (!held_.empty()) {
    const auto in_first = by_name(names_first), in_second = by_name(names_second);
    for (Pair pair : held_) {
      const Names& e = names_first_[static_cast<std::size_t>(pair.first)];
      const Names& f = names_second_[static_cast<std::size_t>(pair.second)];
      const auto new_e = in_first.find({e.a, e.b}), new_f = in_second.find({f.a, f.b});
      if (new_e == in_first.end() || new_f == in_second.end()) {
        dropped_energy_ += pair.state.held_energy;
        if (pair.state.normal_force > 0) lost.push_back({pair.state.place, pair.state.normal_force});
        continue;
      }
      pair.first = new_e->second;
      pair.second = new_f->second;
      next_.push_back(pair);
    }
    std::sort(next_.begin(), next_.end(), [](const Pair& a, const Pair& b) { return a.order() < b.order(); });
  }
  held_ = next_;
  names_first_ = names_first;
  names_second_ = names_second;
  edges_at_vertices(first, at_vertex_start_first_, at_vertex_first_);
  edges_at_vertices(second, at_vertex_start_second_, at_vertex_second_);
  start_.assign(second.convex_edges.size() + 1, 0);
  list_.clear();
}

void EdgeContact::search(const Body& primary, const Body& secondary, const SurfaceTopology& first,
                         const SurfaceTopology& second, double reach) {
  start_.assign(1, 0);
  list_.clear();
  boxes_.resize(first.convex_edges.size());
  double longest = 0;
  for (const ConvexEdge& edge : second.convex_edges) {
    const Ends ends = ends_of(secondary, edge);
    longest = std::max(longest, norm(ends.b - ends.a));
  }
  Box around, region;
  double size = 0;
  for (std::size_t e = 0; e < boxes_.size(); ++e) {
    boxes_[e] = box_of(primary, first.convex_edges[e]);
    // Grown by half the longest other edge: whatever comes within reach has its middle in here.
    boxes_[e].grow(reach + 0.5 * longest);
    around.include(boxes_[e].low);
    around.include(boxes_[e].high);
    for (std::size_t d = 0; d < 3; ++d) size += boxes_[e].high[d] - boxes_[e].low[d];
  }
  const auto middle = [&](const ConvexEdge& edge) {
    const Ends ends = ends_of(secondary, edge);
    return 0.5 * (ends.a + ends.b);
  };
  for (const ConvexEdge& edge : second.convex_edges)
    if (around.distance(middle(edge)) == 0) region.include(middle(edge));
  const bool none = region.low[0] > region.high[0];
  if (!none) hash_.build(boxes_, region, size / (3 * static_cast<double>(boxes_.size())));
  for (const ConvexEdge& edge : second.convex_edges) {
    const auto begin = static_cast<std::ptrdiff_t>(list_.size());
    if (!none && region.distance(middle(edge)) == 0) {
      hash_.visit_near(middle(edge), [&](std::int32_t e) {
        const ConvexEdge& other = first.convex_edges[static_cast<std::size_t>(e)];
        Box own = box_of(primary, other);
        own.grow(reach);
        if ((edge.sharp || other.sharp) && own.meets(box_of(secondary, edge))) list_.push_back(e);
      });
      std::sort(list_.begin() + begin, list_.end());
      list_.erase(std::unique(list_.begin() + begin, list_.end()), list_.end());
    }
    start_.push_back(static_cast<std::int32_t>(list_.size()));
  }
}

bool EdgeContact::hold(const Body& primary, const Body& secondary, const SurfaceTopology& first,
                       const SurfaceTopology& second, Pair& pair, Touch& touch) const {
  const auto closest_of = [&](std::int32_t e, std::int32_t f) {
    const Ends a = ends_of(primary, first.convex_edges[static_cast<std::size_t>(e)]),
               b = ends_of(secondary, second.convex_edges[static_cast<std::size_t>(f)]);
    return closest_on_lines(a.a, a.b, b.a, b.b);
  };
  const auto miss = [](const ClosestOnLines& c) { return std::abs(overshoot(c.s)) + std::abs(overshoot(c.t)); };
  ClosestOnLines closest = closest_of(pair.first, pair.second);
  touch = {};
  touch.depth = infinity;
  if (!closest.crossing) return false;
  // Beyond the end of an edge the next one at the vertex takes over, if it fits better.
  const auto go_over = [&](double fraction, const ConvexEdge& edge, const std::vector<std::int32_t>& start,
                           const std::vector<std::int32_t>& list, bool of_first) {
    if (within(fraction)) return;
    const auto v = static_cast<std::size_t>(edge.vertices[fraction < 0 ? 0 : 1]);
    for (std::int32_t k = start[v]; k < start[v + 1]; ++k) {
      const std::int32_t e = of_first ? list[static_cast<std::size_t>(k)] : pair.first;
      const std::int32_t f = of_first ? pair.second : list[static_cast<std::size_t>(k)];
      const ClosestOnLines other = closest_of(e, f);
      if (!other.crossing || miss(other) >= miss(closest)) continue;
      closest = other;
      pair.first = e;
      pair.second = f;
    }
  };
  go_over(closest.s, first.convex_edges[static_cast<std::size_t>(pair.first)], at_vertex_start_first_, at_vertex_first_,
          true);
  go_over(closest.t, second.convex_edges[static_cast<std::size_t>(pair.second)], at_vertex_start_second_,
          at_vertex_second_, false);

  const ConvexEdge& e = first.convex_edges[static_cast<std::size_t>(pair.first)];
  const ConvexEdge& f = second.convex_edges[static_cast<std::size_t>(pair.second)];
  const Ends a = ends_of(primary, e), b = ends_of(secondary, f);
  const Vector3 n = outward(primary, e, closest.normal), u = a.b - a.a, w = b.b - b.a;
  const double below = -dot(closest.apart, n);
  touch.depth = below;
  if (!(below > 0)) return false;
  // The secondary's edge has left the end of the primary's along u, or the end of its own lies behind by w.
  const Vector3 beyond = overshoot(closest.s) * u - overshoot(closest.t) * w;
  const double distance = norm(beyond);
  const FadedDepth faded = distance > 0 ? faded_depth(below, distance, 0) : FadedDepth{below, 1, 0};
  touch.depth = faded.value;
  if (!(faded.value > 0)) return false;
  const double s = std::clamp(closest.s, 0.0, 1.0), t = std::clamp(closest.t, 0.0, 1.0);
  touch.kind = Touch::Kind::edges;
  touch.pushed = {f.vertices[0], f.vertices[1]};
  touch.pushed_weights = {1 - t, t};
  touch.opposed = {e.vertices[0], e.vertices[1], e.vertices[1]};
  touch.opposed_weights = {1 - s, s, 0};
  touch.push = distance > 0 ? faded.push_out * n + (faded.push_aside / distance) * beyond : n;
  touch.slip = pair.state.slip;
  return true;
}

void EdgeContact::mark_vertices_in_contact(const Body& primary, const Body& secondary, std::span<const Touch> touches) {
  touched_first_.assign(primary.vertex_count(), 0);
  touched_second_.assign(secondary.vertex_count(), 0);
  for (const Touch& touch : touches)  // not those that wait without force until they are deeper than beside
    if (touch.depth > 0) (touch.swapped ? touched_first_ : touched_second_)[static_cast<std::size_t>(touch.pushed[0])] = 1;
}

void EdgeContact::find(const Body& primary, const Body& secondary, const SurfaceTopology& first,
                       const SurfaceTopology& second, double dt, std::vector<Touch>& touches) {
  mark_vertices_in_contact(primary, secondary, touches);
  next_.clear();
  Touch touch;
  for (Pair& pair : held_) {
    if (!hold(primary, secondary, first, second, pair, touch)) {
      dropped_energy_ += touch.depth > 0 ? pair.state.held_energy : ended(pair.state, touch.depth);
      continue;
    }
    next_.push_back(pair);
  }
  const auto before = [](const Pair& a, const Pair& b) { return a.order() < b.order(); };
  const auto same = [](const Pair& a, const Pair& b) { return a.order() == b.order(); };
  std::sort(next_.begin(), next_.end(), before);
  next_.erase(std::unique(next_.begin(), next_.end(), same), next_.end());
  const std::size_t kept = next_.size();
  for (std::size_t f = 0; f + 1 < start_.size(); ++f)
    for (std::int32_t k = start_[f]; k < start_[f + 1]; ++k) {
      Pair pair{list_[static_cast<std::size_t>(k)], static_cast<std::int32_t>(f), {}};
      const ConvexEdge& edge = first.convex_edges[static_cast<std::size_t>(pair.first)];
      const ConvexEdge& other = second.convex_edges[f];
      const ClosestOnLines at = passage(primary, secondary, edge, other, dt);
      if (!at.crossing || touched_first_[nearer_end(edge, at.s)] != 0 || touched_second_[nearer_end(other, at.t)] != 0)
        continue;
      if (std::binary_search(next_.begin(), next_.begin() + static_cast<std::ptrdiff_t>(kept), pair, before)) continue;
      pair.state.feature = pair.first;
      pair.state.born = true;
      next_.push_back(pair);
    }
  std::sort(next_.begin(), next_.end(), before);
  std::swap(held_, next_);
  for (Pair& pair : held_)
    if (hold(primary, secondary, first, second, pair, touch)) {
      touch.state = &pair.state;
      touches.push_back(touch);
    }
}

double EdgeContact::take_dropped_energy() {
  return std::exchange(dropped_energy_, 0.0);
}

}  // namespace polynya::contact
