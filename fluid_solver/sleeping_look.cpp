// Who sleeps and who wakes. Disturbance of a cell: the larger of speed over sound speed and of the change of pressure
// over the last half step over the bulk modulus. A brick beyond the threshold keeps all its neighbours awake, so that
// at least a brick lies between it and what sleeps, twice as much as sound crosses from look to look.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "fluid_solver/phases.hpp"
#include "fluid_solver/pressure_equilibrium.hpp"
#include "fluid_solver/sleeping.hpp"

namespace polynya::fluid {
namespace {

constexpr double no_rest = std::numeric_limits<double>::infinity();

std::size_t brick_of(const Fluid& fluid, std::ptrdiff_t cell) {
  int i, j, k;
  fluid.grid.position(cell, i, j, k);
  const auto at = [](int cell_number) { return static_cast<std::size_t>((cell_number - 1) / Sleeping::edge); };
  const auto& bricks = fluid.sleeping.bricks;
  return at(i) + static_cast<std::size_t>(bricks[0]) * (at(j) + static_cast<std::size_t>(bricks[1]) * at(k));
}

template <class Body>
void for_bricks_beside_solids(const Fluid& fluid, Body&& body) {
  for (const CutGeometry* cut : {&fluid.before, &fluid.after})
    for (const WallPiece& wall : cut->walls) body(brick_of(fluid, wall.cell));
  for (const Groups::Member& member : fluid.groups.members) body(brick_of(fluid, member.cell));
}

/// Largest disturbance in a part of a row of cells; infinite where a cell cavitates.
double disturbance_of_row(const Fluid& fluid, std::ptrdiff_t row, Span cells) {
  const double *u = fluid.velocity[0].data() + row, *v = fluid.velocity[1].data() + row,
               *w = fluid.velocity[2].data() + row, *sound = fluid.sound_speed.data() + row,
               *p = fluid.pressure.data() + row, *used = fluid.predicted_pressure.data() + row,
               *bulk = fluid.bulk_modulus.data() + row;
  double square = 0, change = 0, stiffness = no_rest;
#pragma omp simd reduction(max : square, change) reduction(min : stiffness)
  for (int i = cells.first; i <= cells.last; ++i) {
    const double c = std::max(sound[i], 1e-3), k = std::max(bulk[i], 1e-3);
    square = std::max(square, (u[i] * u[i] + v[i] * v[i] + w[i] * w[i]) / (c * c));
    change = std::max(change, std::abs(used[i] - p[i]) / k);
    stiffness = std::min(stiffness, bulk[i]);
  }
  return stiffness > 0 ? std::max(std::sqrt(square), change) : no_rest;
}

/// Of a brick; once it is beyond `enough` the rest is not looked at.
double disturbance_of_brick(const Fluid& fluid, std::size_t brick, double enough) {
  constexpr int edge = Sleeping::edge;
  const Grid& grid = fluid.grid;
  const std::size_t nx = static_cast<std::size_t>(fluid.sleeping.bricks[0]),
                    ny = static_cast<std::size_t>(fluid.sleeping.bricks[1]);
  const int x = static_cast<int>(brick % nx), y = static_cast<int>(brick / nx % ny),
            z = static_cast<int>(brick / nx / ny);
  const Span cells{1 + edge * x, std::min(grid.nx, edge * (x + 1))};
  double largest = 0;
  for (int k = 1 + edge * z; k <= std::min(grid.nz, edge * (z + 1)); ++k) {
    for (int j = 1 + edge * y; j <= std::min(grid.ny, edge * (y + 1)) && largest <= enough; ++j)
      largest = std::max(largest, disturbance_of_row(fluid, grid.at(0, j, k), cells));
  }
  return largest;
}

std::vector<double> present_disturbance(const Fluid& fluid) {
  const Sleeping& sleeping = fluid.sleeping;
  std::vector<double> present(sleeping.awake.size(), 0.0);
  compute::for_uneven_chunks(present.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b)
      if (sleeping.awake[b]) present[b] = disturbance_of_brick(fluid, b, fluid.setup.sleeping_threshold);
  });
  for_bricks_beside_solids(fluid, [&](std::size_t brick) { present[brick] = no_rest; });
  return present;
}

/// True if a brick is quiet, and stays below the threshold for long even if its disturbance grows on as it did.
bool quiet(double before, double now, double threshold) {
  constexpr double looks_ahead = Sleeping::steps_looked_ahead / Sleeping::steps_between_looks;
  return now <= Sleeping::to_fall_asleep * threshold && before >= 0 && now + looks_ahead * (now - before) <= threshold;
}

}  // namespace

void wake(Fluid& fluid, std::ptrdiff_t cell) {
  Sleeping& sleeping = fluid.sleeping;
  const std::size_t brick = brick_of(fluid, cell);
  if (sleeping.sheltered[brick]) return;
  for_neighbours(sleeping.bricks, brick, [&](std::size_t other) { sleeping.awake[other] = 1; });
  arrange_awake(fluid);
}

void wake_beside_solids(Fluid& fluid) {
  Sleeping& sleeping = fluid.sleeping;
  if (sleeping.all_awake) return;
  bool changed = false;
  for_bricks_beside_solids(fluid, [&](std::size_t brick) {
    if (sleeping.sheltered[brick]) return;
    sleeping.sheltered[brick] = 1;
    for_neighbours(sleeping.bricks, brick, [&](std::size_t other) { sleeping.awake[other] = 1; });
    changed = true;
  });
  if (changed) arrange_awake(fluid);
}

void look_at_disturbances(Fluid& fluid) {
  const double threshold = fluid.setup.sleeping_threshold;
  if (!(threshold > 0) || fluid.steps == 0 || fluid.steps % Sleeping::steps_between_looks != 0) return;
  Sleeping& sleeping = fluid.sleeping;
  const std::vector<double> present = present_disturbance(fluid);
  const std::vector<unsigned char> before = sleeping.awake;
  std::vector<unsigned char> beside(present.size(), 0);
  for (std::size_t b = 0; b < present.size(); ++b) {
    if (present[b] > threshold) for_neighbours(sleeping.bricks, b, [&](std::size_t other) { beside[other] = 1; });
  }
  for (std::size_t b = 0; b < present.size(); ++b) {
    const double last = before[b] ? std::exchange(sleeping.disturbance[b], present[b]) : -1.0;
    const bool calm = before[b] && quiet(last, present[b], threshold);
    sleeping.quiet_looks[b] = calm ? static_cast<unsigned char>(std::min(sleeping.quiet_looks[b] + 1, 255)) : 0;
    if (beside[b])
      sleeping.awake[b] = 1;
    else if (sleeping.quiet_looks[b] >= Sleeping::quiet_looks_to_sleep)
      sleeping.awake[b] = 0;
    if (!sleeping.awake[b]) sleeping.disturbance[b] = -1.0;
  }
  join_along_rows(sleeping);
  if (sleeping.awake != before) arrange_awake(fluid);
}

}  // namespace polynya::fluid
