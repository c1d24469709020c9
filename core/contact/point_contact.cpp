#include "core/contact/point_contact.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/compute/parallel.hpp"

namespace polynya::contact {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int longest_walk = 64;  // triangles that a held point may pass in a step
// In parts of a triangle: nothing slips through between two triangles, and a corner that comes down on a corner is
// caught though rounding or its own widening puts it a little beside.
constexpr double seam = 1e-6;
constexpr double steepest_depth = 2;  // change of depth over motion, see faded_depth
constexpr double rounding = 1e-14;    // of coordinates: what lies on a face counts as outside

struct Corners {
  Vector3 a, b, c;
};

Corners corners_of(const Body& surface, std::size_t t) {
  const std::int32_t* v = &surface.triangles[3 * t];
  return {row(surface.positions, static_cast<std::size_t>(v[0])),
          row(surface.positions, static_cast<std::size_t>(v[1])),
          row(surface.positions, static_cast<std::size_t>(v[2]))};
}

Corners corners_before(const Body& surface, std::size_t t, const Corners& now, double dt) {
  const std::int32_t* v = &surface.triangles[3 * t];
  return {now.a - dt * row(surface.velocities, static_cast<std::size_t>(v[0])),
          now.b - dt * row(surface.velocities, static_cast<std::size_t>(v[1])),
          now.c - dt * row(surface.velocities, static_cast<std::size_t>(v[2]))};
}

/// Barycentric coordinates of the projection of p on the triangle's plane.
Vector3 barycentric(const Corners& x, const Vector3& p) {
  const Vector3 e = x.b - x.a, f = x.c - x.a, d = p - x.a;
  const double ee = dot(e, e), ef = dot(e, f), ff = dot(f, f), de = dot(d, e), df = dot(d, f);
  const double determinant = ee * ff - ef * ef;
  if (determinant <= 0) return {1, 0, 0};
  const double v = (ff * de - ef * df) / determinant, w = (ee * df - ef * de) / determinant;
  return {1 - v - w, v, w};
}

/// When in the last step (0 before, 1 now) a point came through the triangle from outside; infinity if it did not.
double passage(const Corners& now, const Corners& before, const Vector3& p, const Vector3& p_before) {
  const Vector3 n = cross(now.b - now.a, now.c - now.a), m = cross(before.b - before.a, before.c - before.a);
  const double length = norm(m);
  if (length == 0) return infinity;
  const double at_end = dot(p - now.a, n) / length, at_start = dot(p_before - before.a, m) / length;
  if (at_end >= 0 || at_start < -rounding * (norm(p) + std::sqrt(length))) return infinity;
  const double time = std::clamp(at_start / (at_start - at_end), 0.0, 1.0);
  const auto between = [&](const Vector3& old, const Vector3& present) { return (1 - time) * old + time * present; };
  const Corners x{between(before.a, now.a), between(before.b, now.b), between(before.c, now.c)};
  const Vector3 w = barycentric(x, between(p_before, p));
  return w[0] >= -seam && w[1] >= -seam && w[2] >= -seam ? time : infinity;
}

/// Of a point against the corner of a triangle that it moves fastest against, m/s.
double relative_speed(const Body& points, std::size_t point, const Body& surface, std::size_t triangle) {
  double fastest = 0;
  for (std::size_t k = 0; k < 3; ++k)
    fastest =
        std::max(fastest, norm(row(points.velocities, point) -
                               row(surface.velocities, static_cast<std::size_t>(surface.triangles[3 * triangle + k]))));
  return fastest;
}

/// A triangle and the point of it that is nearest to the contact's point.
struct Footing {
  std::size_t triangle;
  ClosestPoint foot;
};

ClosestPoint foot_on(const Body& surface, std::size_t triangle, const Vector3& p) {
  const Corners x = corners_of(surface, triangle);
  return closest_point_on_triangle(p, x.a, x.b, x.c);
}

/// Walks over the patch from triangle to triangle, downhill in distance, from where the point stood last.
Footing nearest_footing(const Body& surface, const SurfaceTopology& topology, const Exclusion& exclusion,
                        std::size_t point, std::size_t start, const Vector3& p) {
  Footing at{start, foot_on(surface, start, p)};
  for (int step = 0; step < longest_walk; ++step) {
    const std::size_t from = at.triangle;
    for (std::int32_t k = topology.ring_start[from]; k < topology.ring_start[from + 1]; ++k) {
      const auto t = static_cast<std::size_t>(topology.ring[static_cast<std::size_t>(k)]);
      if (t == from || (exclusion.any() && exclusion.excludes(surface, topology, point, t))) continue;
      const ClosestPoint other = foot_on(surface, t, p);
      const double least = at.foot.squared_distance;
      if (other.squared_distance < least || (other.squared_distance == least && t < at.triangle)) at = {t, other};
    }
    if (at.triangle == from) break;
  }
  const std::size_t best = best_at_rim(surface, topology, at.triangle, at.foot, p);
  return best == at.triangle ? at : Footing{best, foot_on(surface, best, p)};
}

/// Turns with a triangle: along its first edge, across, normal.
std::array<Vector3, 3> frame_of(const Body& surface, std::size_t triangle) {
  const Corners x = corners_of(surface, triangle);
  const Vector3 along = x.b - x.a, normal = face_normal(surface, triangle);
  const double length = norm(along);
  const Vector3 first = length > 0 ? (1 / length) * along : Vector3{};
  return {first, cross(normal, first), normal};
}

Vector3 from_frame(const std::array<Vector3, 3>& frame, const Vector3& local) {
  return local[0] * frame[0] + local[1] * frame[1] + local[2] * frame[2];
}

std::uint64_t key_of(std::span<const std::int64_t> ids) {
  std::uint64_t key = 1469598103934665603u;
  for (const std::int64_t id : ids) key = (key ^ static_cast<std::uint64_t>(id)) * 1099511628211u;
  return key;
}

}  // namespace

std::vector<std::int32_t> PointContact::renumber_triangles(const Body& surface) {
  std::vector<std::int64_t> ids(surface.triangles.size());
  for (std::size_t k = 0; k < ids.size(); ++k) ids[k] = surface.ids[static_cast<std::size_t>(surface.triangles[k])];
  std::vector<std::int32_t> renumbered(triangle_ids_.size() / 3, -1);
  if (!held_.empty()) {
    std::unordered_map<std::uint64_t, std::int32_t> known;
    for (std::size_t t = 0; t < surface.triangle_count(); ++t)
      known[key_of(std::span(ids).subspan(3 * t, 3))] = static_cast<std::int32_t>(t);
    for (std::size_t t = 0; t < renumbered.size(); ++t)
      if (const auto found = known.find(key_of(std::span(triangle_ids_).subspan(3 * t, 3))); found != known.end())
        renumbered[t] = found->second;
  }
  triangle_ids_ = std::move(ids);
  return renumbered;
}

bool PointContact::follow(PairState& state, std::span<const std::int32_t> renumbered) {
  const auto now = [&](std::int32_t old) { return old < 0 ? old : renumbered[static_cast<std::size_t>(old)]; };
  state.feature = now(state.feature);
  return state.feature >= 0;
}

void PointContact::set_topology(const Body& points, const Body& surface, std::vector<LostForce>& lost) {
  std::unordered_map<std::int64_t, std::size_t> new_point;
  for (std::size_t i = 0; i < points.vertex_count(); ++i) new_point[points.ids[i]] = i;
  const std::vector<std::int32_t> renumbered = renumber_triangles(surface);
  fresh_.assign(points.vertex_count(), 1);
  for (const std::int64_t id : ids_)
    if (const auto found = new_point.find(id); found != new_point.end()) fresh_[found->second] = 0;
  std::vector<PairState> states(points.vertex_count());
  for (std::size_t k = 0; k < held_.size(); ++k) {
    const auto old = static_cast<std::size_t>(held_[k]);
    PairState state = states_[old];
    const auto found = new_point.find(ids_[old]);
    if (found != new_point.end() && follow(state, renumbered)) {
      states[found->second] = state;
      continue;
    }
    dropped_energy_ += states_[old].held_energy;
    if (state.normal_force > 0) lost.push_back({state.place, state.normal_force});
  }
  states_ = std::move(states);
  ids_.assign(points.ids.begin(), points.ids.end());
  held_.clear();
  for (std::size_t i = 0; i < states_.size(); ++i)
    if (states_[i].feature >= 0) held_.push_back(static_cast<std::int32_t>(i));
}

void PointContact::begin(std::size_t triangle, std::size_t point, bool inside, bool accepted) {
  PairState& state = states_[point];
  const double dropped = state.dropped;
  state = {};
  state.dropped = dropped;
  state.feature = static_cast<std::int32_t>(triangle);
  state.born = true;
  state.inside = inside;
  state.accepted = accepted;
}

bool PointContact::hold(const Body& points, const Body& surface, const SurfaceTopology& topology,
                        const Exclusion& exclusion, double dt, std::size_t point, Touch& touch) {
  PairState& state = states_[point];
  const Vector3 p = row(points.positions, point);
  const Vector3 slip = from_frame(frame_of(surface, static_cast<std::size_t>(state.feature)), state.slip);
  const Footing at = nearest_footing(surface, topology, exclusion, point, static_cast<std::size_t>(state.feature), p);
  const Depth depth =
      depth_at(surface, topology, settings_.mirror, at.triangle, at.foot, p, points.radii[point], state.inside);
  // Caught a little beside a face, it is held without force until it is deeper than it is beside.
  const Corners x = corners_of(surface, at.triangle);
  const bool beside = depth.inside && depth.beyond > 0 && depth.beyond < 2 * seam * norm(x.b - x.a);
  if (!(depth.value > 0) && !beside) {
    const double dropped = state.dropped + ended(state, depth.value);
    state = {};
    state.dropped = dropped;
    return false;
  }
  // What is deeper than motion can have brought it was uncovered: it exerts no force, as at the start.
  state.offset += std::max(
      0.0, depth.value - state.depth - steepest_depth * dt * relative_speed(points, point, surface, at.triangle));
  state.depth = std::max(0.0, depth.value);
  state.feature = static_cast<std::int32_t>(at.triangle);
  state.inside = depth.inside;
  const std::int32_t* v = &surface.triangles[3 * at.triangle];
  touch = {};
  touch.swapped = settings_.swapped;
  touch.pushed = {static_cast<std::int32_t>(point), static_cast<std::int32_t>(point)};
  touch.opposed = {v[0], v[1], v[2]};
  touch.opposed_weights = at.foot.weights;
  touch.push = depth.push;
  touch.depth = std::max(0.0, depth.value);
  touch.slip = slip;
  touch.frame = frame_of(surface, at.triangle);
  touch.state = &state;
  return true;
}

bool PointContact::find_one(const Body& points, const Body& surface, const SurfaceTopology& topology,
                            const Exclusion& exclusion, double dt, std::size_t point,
                            std::span<const std::int32_t> candidates, Touch& touch) {
  const bool was_held = states_[point].feature >= 0;
  if (was_held && hold(points, surface, topology, exclusion, dt, point, touch)) return true;
  const Vector3 p = row(points.positions, point), p_before = p - dt * row(points.velocities, point);
  const double radius = points.radii[point], limit = radius + settings_.depth_limit;
  double first = infinity, least = limit * limit;
  std::size_t through = 0, nearest = 0;
  ClosestPoint foot;
  bool near = false;
  for (const std::int32_t candidate : candidates) {
    const auto t = static_cast<std::size_t>(candidate);
    const Corners x = corners_of(surface, t);
    // Where a held point was before may have been beyond the far side of a thin body: nothing it came through since.
    const double time = was_held ? infinity : passage(x, corners_before(surface, t, x, dt), p, p_before);
    if (time < first) first = time, through = t;
    const ClosestPoint c = closest_point_on_triangle(p, x.a, x.b, x.c);
    if (c.squared_distance < least || (c.squared_distance == least && !near))
      least = c.squared_distance, foot = c, nearest = t, near = true;
  }
  if (first < infinity) {
    begin(through, point, true, false);
    return hold(points, surface, topology, exclusion, dt, point, touch);
  }
  if (!near) return false;
  const Depth depth = depth_at(surface, topology, settings_.mirror, nearest, foot, p, radius, false);
  if (!(depth.value > 0)) return false;
  begin(nearest, point, depth.inside, depth.inside || fresh_[point] != 0);
  return hold(points, surface, topology, exclusion, dt, point, touch);
}

void PointContact::find(const Body& points, const Body& surface, const SurfaceTopology& topology,
                        const Exclusion& exclusion, double dt, double share, std::vector<Touch>& touches) {
  // In the order of the points, whether candidates are at hand or not: sums must not depend on when a search was.
  const auto near = candidates_.near_points();
  active_.clear();
  candidate_of_.clear();
  for (std::size_t n = 0, h = 0; n < near.size() || h < held_.size();) {
    const std::int32_t next_near = n < near.size() ? near[n] : std::numeric_limits<std::int32_t>::max();
    const std::int32_t next_held = h < held_.size() ? held_[h] : std::numeric_limits<std::int32_t>::max();
    active_.push_back(std::min(next_near, next_held));
    candidate_of_.push_back(next_near <= next_held ? static_cast<std::int32_t>(n) : -1);
    n += next_near <= next_held ? 1 : 0;
    h += next_held <= next_near ? 1 : 0;
  }
  found_.resize(active_.size());
  touched_.assign(active_.size(), 0);
  compute::for_chunks(active_.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const auto list = candidate_of_[k] < 0 ? std::span<const std::int32_t>()
                                             : candidates_.of(static_cast<std::size_t>(candidate_of_[k]));
      touched_[k] =
          find_one(points, surface, topology, exclusion, dt, static_cast<std::size_t>(active_[k]), list, found_[k]);
    }
  });
  held_.clear();
  for (std::size_t k = 0; k < active_.size(); ++k) {
    const auto i = static_cast<std::size_t>(active_[k]);
    dropped_energy_ += states_[i].dropped;
    states_[i].dropped = 0;
    if (touched_[k] == 0) continue;
    held_.push_back(active_[k]);
    touches.push_back(found_[k]);
    // A loose particle has no surface of its own whose other side could carry half of the contact.
    touches.back().share = points.radii[i] > 0 ? 1 : share;
  }
  std::fill(fresh_.begin(), fresh_.end(), std::uint8_t{0});
}

double PointContact::take_dropped_energy() {
  return std::exchange(dropped_energy_, 0.0);
}

}  // namespace polynya::contact
