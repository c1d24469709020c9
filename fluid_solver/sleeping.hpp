#pragma once
#include <array>
#include <cstddef>
#include <vector>

#include "core/compute/state_archive.hpp"

namespace polynya::fluid {

struct Fluid;
struct Grid;

/// Entries first..last of a row along x; none where last < first.
struct Span {
  int first = 1, last = 0;
  bool empty() const { return last < first; }
  bool holds(int i) const { return i >= first && i <= last; }
  bool operator==(const Span&) const = default;
};

/// The smallest span that holds both.
Span hull(Span a, Span b);

/// A block of rows, both ends included, that one thread takes at once, and the entries in each of them. Small enough
/// that what a kernel keeps from layer to layer stays in the second-level cache.
struct Block {
  int first_j, last_j, first_k, last_k;
  Span along;
};

/// What the cells at rest of a row add up to.
struct RowAtRest {
  std::array<double, 2> mass{};   ///< kg
  double internal = 0;            ///< J
  double weight = 0;              ///< on the lower z-faces between them, over the acceleration of gravity, kg
  std::array<double, 3> force{};  ///< of their pressure and weight on the nodes between them, N
  double least_step = 1e300;      ///< smallest width over sound speed, s
  unsigned char materials = 0;    ///< bit 1 water, bit 2 air
};

/// Which part of the fluid is stepped. Bricks of cells that stay below the threshold sleep: their cells keep what they
/// hold to the bit, their nodes are exactly at rest. So nothing flows through their faces and no work is done on them:
/// the border is a wall to what is below the threshold. What is dropped is the motion of nodes: of those that fall
/// asleep, and of those at the border, which pressures push and flows run into. The account has it (`put_to_rest`,
/// `rest_impulse`), each part taken where it is dropped, so that its sums are as constant as those of a fluid awake.
/// Where a row has several bricks awake, those between are awake, too: every kernel runs over one span per row.
struct Sleeping {
  static constexpr int edge = 8;                  ///< of a brick, cells
  static constexpr long steps_between_looks = 8;  ///< in which a signal crosses half a brick
  static constexpr double to_fall_asleep = 0.25;  ///< of the threshold
  static constexpr int quiet_looks_to_sleep = 2;  ///< in a row
  static constexpr double steps_looked_ahead = 1000;

  std::array<int, 3> bricks{};                 ///< along x, y, z
  std::vector<unsigned char> awake;            ///< by brick, x first
  std::vector<unsigned char> quiet_looks;      ///< by brick: how often in a row it was found quiet
  std::vector<double> disturbance;             ///< by brick, at the last look; below 0: not known
  double cells_stepped = 0, cells_in_all = 0;  ///< sums over steps

  // Made by `arrange_awake`. By row, j + (ny + 3) k.
  std::vector<Span> cells;    ///< awake
  std::vector<Span> near;     ///< cells up to two beyond those, in every direction, and what lies between
  std::vector<Span> nodes;    ///< whose cells are all awake: these move
  std::vector<Span> touched;  ///< nodes with a cell awake, and what lies between; also their faces
  std::vector<RowAtRest> rows_at_rest;
  std::vector<unsigned char> layers, planes;  ///< 1 where a layer k, a plane j has cells awake
  std::vector<unsigned char> sheltered;       ///< by brick: it and all its neighbours are awake
  std::vector<Block> cell_blocks, touched_blocks;
  RowAtRest at_rest;                       ///< of all rows
  std::array<double, 6> boundary_force{};  ///< by side of the grid: of the cells at rest outward, N
  std::size_t cells_awake = 0;
  bool all_awake = true;

  /// Of the steps so far: cells that were stepped over cells in all.
  double share_awake() const { return cells_in_all > 0 ? cells_stepped / cells_in_all : 1.0; }

  void list_state(compute::StateArchive& archive) {
    if (archive.loading()) {  // as many as there were
      for (std::vector<Block>* blocks : {&cell_blocks, &touched_blocks}) blocks->clear();
    }
    list_members(archive);
  }

 private:
  POLYNYA_STATE_MEMBERS_WITHOUT((), bricks, awake, quiet_looks, disturbance, cells_stepped, cells_in_all, cells, near,
                                nodes, touched, rows_at_rest, layers, planes, sheltered, cell_blocks, touched_blocks,
                                at_rest, boundary_force, cells_awake, all_awake)
};

/// Calls body(other) for a brick and those around it (up to 27).
template <class Body>
void for_neighbours(const std::array<int, 3>& bricks, std::size_t brick, Body&& body) {
  const std::size_t nx = static_cast<std::size_t>(bricks[0]), ny = static_cast<std::size_t>(bricks[1]);
  const int x = static_cast<int>(brick % nx), y = static_cast<int>(brick / nx % ny),
            z = static_cast<int>(brick / nx / ny);
  const auto low = [](int at) { return at > 0 ? at - 1 : 0; };
  const auto high = [](int at, int count) { return at + 1 < count ? at + 1 : at; };
  for (int c = low(z); c <= high(z, bricks[2]); ++c) {
    for (int b = low(y); b <= high(y, bricks[1]); ++b) {
      for (int a = low(x); a <= high(x, bricks[0]); ++a)
        body(static_cast<std::size_t>(a) + nx * (static_cast<std::size_t>(b) + ny * static_cast<std::size_t>(c)));
    }
  }
}

/// Wakes everything. Called when a fluid is made or filled.
void wake_all(Fluid& fluid);
/// Wakes the brick of a cell and those around it: for whoever changes a state from outside.
void wake(Fluid& fluid, std::ptrdiff_t cell);
/// Wakes bricks between two that are awake along x.
void join_along_rows(Sleeping& sleeping);
/// Makes spans, blocks and sums from `awake`, puts to rest what fell asleep since the last call and fits out what woke.
void arrange_awake(Fluid& fluid);
/// Wakes bricks that hold cells which solids cut, and their neighbours. In every step, before states are evaluated.
void wake_beside_solids(Fluid& fluid);
/// Every few steps, when states are evaluated: wakes the neighbours of what is disturbed, lets sleep what has been
/// quiet.
void look_at_disturbances(Fluid& fluid);
/// A step in which everything sleeps.
void let_time_pass(Fluid& fluid, double dt);

}  // namespace polynya::fluid
