// One error, with place and state, at the first cell that has lost its meaning. Every step looks at rows of cells with
// a few comparisons; cells are looked at one by one only in rows that these hold suspect.
#include <cmath>
#include <mutex>
#include <sstream>

#include "fluid_solver/equation_range.hpp"
#include "fluid_solver/phases.hpp"
#include "fluid_solver/pressure_equilibrium.hpp"
#include "fluid_solver/row_geometry.hpp"

namespace polynya::fluid {
namespace {

std::string describe(const Fluid& fluid, std::ptrdiff_t c, const std::string& fault) {
  const Grid& grid = fluid.grid;
  int i, j, k;
  grid.position(c, i, j, k);
  std::ostringstream text;
  text << fault << " in cell " << grid.to_message(c) << " at (" << grid.centre_x(i) << ", " << grid.centre_y(j) << ", "
       << grid.centre_z(k) << ") m, time " << fluid.time << " s, step " << fluid.steps << ": free volume "
       << fluid.after.volume[c] / grid.cell_volume[c] << " of the cell, pressure " << fluid.pressure[c] << " Pa";
  for (int m = 0; m < 2; ++m) {
    text << "; " << fluid.setup.name[m] << ' ' << fluid.material[m].mass[c] << " kg, " << fluid.material[m].energy[c]
         << " J, " << fluid.material[m].volume[c] << " m^3";
  }
  text << "; velocity (" << fluid.velocity[0][c] << ", " << fluid.velocity[1][c] << ", " << fluid.velocity[2][c]
       << ") m/s";
  return text.str();
}

/// What is wrong with a cell of this free volume; empty if nothing is. rounding: see range_fault, by material.
std::string fault_of(const Fluid& fluid, std::ptrdiff_t c, double volume, const std::array<double, 2>& rounding) {
  const auto& [law, floor] = std::tie(fluid.setup.law, fluid.setup.pressure_floor);
  const std::string lost = "the fluid has lost its meaning: ";
  Mixture held;
  double sum = fluid.velocity[0][c] + fluid.velocity[1][c] + fluid.velocity[2][c];
  for (int m = 0; m < 2; ++m) {
    const Material& own = fluid.material[m];
    held.mass[m] = own.mass[c];
    held.energy[m] = own.energy[c];
    held.volume[m] = own.volume[c];
    sum += own.mass[c] + own.energy[c];
    if (own.mass[c] < -1e-9 * fluid.grid.cell_volume[c]) return lost + "negative density of " + fluid.setup.name[m];
  }
  if (!std::isfinite(sum)) return lost + "values that are not finite";
  if (!(volume > 0) || !(held.mass[0] + held.mass[1] > void_density * volume)) return {};
  for (int m = 0; m < 2; ++m) {
    // What is shared later comes to one pressure, which would hide it.
    const bool traces = !(held.mass[m] > void_density * volume);
    if (is_gas(law[m]) && !traces && held.energy[m] < -rounding[m] * volume)
      return lost + "negative internal energy of " + fluid.setup.name[m] + ", a gas";
  }
  settle(law, floor, volume, held);
  for (int m = 0; m < 2; ++m) {
    if (!(held.mass[m] > void_density * volume) || !(held.volume[m] > dormant_fraction * volume)) continue;
    const double rho = held.mass[m] / held.volume[m], e = held.energy[m] / held.mass[m];
    const std::string fault = range_fault(law[m], {floor[m], fluid.largest_density[m], rounding[m]}, rho, e);
    if (!fault.empty()) return "the equation of state of " + fluid.setup.name[m] + " is out of its range: " + fault;
  }
  return {};
}

/// Energy density that rounding may leave behind where a row's energy went: a part of the largest in the row, J/m^3.
std::array<double, 2> rounding_of(const Fluid& fluid, std::ptrdiff_t row) {
  std::array<double, 2> largest{};
  for (int m = 0; m < 2; ++m) {
    for (std::ptrdiff_t c = row; c < row + fluid.grid.nx; ++c)
      largest[m] = std::max(largest[m], std::abs(fluid.material[m].energy[c]) / fluid.grid.cell_volume[c]);
    largest[m] *= 1e-9;
  }
  return largest;
}

/// First fault among the rows for which suspect(first cell of the row, what of it is awake) holds, as an error.
template <class Suspect>
void look(const Fluid& fluid, const std::vector<double>& volume, Suspect&& suspect) {
  const Grid& grid = fluid.grid;
  std::ptrdiff_t first = -1;
  std::string text;
  std::mutex guard;
  for_rows(grid, 0, [&](int j, int k) {
    const std::ptrdiff_t row = grid.at(1, j, k);
    if (!suspect(row, awake_cells(fluid, j, k))) return;
    const std::array<double, 2> rounding = rounding_of(fluid, row);
    for (std::ptrdiff_t c = row; c < row + grid.nx; ++c) {
      const std::string fault = fault_of(fluid, c, volume[c], rounding);
      if (fault.empty()) continue;
      const std::lock_guard lock(guard);
      if (first < 0 || c < first) first = c, text = fault;
      return;
    }
  });
  if (first >= 0) throw FluidError(describe(fluid, first, text));
}

}  // namespace

void check_state(const Fluid& fluid) {
  look(fluid, fluid.after.volume, [](std::ptrdiff_t, Span) { return true; });
}

void check_ranges(const Fluid& fluid) {
  const auto& [floor, most] = std::tie(fluid.setup.pressure_floor, fluid.largest_density);
  // The energy of a gas is looked at with the accounts at the end of a step, before shared cells come to one pressure.
  const std::array<bool, 2> gas{is_gas(fluid.setup.law[0]), is_gas(fluid.setup.law[1])};
  const double *p = fluid.pressure.data(), *bulk = fluid.bulk_modulus.data(), *rho = fluid.density.data();
  const double* whole = fluid.grid.cell_volume.data();
  look(fluid, fluid.before.volume, [&](std::ptrdiff_t row, Span awake) {
    const std::ptrdiff_t begin = row + awake.first - 1, end = row + awake.last;
    const int materials = fluid.row_materials[static_cast<std::size_t>(row / fluid.grid.sy)];
    int odd = 0;
    for (int m = 0; m < 2; ++m) {
      if (!(materials & (1 << m)) || gas[m]) continue;
      if (materials == 3) {
        const double *mass = fluid.material[m].mass.data(), *volume = fluid.material[m].volume.data();
        for (std::ptrdiff_t c = begin; c < end; ++c)
          odd |= ((mass[c] > most[m] * volume[c]) & (volume[c] > dormant_fraction * whole[c])) |
                 ((rho[c] > 0) & (bulk[c] == 0) & (p[c] > floor[m]));
      } else {
        for (std::ptrdiff_t c = begin; c < end; ++c)
          odd |= (rho[c] > most[m]) | ((rho[c] > 0) & (bulk[c] == 0) & (p[c] > floor[m]));
      }
    }
    return odd != 0;
  });
}

void check_lagrange_volumes(const Fluid& fluid, double dt) {
  const Grid& grid = fluid.grid;
  const std::ptrdiff_t sy = grid.sy, sz = grid.sz;
  const double *qx = fluid.face_rate[0].data(), *qy = fluid.face_rate[1].data(), *qz = fluid.face_rate[2].data();
  const double *v0 = fluid.before.volume.data(), *v1 = fluid.after.volume.data(), *whole = grid.cell_volume.data();
  const auto left = [&](std::ptrdiff_t c) {
    return v0[c] + dt * (std::min(qx[c + 1] - qx[c], 0.0) + std::min(qy[c + sy] - qy[c], 0.0) +
                         std::min(qz[c + sz] - qz[c], 0.0));
  };
  std::ptrdiff_t first = -1;
  std::mutex guard;
  for_rows(grid, 0, [&](int j, int k) {
    const std::ptrdiff_t row = grid.at(1, j, k);
    const Span awake = awake_cells(fluid, j, k);
    int folded = 0;
    for (std::ptrdiff_t c = row + awake.first - 1; c < row + awake.last; ++c)
      folded |= (left(c) <= 0) & (std::min(v0[c], v1[c]) >= 0.999999 * whole[c]);
    if (!folded) return;
    for (std::ptrdiff_t c = row; c < row + grid.nx; ++c) {
      if (left(c) > 0 || std::min(v0[c], v1[c]) < 0.999999 * whole[c]) continue;
      const std::lock_guard lock(guard);
      if (first < 0 || c < first) first = c;
      return;
    }
  });
  if (first < 0) return;
  std::ostringstream text;
  text << "the grid folds: a step of " << dt << " s leaves " << left(first) / whole[first]
       << " of the volume after the closing of its sides";
  throw FluidError(describe(fluid, first, text.str()));
}

}  // namespace polynya::fluid
