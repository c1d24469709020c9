#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/compute/state_archive.hpp"

namespace polynya::continuum {

struct ExplicitSolid;

/// Which part of a solid is stepped. A chunk of elements (ElementChunks) whose nodes are all at rest, under forces that
/// balance, sleeps: its nodes are held, so its elements keep stress and forces to the bit and no work is done on them.
/// A held node wakes all chunks around it as soon as the net force f on it, of elements, loads and boundaries, would
/// bring it to the threshold within `steps_looked_ahead` steps:
///     |f| dt / m > threshold c / steps_looked_ahead,     c the longitudinal wave speed, m the mass of the node.
/// Its elements have not been deformed, so their forces are those of the present step: nothing is late. With dt = h/c
/// the same number is the unbalanced stress over rho c^2.
struct Sleeping {
  static constexpr double steps_looked_ahead = 1000;
  static constexpr std::size_t block = 4096;  ///< nodes that are passed over at once

  double threshold = 0;  ///< speed over wave speed; 0: nothing sleeps
  bool all_awake = true;
  std::vector<std::uint8_t> chunk_asleep;  ///< [chunk]; this and the following are empty before `let_sleep`
  std::vector<std::uint8_t> node_asleep;   ///< [n], 1 held beside elements awake, 2 amid sleeping ones
  std::vector<std::uint8_t> block_asleep;  ///< [block of nodes], 1 some of its nodes sleep, 2 all
  std::vector<std::uint8_t>
      block_quiet;                   ///< [block], 1 amid sleeping elements and without loads: a load alone wakes it
  std::vector<double> static_force;  ///< [n][3], N, of non-reflecting boundaries; empty if there is none
  std::size_t elements_awake = 0;
  double elements_stepped = 0, elements_in_all = 0;  ///< sums over steps

  bool chunk_sleeps(std::size_t chunk) const { return !all_awake && chunk_asleep[chunk] != 0; }
  bool node_sleeps(std::size_t node) const { return !all_awake && node_asleep[node] != 0; }
  bool block_sleeps(std::size_t number) const { return !all_awake && block_asleep[number] == 2; }
  void count_step(std::size_t elements) {
    elements_stepped += static_cast<double>(all_awake ? elements : elements_awake);
    elements_in_all += static_cast<double>(elements);
  }
  /// Of the steps so far: elements that were stepped over elements in all.
  double share_awake() const { return elements_in_all > 0 ? elements_stepped / elements_in_all : 1.0; }

  POLYNYA_STATE_WITHOUT((threshold), threshold, all_awake, chunk_asleep, node_asleep, block_asleep, block_quiet,
                        static_force, elements_awake, elements_stepped, elements_in_all)
};

/// Puts to sleep every chunk whose nodes are at rest under forces that balance. At the start, after internal_forces and
/// before the first advance_velocities; external: [n][3], N; dt: the first step, s. Nothing if the threshold is 0.
void let_sleep(ExplicitSolid& solid, std::span<const double> external, double dt);
/// Wakes the chunks around held nodes that are pushed beyond the threshold. advance_velocities calls it.
void wake_where_pushed(ExplicitSolid& solid, std::span<const double> external, double dt);
/// Wakes the chunks around a node: for whoever changes its motion from outside.
void wake(ExplicitSolid& solid, std::size_t node);

}  // namespace polynya::continuum
