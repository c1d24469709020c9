#pragma once
#include <algorithm>
#include <atomic>
#include <limits>

#include "core/compute/parallel.hpp"
#include "core/continuum/full_kernel.hpp"
#include "core/continuum/hexahedron_kernel.hpp"

namespace polynya::continuum {

/// Throws BadElement for the first living element whose volume or stress is bad.
[[noreturn]] void report_bad_element(const ExplicitSolid& solid, std::size_t first_pack);

/// Copies the motion of a chunk's nodes and clears their forces.
void stage_nodes(const ExplicitSolid& solid, std::size_t chunk, ChunkNodes& nodes);
/// Forces of the elements of a chunk to the nodes it has alone, and to its shares in others.
void hand_out_forces(const ChunkNodes& nodes, std::size_t chunk, ExplicitSolid& solid);
/// Adds up the shares of the nodes of several chunks.
void add_shared_forces(ExplicitSolid& solid);

/// internal_forces of fully integrated elements.
void internal_forces_full(ExplicitSolid& solid, double dt);

/// What a chunk tells besides forces.
struct ChunkReport {
  double hourglass = 0, viscous = 0, step_limit = 1e300;
  std::size_t bad_pack = std::numeric_limits<std::size_t>::max();
};

template <Integration integration, class T, class LawType>
ChunkReport advance_packs(ExplicitSolid& solid, const LawType& law, std::size_t begin, std::size_t end, double dt,
                          ChunkNodes& nodes) {
  ChunkReport report;
  ElementSums<T> sums;
  for (std::size_t pack = begin; pack < end; ++pack) {
    if (solid.idle[pack]) continue;
    prefetch_state<LawType>(solid, pack);
    bool good = true;
    for (std::size_t lane = 0; lane < compute::pack_width; lane += width_of<T>) {
      if constexpr (integration == Integration::full)
        good = advance_full_elements<LawType, T>(solid, law, {pack, lane}, dt, nodes, sums) && good;
      else
        good = advance_elements<LawType, T>(solid, law, {pack, lane}, dt, nodes, sums) && good;
    }
    if (!good) report.bad_pack = std::min(report.bad_pack, pack);
    if (solid.complete[pack]) continue;
    const double* alive = &solid.element.alive[pack * compute::pack_width];
    solid.idle[pack] = std::all_of(alive, alive + compute::pack_width, [](double a) { return a == 0; });
  }
  report.hourglass = sum_of_lanes(sums.hourglass);
  report.viscous = sum_of_lanes(sums.viscous);
  report.step_limit = smallest_lane(sums.step_limit);
  return report;
}

/// The loop over elements for one law; T: the number that the kernel works in.
template <Integration integration, class T, class LawType>
void advance_all_elements(ExplicitSolid& solid, const LawType& law, double dt) {
  const std::size_t packs_per_chunk = solid.chunks.packs_per_chunk;
  std::vector<ChunkReport> reports(solid.chunks.chunk_count());
  const auto advance_chunk = [&](std::size_t begin, std::size_t end) {
    thread_local ChunkNodes nodes;
    const std::size_t chunk = begin / packs_per_chunk;
    if (solid.sleeping.chunk_sleeps(chunk)) return;
    stage_nodes(solid, chunk, nodes);
    reports[chunk] = advance_packs<integration, T>(solid, law, begin, end, dt, nodes);
    hand_out_forces(nodes, chunk, solid);
  };
  if (solid.sleeping.all_awake)
    compute::for_chunks(solid.idle.size(), packs_per_chunk, advance_chunk);
  else
    compute::for_uneven_chunks(solid.idle.size(), packs_per_chunk, advance_chunk);
  solid.sleeping.count_step(solid.element_count());
  add_shared_forces(solid);
  std::size_t bad_pack = std::numeric_limits<std::size_t>::max();
  for (std::size_t c = 0; c < reports.size(); ++c) {
    if (solid.sleeping.chunk_sleeps(c)) continue;  // its step limit stays what it was
    solid.hourglass_energy += reports[c].hourglass;
    solid.viscous_energy += reports[c].viscous;
    solid.chunk_step_limit[c] = reports[c].step_limit;
    bad_pack = std::min(bad_pack, reports[c].bad_pack);
  }
  solid.step_limit = stable_step(solid);
  if (bad_pack < solid.idle.size()) report_bad_element(solid, bad_pack);
}

}  // namespace polynya::continuum
