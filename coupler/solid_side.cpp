#include "coupler/solid_side.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/exchange/errors.hpp"
#include "coupler/vertex_index.hpp"

namespace polynya::coupler {
namespace {

template <class T>
void copy_array(const exchange::Message& message, const char* name, std::vector<T>& target) {
  const auto values = message.view<T>(name);
  target.assign(values.begin(), values.end());
}

void require_size(const exchange::Message& message, const char* name, std::size_t found, std::size_t expected) {
  if (found != expected)
    throw exchange::ProtocolError("message '" + message.kind() + "': array '" + name + "' holds " +
                                  std::to_string(found) + " values, " + std::to_string(expected) +
                                  " are needed for the vertices announced by 'surface.ids'");
}

void read_topology(SolidSide& side, const exchange::Message& message) {
  copy_array(message, "surface.ids", side.ids);
  copy_array(message, "surface.masses", side.masses);
  copy_array(message, "surface.radius", side.radii);
  copy_array(message, "surface.volume", side.volumes);
  copy_array(message, "surface.triangles", side.triangles);
  side.rigid_masses.clear();
  if (message.has("surface.rigid_masses")) {
    copy_array(message, "surface.rigid_masses", side.rigid_masses);
    require_size(message, "surface.rigid_masses", side.rigid_masses.size(), side.ids.size());
    for (const double mass : side.rigid_masses)
      if (!(mass > 0))
        throw exchange::ProtocolError("message '" + message.kind() + "': 'surface.rigid_masses' must be above 0");
  }
  require_size(message, "surface.masses", side.masses.size(), side.ids.size());
  require_size(message, "surface.radius", side.radii.size(), side.ids.size());
  require_size(message, "surface.volume", side.volumes.size(), side.ids.size());
  for (const std::int32_t v : side.triangles)
    if (v < 0 || static_cast<std::size_t>(v) >= side.ids.size())
      throw exchange::ProtocolError("message '" + message.kind() + "': array 'surface.triangles' refers to vertex " +
                                    std::to_string(v) + " of " + std::to_string(side.ids.size()));
}

bool all_finite(std::span<const double> values) {
  long others = 0;
#pragma omp simd reduction(+ : others)
  for (std::size_t i = 0; i < values.size(); ++i)
    others += !(std::abs(values[i]) <= std::numeric_limits<double>::max());
  return others == 0;
}

void read_motion(SolidSide& side, const exchange::Message& message) {
  copy_array(message, "positions", side.positions);
  copy_array(message, "velocities", side.velocities);
  require_size(message, "positions", side.positions.size(), 3 * side.ids.size());
  require_size(message, "velocities", side.velocities.size(), 3 * side.ids.size());
  if (all_finite(side.positions) && all_finite(side.velocities)) return;
  for (std::size_t i = 0; i < side.positions.size(); ++i)
    if (!std::isfinite(side.positions[i]) || !std::isfinite(side.velocities[i]))
      throw std::runtime_error(side.name + ": vertex " + std::to_string(side.ids[i / 3]) +
                               " has a position or velocity that is not a finite number");
}

std::size_t nearest_vertex(const SolidSide& side, const double* p) {
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t v = 0; v < side.vertices(); ++v) {
    double squared = 0;
    for (int d = 0; d < 3; ++d) squared += (side.positions[3 * v + d] - p[d]) * (side.positions[3 * v + d] - p[d]);
    if (squared < least) {
      least = squared;
      best = v;
    }
  }
  return best;
}

/// Where each vertex of a new surface stood in the old one.
class Renumbering {
 public:
  Renumbering(const std::vector<std::int64_t>& old_ids, const std::vector<std::int64_t>& ids) : from_(ids.size()) {
    VertexIndex index(old_ids);
    for (std::size_t v = 0; v < ids.size(); ++v) from_[v] = index.find(ids[v]);
  }
  /// Rows of `old`, those of `otherwise` for vertices that are new.
  std::vector<double> carry(const std::vector<double>& old, std::size_t width, std::vector<double> otherwise) const {
    for (std::size_t v = 0; v < from_.size(); ++v)
      if (from_[v] >= 0)
        std::copy_n(old.begin() + from_[v] * static_cast<std::ptrdiff_t>(width), width,
                    otherwise.begin() + static_cast<std::ptrdiff_t>(v * width));
    return otherwise;
  }

 private:
  std::vector<std::ptrdiff_t> from_;
};

}  // namespace

void add_fluid_impulses(SolidSide& side, std::span<const std::int64_t> ids, std::span<const double> positions,
                        std::span<const double> impulses) {
  if (side.vertices() == 0) return;
  const bool same = ids.size() == side.ids.size() && std::equal(ids.begin(), ids.end(), side.ids.begin());
  VertexIndex index(same ? std::span<const std::int64_t>() : side.ids);
  for (std::size_t old = 0; old < ids.size(); ++old) {
    const double* impulse = &impulses[3 * old];
    if (impulse[0] == 0 && impulse[1] == 0 && impulse[2] == 0) continue;
    std::size_t v = old;
    if (!same) {
      const std::ptrdiff_t found = index.find(ids[old]);
      v = found >= 0 ? static_cast<std::size_t>(found) : nearest_vertex(side, &positions[3 * old]);
    }
    for (int d = 0; d < 3; ++d) side.fluid_impulse[3 * v + d] += impulse[d];
  }
}

void read_ready(SolidSide& side, const exchange::Message& ready) {
  side.stable_step = ready.header.at("stable_step").get<double>();
  side.can_subdivide = ready.header.value("can_subdivide", false);
  side.can_checkpoint = ready.header.value("can_checkpoint", false);
  side.ready_time = ready.header.value("time", 0.0);
  side.account.set_names(ready);
  read_topology(side, ready);
  read_motion(side, ready);
  side.fluid_impulse.assign(3 * side.vertices(), 0.0);
  side.contact_force.assign(3 * side.vertices(), 0.0);
  side.fluid_force.assign(3 * side.vertices(), 0.0);
  side.expected_force.assign(3 * side.vertices(), 0.0);
  side.span_force.assign(3 * side.vertices(), 0.0);
  side.impedance.assign(6 * side.vertices(), 0.0);
  side.kept_share.assign(6 * side.vertices(), 0.0);
  side.seen_velocity = side.velocities;
  side.velocity_sum.assign(3 * side.vertices(), 0.0);
}

void read_surface(SolidSide& side, const exchange::Message& surface) {
  side.stable_step = surface.header.at("stable_step").get<double>();
  side.can_subdivide = surface.header.value("can_subdivide", side.can_subdivide);
  side.account.update(surface);
  side.topology_changed = surface.header.value("topology_changed", false);
  if (!side.topology_changed) {
    read_motion(side, surface);
    return;
  }
  const std::vector<std::int64_t> old_ids = side.ids;
  const std::vector<double> old_positions = side.positions;
  const std::vector<double> old_impulse = std::move(side.fluid_impulse);
  const std::vector<double> old_impedance = std::move(side.impedance), old_seen = std::move(side.seen_velocity),
                            old_sum = std::move(side.velocity_sum), old_start = std::move(side.start_force),
                            old_expected = std::move(side.expected_force), old_span = std::move(side.span_force),
                            old_share = std::move(side.kept_share), old_force = std::move(side.fluid_force);
  read_topology(side, surface);
  read_motion(side, surface);
  side.fluid_impulse.assign(3 * side.vertices(), 0.0);
  add_fluid_impulses(side, old_ids, old_positions, old_impulse);
  const Renumbering renumbering(old_ids, side.ids);
  const std::vector<double> no_matrix(6 * side.vertices(), 0.0);
  side.impedance = renumbering.carry(old_impedance, 6, no_matrix);
  side.kept_share = renumbering.carry(old_share, 6, no_matrix);
  const std::vector<double> none(3 * side.vertices(), 0.0);
  side.fluid_force = renumbering.carry(old_force, 3, none);
  side.expected_force = renumbering.carry(old_expected, 3, none);
  side.span_force = renumbering.carry(old_span, 3, none);
  side.seen_velocity = renumbering.carry(old_seen, 3, side.velocities);
  side.start_force.clear();
  if (!old_start.empty()) side.start_force = renumbering.carry(old_start, 3, none);
  std::vector<double> as_if_always_so = side.velocities;
  for (double& value : as_if_always_so) value *= side.sum_time;
  side.velocity_sum = renumbering.carry(old_sum, 3, std::move(as_if_always_so));
}

std::vector<double> SolidSide::mean_velocity() const {
  if (sum_time <= 0) return velocities;
  std::vector<double> mean = velocity_sum;
  for (double& value : mean) value /= sum_time;
  return mean;
}

void SolidSide::add_to_mean(double step) {
  for (std::size_t i = 0; i < velocity_sum.size(); ++i) velocity_sum[i] += step * velocities[i];
  sum_time += step;
}

void SolidSide::restart_mean() {
  velocity_sum.assign(velocity_sum.size(), 0.0);
  sum_time = 0;
}

void add_loads(exchange::Message& message, const SolidSide& side) {
  const auto force = [&](std::size_t v) -> std::array<double, 3> {
    return {side.contact_force[3 * v] + side.fluid_force[3 * v],
            side.contact_force[3 * v + 1] + side.fluid_force[3 * v + 1],
            side.contact_force[3 * v + 2] + side.fluid_force[3 * v + 2]};
  };
  constexpr std::array<double, 3> none{};
  std::size_t loaded = 0;  // no more memory than that: the message keeps it, and a record keeps many messages
  for (std::size_t v = 0; v < side.vertices(); ++v) loaded += force(v) != none;
  std::vector<std::int64_t> vertices;
  std::vector<double> forces;
  vertices.reserve(loaded);
  forces.reserve(3 * loaded);
  for (std::size_t v = 0; v < side.vertices(); ++v) {
    const std::array<double, 3> on_vertex = force(v);
    if (on_vertex == none) continue;
    vertices.push_back(static_cast<std::int64_t>(v));
    forces.insert(forces.end(), on_vertex.begin(), on_vertex.end());
  }
  const auto count = static_cast<std::int64_t>(loaded);
  message.add<std::int64_t>("load.vertices", {count}, std::move(vertices));
  message.add<double>("load.forces", {count, 3}, std::move(forces));
}

}  // namespace polynya::coupler
