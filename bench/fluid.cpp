#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <memory>

#include "bench/kernels.hpp"
#include "fluid_solver/fluid.hpp"

namespace polynya::bench {
namespace {

constexpr int cells = 128;

/// Water under a wavy surface at two thirds of a cube, air above, everything in motion; open boundaries. About 1.2 % of
/// the cells hold both.
std::unique_ptr<fluid::Fluid> basin() {
  std::vector<double> line;
  for (int i = 0; i <= cells; ++i) line.push_back(0.1 * i / cells);
  fluid::Setup setup;
  setup.gravity = 9.81;
  setup.boundary.fill(fluid::Boundary::non_reflecting);
  auto basin = std::make_unique<fluid::Fluid>(fluid::Grid(line, line, line), setup);
  const fluid::Grid& grid = basin->grid;
  const double water = fluid::density_at(setup.law[0], 101325, 0, 1000),
               heat = fluid::energy_at(setup.law[1], 1.2, 101325);
  fill(*basin, {}, [&](int i, int j, int k) {
    const double surface = 0.0667 + 0.006 * (std::sin(6.2832 * i / cells) + std::sin(6.2832 * j / cells));
    fluid::CellState state;
    state.fraction[0] = std::clamp((surface - grid.z[k - 1]) / grid.dz[k], 0.0, 1.0);
    state.fraction[1] = 1 - state.fraction[0];
    state.density = {water, 1.2};
    state.specific_energy = {0, heat};
    return state;
  });
  for (int k = 1; k <= cells + 1; ++k) {
    for (int j = 1; j <= cells + 1; ++j) {
      for (int i = 1; i <= cells + 1; ++i) {
        const std::ptrdiff_t n = grid.at(i, j, k);
        basin->velocity[0][n] = 5 * std::sin(6.0 * k / cells);
        basin->velocity[1][n] = 5 * std::cos(4.0 * i / cells);
        basin->velocity[2][n] = 5 * std::sin(5.0 * j / cells);
      }
    }
  }
  return basin;
}

/// Memory of this process that is there, bytes (Linux).
double resident_memory() {
  std::ifstream file("/proc/self/statm");
  double all = 0, resident = 0;
  file >> all >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

}  // namespace

/// One whole step (equation of state, Lagrange phase, remap, account) per cell on one thread, ns; how much faster two
/// threads are (only on cores that are free); memory per cell, bytes.
std::vector<Figure> fluid_step() {
  const double before = resident_memory();
  const auto water = basin();
  const double dt = 0.8 * fluid::stable_step(*water), cells_in_all = static_cast<double>(water->grid.cells());
  const auto one_step = [&] { fluid::step(*water, dt, {}); };
  const double seconds = shortest_time(10, one_step);
  const double memory = resident_memory() - before;
  return {{"fluid.cell_ns", 1e9 * seconds / cells_in_all},
          {"fluid.two_threads_speedup", speedup_of_two_threads(10, one_step)},
          {"fluid.cell_bytes", memory / cells_in_all}};
}

}  // namespace polynya::bench
