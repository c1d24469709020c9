#include <algorithm>
#include <array>
#include <cmath>

#include "bench/blocks.hpp"
#include "bench/kernels.hpp"
#include "core/continuum/explicit_solid.hpp"

// A block of 1e6 elements of which a part moves: what sleeping saves and what it costs.
namespace polynya::bench {
namespace {

using namespace continuum;

constexpr double threshold = 1e-7, wanted_share = 0.14;
constexpr int steps = 4;

struct Block {
  ExplicitSolid solid;
  std::vector<double> none;
  double dt = 0;
};

/// The nodes of the first chunks move so slowly (1e-12 m/s) that nothing wakes the others; of all chunks: 1 m/s.
Block moving(double sleeping_threshold, double share, double speed) {
  constexpr int n = 100;
  Block block{make_solid("block", in_blocks(cube(n, 1e-3 * n)), Elastic{900, 8.13e9, 4.44e9}), {}};
  ExplicitSolid& solid = block.solid;
  solid.sleeping.threshold = sleeping_threshold;
  const auto moves = static_cast<std::size_t>(std::round(share * static_cast<double>(solid.chunks.chunk_count())));
  for (std::int32_t k = 0; k < solid.chunks.start[moves]; ++k) {
    const auto node = static_cast<std::size_t>(solid.chunks.nodes[k]);
    for (std::size_t i = 0; i < 3; ++i)
      solid.velocities[3 * node + i] =
          speed * std::sin(200 * solid.mesh.nodes[3 * node + (i + 1) % 3] + static_cast<double>(i));
  }
  // What these share with the others is at rest: it moves nobody's chunk but theirs.
  if (share < 1)
    for (std::size_t c = moves; c < solid.chunks.chunk_count(); ++c)
      for (std::int32_t k = solid.chunks.start[c]; k < solid.chunks.start[c + 1]; ++k)
        std::fill_n(solid.velocities.begin() + 3 * solid.chunks.nodes[k], 3, 0.0);
  block.none.assign(3 * solid.node_count(), 0.0);
  block.dt = 0.5 * stable_step(solid);
  internal_forces(solid, 0);
  let_sleep(solid, block.none, block.dt);
  advance_velocities(solid, block.none, 0, block.dt);
  return block;
}

void advance(Block& block) {
  for (int n = 0; n < steps; ++n) {
    advance_positions(block.solid, block.dt);
    internal_forces(block.solid, block.dt);
    advance_velocities(block.solid, block.none, block.dt, block.dt);
  }
}

/// Time without sleeping over that with it, the shortest of a few taken in turns.
double ratio_of_times(Block& without, Block& with) {
  std::array<double, 2> shortest{1e300, 1e300};
  for (int n = 0; n < 5; ++n) {
    shortest[0] = std::min(shortest[0], time_of([&] { advance(without); }));
    shortest[1] = std::min(shortest[1], time_of([&] { advance(with); }));
  }
  return shortest[0] / shortest[1];
}

}  // namespace

/// How much faster steps of 1e6 elements are while about 14 % of them are awake, what that share is exactly, and what
/// sleeping costs where all move (%). On one thread.
std::vector<Figure> solid_sleeping() {
  double speedup = 0, share = 0;
  {
    Block without = moving(0, wanted_share, 1e-12), with = moving(threshold, wanted_share, 1e-12);
    speedup = ratio_of_times(without, with);
    share = static_cast<double>(with.solid.sleeping.elements_awake) / static_cast<double>(with.solid.element_count());
  }
  Block without = moving(0, 1, 1), with = moving(threshold, 1, 1);
  const double overhead = 1 / ratio_of_times(without, with) - 1;
  return {{"ice.sleeping_speedup_14_percent", speedup},
          {"ice.sleeping_share_percent", 100 * share},
          {"ice.sleeping_overhead_percent", 100 * overhead}};
}

}  // namespace polynya::bench
