#include "core/contact/motion_watch.hpp"

#include <algorithm>

#include "core/compute/parallel.hpp"
#include "core/contact/box_hash.hpp"

namespace polynya::contact {
namespace {

constexpr std::size_t chunk = 2048;

double longest_edge(const Body& body) {
  double longest = 0;
  for (std::size_t t = 0; t < body.triangle_count(); ++t)
    for (std::size_t e = 0; e < 3; ++e) {
      const Vector3 d = row(body.positions, static_cast<std::size_t>(body.triangles[3 * t + e])) -
                        row(body.positions, static_cast<std::size_t>(body.triangles[3 * t + (e + 1) % 3]));
      longest = std::max(longest, dot(d, d));
    }
  return std::sqrt(longest);
}

}  // namespace

template <class Displacement>
MotionWatch::Spread MotionWatch::spread(std::size_t count, Displacement&& of) {
  Box box;
  for (std::size_t v = 0; v < count; ++v) box.include(of(v));
  if (count == 0) return {};
  return {0.5 * (box.low + box.high), 0.5 * norm(box.high - box.low)};
}

void MotionWatch::restart(const Body& primary, const Body& secondary, double reach, double skin) {
  primary_.assign(primary.positions.begin(), primary.positions.end());
  secondary_.assign(secondary.positions.begin(), secondary.positions.end());
  Box box;
  for (std::size_t v = 0; v < primary.vertex_count(); ++v) box.include(row(primary.positions, v));
  // A triangle may come nearer than its vertices are.
  const double edge = longest_edge(secondary);
  allowance_.resize(secondary.vertex_count());
  for (std::size_t i = 0; i < allowance_.size(); ++i)
    allowance_[i] = std::max(skin, box.distance(row(secondary.positions, i)) - reach - edge);
  chunk_excess_.resize((allowance_.size() + chunk - 1) / chunk);
  chunk_motion_.resize(chunk_excess_.size());
}

bool MotionWatch::outdated(const Body& primary, const Body& secondary, double dt, double margin) {
  if (primary_.size() != primary.positions.size() || secondary_.size() != secondary.positions.size()) return true;
  const Spread moved =
      spread(primary.vertex_count(), [&](std::size_t v) { return row(primary.positions, v) - row(primary_, v); });
  const Spread step = spread(primary.vertex_count(), [&](std::size_t v) { return dt * row(primary.velocities, v); });
  compute::for_chunks(allowance_.size(), chunk, [&](std::size_t begin, std::size_t end) {
    double excess = 0, motion = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const Vector3 d = row(secondary.positions, i) - row(secondary_, i) - moved.centre;
      const double left = allowance_[i] - moved.most;
      if (left < 0 || dot(d, d) > left * left) excess = 1;
      const Vector3 s = dt * row(secondary.velocities, i) - step.centre;
      motion = std::max(motion, dot(s, s));
    }
    chunk_excess_[begin / chunk] = excess;
    chunk_motion_[begin / chunk] = motion;
  });
  double motion = 0, excess = 0;
  for (std::size_t c = 0; c < chunk_excess_.size(); ++c) {
    excess = std::max(excess, chunk_excess_[c]);
    motion = std::max(motion, chunk_motion_[c]);
  }
  step_motion_ = std::sqrt(motion) + step.most;
  return excess > 0 || step_motion_ > margin;
}

}  // namespace polynya::contact
