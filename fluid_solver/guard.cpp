// One error, with place and state, at the first cell that has lost its meaning.
#include <cmath>
#include <mutex>
#include <sstream>

#include "fluid_solver/phases.hpp"

namespace polynya::fluid {
namespace {

bool sound(const Fluid& fluid, std::ptrdiff_t c) {
  for (int m = 0; m < 2; ++m) {
    const double mass = fluid.material[m].mass[c], energy = fluid.material[m].energy[c];
    if (!std::isfinite(mass) || !std::isfinite(energy) || mass < -1e-9 * fluid.grid.cell_volume[c]) return false;
  }
  return std::isfinite(fluid.velocity[0][c]) && std::isfinite(fluid.velocity[1][c]) && std::isfinite(fluid.velocity[2][c]);
}

std::string describe(const Fluid& fluid, std::ptrdiff_t c) {
  const Grid& grid = fluid.grid;
  int i, j, k;
  grid.position(c, i, j, k);
  std::ostringstream text;
  text << "the fluid has lost its meaning in cell " << grid.to_message(c) << " at (" << grid.centre_x(i) << ", "
       << grid.centre_y(j) << ", " << grid.centre_z(k) << ") m, time " << fluid.time << " s, step " << fluid.steps
       << ": free volume " << fluid.after.volume[c] / grid.cell_volume[c] << " of the cell, pressure "
       << fluid.predicted_pressure[c] << " Pa";
  for (int m = 0; m < 2; ++m) {
    text << (m == water ? "; water " : "; air ") << fluid.material[m].mass[c] << " kg, " << fluid.material[m].energy[c]
         << " J, " << fluid.material[m].volume[c] << " m^3";
  }
  text << "; velocity (" << fluid.velocity[0][c] << ", " << fluid.velocity[1][c] << ", " << fluid.velocity[2][c] << ") m/s";
  return text.str();
}

}  // namespace

void check_state(const Fluid& fluid) {
  const Grid& grid = fluid.grid;
  std::ptrdiff_t first = -1;
  std::mutex guard;
  for_rows(grid, 0, [&](int j, int k) {
    // One sum per row tells whether anything is not finite; only then are cells looked at.
    const std::ptrdiff_t row = grid.at(1, j, k);
    double total = 0, least = 0;
    for (std::ptrdiff_t c = row; c < row + grid.nx; ++c) {
      total += fluid.material[0].energy[c] + fluid.material[1].energy[c] + fluid.velocity[0][c] + fluid.velocity[1][c] + fluid.velocity[2][c];
      least = std::min(least, std::min(fluid.material[0].mass[c], fluid.material[1].mass[c]));
    }
    if (std::isfinite(total) && least >= 0) return;
    for (std::ptrdiff_t c = row; c < row + grid.nx; ++c) {
      if (sound(fluid, c)) continue;
      const std::lock_guard lock(guard);
      if (first < 0 || c < first) first = c;
      return;
    }
  });
  if (first >= 0) throw FluidError(describe(fluid, first));
}

}  // namespace polynya::fluid
