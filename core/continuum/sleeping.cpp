#include "core/continuum/sleeping.hpp"

#include <algorithm>

#include "core/compute/pack.hpp"
#include "core/compute/parallel.hpp"
#include "core/continuum/explicit_solid.hpp"

namespace polynya::continuum {
namespace {

std::size_t chunk_of(const ExplicitSolid& solid, std::int32_t element) {
  return static_cast<std::size_t>(element) / (solid.chunks.packs_per_chunk * compute::pack_width);
}

/// The largest acceleration, m/s^2, under which a node may be held.
double largest_acceleration(const ExplicitSolid& solid, double dt) {
  return solid.sleeping.threshold * longitudinal_wave_speed(solid.law) / (Sleeping::steps_looked_ahead * dt);
}

/// Whether the forces on the free components of a node would move it. False for forces that are not finite, too.
bool balanced(const ExplicitSolid& solid, std::size_t n, std::span<const double> external, double acceleration) {
  if (!(solid.masses[n] > 0)) return true;
  const auto& held = solid.sleeping.static_force;
  double square = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    if (solid.fixed[n] >> i & 1) continue;
    const std::size_t k = 3 * n + i;
    const double force = solid.internal_force[k] + external[k] + (held.empty() ? 0.0 : held[k]);
    square += force * force;
  }
  const double bound = acceleration * solid.masses[n];
  return square <= bound * bound;
}

bool at_rest(const ExplicitSolid& solid, std::size_t n) {
  return solid.velocities[3 * n] == 0 && solid.velocities[3 * n + 1] == 0 && solid.velocities[3 * n + 2] == 0;
}

void mark_nodes(const ExplicitSolid& solid, std::size_t chunk, std::vector<std::uint8_t>& nodes, bool asleep) {
  const ElementChunks& chunks = solid.chunks;
  for (std::int32_t k = chunks.start[chunk]; k < chunks.start[chunk + 1]; ++k) {
    std::uint8_t& node = nodes[chunks.nodes[k]];
    node = asleep ? 2 : std::min<std::uint8_t>(node, 1);
  }
}

/// Makes everything else from `chunk_asleep`.
void arrange(ExplicitSolid& solid) {
  Sleeping& sleeping = solid.sleeping;
  const std::size_t chunks = solid.chunks.chunk_count(), nodes = solid.node_count(),
                    chunk_elements = solid.chunks.packs_per_chunk * compute::pack_width;
  sleeping.node_asleep.assign(nodes, 0);
  sleeping.elements_awake = 0;
  for (std::size_t c = 0; c < chunks; ++c)
    if (sleeping.chunk_asleep[c]) mark_nodes(solid, c, sleeping.node_asleep, true);
  for (std::size_t c = 0; c < chunks; ++c) {
    if (sleeping.chunk_asleep[c]) continue;
    mark_nodes(solid, c, sleeping.node_asleep, false);
    sleeping.elements_awake += std::min(chunk_elements, solid.element_count() - c * chunk_elements);
  }
  sleeping.all_awake = sleeping.elements_awake == solid.element_count();
  const std::size_t blocks = (nodes + Sleeping::block - 1) / Sleeping::block;
  sleeping.block_asleep.assign(blocks, 0);
  sleeping.block_quiet.assign(blocks, 0);
  for (std::size_t b = 0; b < blocks; ++b) {
    const auto first = sleeping.node_asleep.begin() + static_cast<std::ptrdiff_t>(b * Sleeping::block);
    const auto last =
        sleeping.node_asleep.begin() + static_cast<std::ptrdiff_t>(std::min(nodes, (b + 1) * Sleeping::block));
    const auto awake = std::count(first, last, 0);
    sleeping.block_asleep[b] = awake == 0 ? 2 : awake < last - first ? 1 : 0;
  }
}

bool wake_chunks_around(ExplicitSolid& solid, std::size_t node) {
  bool woken = false;
  for (std::int32_t k = solid.chunks.node_start[node]; k < solid.chunks.node_start[node + 1]; ++k) {
    std::uint8_t& asleep = solid.sleeping.chunk_asleep[chunk_of(solid, solid.chunks.node_elements[k])];
    woken = woken || asleep != 0;
    asleep = 0;
  }
  return woken;
}

/// The held nodes of a block that are pushed beyond the bound.
std::vector<std::size_t> pushed_nodes(ExplicitSolid& solid, std::size_t number, std::span<const double> external,
                                      double acceleration) {
  Sleeping& sleeping = solid.sleeping;
  const std::size_t begin = number * Sleeping::block, end = std::min(solid.node_count(), begin + Sleeping::block);
  std::vector<std::size_t> pushed;
  if (sleeping.block_asleep[number] == 0) return pushed;
  bool loaded = false;
  for (std::size_t k = 3 * begin; k < 3 * end; ++k) loaded |= external[k] != 0;
  if (sleeping.block_quiet[number] && !loaded) return pushed;
  bool amid = true;
  for (std::size_t n = begin; n < end; ++n) {
    amid = amid && sleeping.node_asleep[n] == 2;
    if (sleeping.node_asleep[n] && !balanced(solid, n, external, acceleration)) pushed.push_back(n);
  }
  sleeping.block_quiet[number] = amid && !loaded && pushed.empty();
  return pushed;
}

void note_static_force(ExplicitSolid& solid) {
  const auto& force = solid.damped.static_force;
  if (std::all_of(force.begin(), force.end(), [](double f) { return f == 0; })) return;
  solid.sleeping.static_force.assign(3 * solid.node_count(), 0.0);
  for (std::size_t k = 0; k < force.size(); ++k)
    solid.sleeping.static_force[3 * static_cast<std::size_t>(solid.damped.nodes[k / 3]) + k % 3] = force[k];
}

}  // namespace

void let_sleep(ExplicitSolid& solid, std::span<const double> external, double dt) {
  Sleeping& sleeping = solid.sleeping;
  if (!(sleeping.threshold > 0) || !(dt > 0)) return;
  sleeping.elements_stepped = sleeping.elements_in_all = 0;
  note_static_force(solid);
  const double acceleration = largest_acceleration(solid, dt);
  sleeping.chunk_asleep.assign(solid.chunks.chunk_count(), 1);
  compute::for_chunks(sleeping.chunk_asleep.size(), 1, [&](std::size_t c, std::size_t) {
    for (std::int32_t k = solid.chunks.start[c]; k < solid.chunks.start[c + 1]; ++k) {
      const auto n = static_cast<std::size_t>(solid.chunks.nodes[k]);
      if (at_rest(solid, n) && balanced(solid, n, external, acceleration)) continue;
      sleeping.chunk_asleep[c] = 0;
      return;
    }
  });
  arrange(solid);
}

void wake_where_pushed(ExplicitSolid& solid, std::span<const double> external, double dt) {
  Sleeping& sleeping = solid.sleeping;
  if (sleeping.all_awake || !(dt > 0)) return;
  const double acceleration = largest_acceleration(solid, dt);
  std::vector<std::vector<std::size_t>> pushed(sleeping.block_asleep.size());
  compute::for_chunks(pushed.size(), 1, [&](std::size_t number, std::size_t) {
    pushed[number] = pushed_nodes(solid, number, external, acceleration);
  });
  bool woken = false;
  for (const auto& part : pushed)
    for (const std::size_t n : part) woken = wake_chunks_around(solid, n) || woken;
  if (woken) arrange(solid);
}

void wake(ExplicitSolid& solid, std::size_t node) {
  if (solid.sleeping.node_sleeps(node) && wake_chunks_around(solid, node)) arrange(solid);
}

}  // namespace polynya::continuum
