#include "core/contact/penalty_contact.hpp"

#include <algorithm>
#include <limits>

#include "core/compute/parallel.hpp"

namespace polynya::contact {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

struct Box {
  Vector3 low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};
  void include(const Vector3& p, double margin) {
    for (int d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], p[d] - margin);
      high[d] = std::max(high[d], p[d] + margin);
    }
  }
  bool holds(const Vector3& p) const {
    for (int d = 0; d < 3; ++d)
      if (p[d] < low[d] || p[d] > high[d]) return false;
    return true;
  }
};

/// Mass that a unit force at a point with these barycentric weights feels: 1 / sum(w^2 / m).
double mass_at(const PrimarySurface& primary, const std::int32_t* triangle, const Vector3& weights) {
  double compliance = 0;
  for (int v = 0; v < 3; ++v) compliance += weights[v] * weights[v] / primary.masses[triangle[v]];
  return 1 / compliance;
}

}  // namespace

void PenaltyContact::set_topology(std::span<const std::int32_t> triangles, std::size_t vertices) {
  normals_ = make_surface_normals(triangles, vertices);
}

void PenaltyContact::collect_candidates(const PrimarySurface& primary, const SecondaryPoints& secondary) {
  double largest_radius = 0;
  for (double r : secondary.radii) largest_radius = std::max(largest_radius, r);
  const double reach = std::max(law_.depth_limit, largest_radius);
  Box box;
  for (std::size_t v = 0; v < primary.masses.size(); ++v) box.include(row(primary.positions, v), reach);
  candidates_.clear();
  Box narrow;
  for (std::size_t i = 0; i < secondary.masses.size(); ++i) {
    const Vector3 p = row(secondary.positions, i);
    if (!box.holds(p)) continue;
    candidates_.push_back(i);
    narrow.include(p, law_.depth_limit);
  }
  if (candidates_.empty()) return;
  update_surface_normals(normals_, primary.positions, primary.triangles, law_.mirror);
  grid_.build(primary.positions, primary.triangles, narrow.low, narrow.high, law_.depth_limit, reach);
}

bool PenaltyContact::find_touch(const PrimarySurface& primary, const SecondaryPoints& secondary, std::size_t point,
                                Touch& touch) const {
  const Vector3 p = row(secondary.positions, point);
  double least = infinity;
  ClosestPoint best;
  std::size_t best_triangle = 0;
  for (const std::int32_t t : grid_.near(p)) {
    const std::int32_t* v = &primary.triangles[3 * static_cast<std::size_t>(t)];
    const ClosestPoint c = closest_point_on_triangle(p, row(primary.positions, v[0]), row(primary.positions, v[1]),
                                                     row(primary.positions, v[2]));
    if (c.squared_distance < least) {
      least = c.squared_distance;
      best = c;
      best_triangle = static_cast<std::size_t>(t);
    }
  }
  if (least == infinity) return false;
  const std::int32_t* v = &primary.triangles[3 * best_triangle];
  const Vector3 foot = best.weights[0] * row(primary.positions, v[0]) + best.weights[1] * row(primary.positions, v[1]) +
                       best.weights[2] * row(primary.positions, v[2]);
  const Vector3 offset = p - foot;
  const Vector3 outward = pseudo_normal(normals_, primary.triangles, best_triangle, best.feature);
  const bool inside = dot(offset, outward) < 0;
  const double distance = std::sqrt(least);
  const double depth = secondary.radii[point] + (inside ? distance : -distance);
  if (depth <= 0 || (inside && distance > law_.depth_limit)) return false;
  // On a smooth hull the feature's own normal is steadier than the offset when the point lies on the surface.
  const double length = norm(outward);
  if (length == 0) return false;
  const bool use_offset = !inside && distance > 0.1 * secondary.radii[point] && distance > 0;
  touch = {point, best_triangle, best.weights, use_offset ? (1 / distance) * offset : (1 / length) * outward, depth};
  return true;
}

void PenaltyContact::apply(const PrimarySurface& primary, const SecondaryPoints& secondary, const Touch& touch,
                           double dt) {
  const std::int32_t* v = &primary.triangles[3 * touch.triangle];
  const double primary_mass = mass_at(primary, v, touch.weights);
  const double secondary_mass = secondary.masses[touch.point];
  const double reduced_mass = primary_mass * secondary_mass / (primary_mass + secondary_mass);
  const double bound = law_.stiffness_factor * reduced_mass / (dt * dt);
  double stiffness = bound;
  const std::int64_t id = secondary.ids[touch.point];
  if (const auto before = stiffness_before_.find(id); before != stiffness_before_.end()) {
    stiffness = std::min(bound, before->second);
    forces_.released_energy += 0.5 * (before->second - stiffness) * touch.depth * touch.depth;
  }
  stiffness_[id] = stiffness;

  const double normal_force = stiffness * touch.depth;
  Vector3 slip = row(secondary.velocities, touch.point);
  for (int i = 0; i < 3; ++i) slip = slip - touch.weights[i] * row(primary.velocities, v[i]);
  slip = slip - dot(slip, touch.normal) * touch.normal;
  const double slip_speed = norm(slip);
  // Friction may at most stop the sliding over about five steps: beyond that it would reverse it.
  const double friction = std::min(law_.friction * normal_force, 0.2 * reduced_mass * slip_speed / dt);
  Vector3 force = normal_force * touch.normal;
  if (slip_speed > 0) force = force - (friction / slip_speed) * slip;

  add_to_row(forces_.secondary, touch.point, force);
  for (int i = 0; i < 3; ++i) add_to_row(forces_.primary, static_cast<std::size_t>(v[i]), -touch.weights[i] * force);
  forces_.stored_energy += 0.5 * stiffness * touch.depth * touch.depth;
  forces_.friction_power += friction * slip_speed;
  forces_.deepest = std::max(forces_.deepest, touch.depth);
  ++forces_.active;
}

const ContactForces& PenaltyContact::evaluate(const PrimarySurface& primary, const SecondaryPoints& secondary,
                                              double dt) {
  forces_.primary.assign(primary.positions.size(), 0.0);
  forces_.secondary.assign(secondary.positions.size(), 0.0);
  forces_.stored_energy = forces_.friction_power = forces_.released_energy = forces_.deepest = 0;
  forces_.active = 0;
  collect_candidates(primary, secondary);
  touches_.resize(candidates_.size());
  touched_.assign(candidates_.size(), 0);
  compute::for_chunks(candidates_.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c)
      touched_[c] = find_touch(primary, secondary, candidates_[c], touches_[c]) ? 1 : 0;
  });
  std::swap(stiffness_, stiffness_before_);
  stiffness_.clear();
  for (std::size_t c = 0; c < candidates_.size(); ++c)
    if (touched_[c]) apply(primary, secondary, touches_[c], dt);
  return forces_;
}

}  // namespace polynya::contact
