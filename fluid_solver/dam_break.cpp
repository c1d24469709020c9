#include "fluid_solver/dam_break.hpp"

#include <algorithm>

namespace polynya::fluid {
namespace {

double part_below(double lower, double width, double end) {
  return std::clamp((end - lower) / width, 0.0, 1.0);
}

double water_part(const Fluid& fluid, std::ptrdiff_t c) {
  const double held = fluid.material[water].volume[c] + fluid.material[air].volume[c];
  return held > 0 ? fluid.material[water].volume[c] / held : 0.0;
}

/// Widths of the cells along a line, as far as they are half full of water, and the part of the next.
double extent(const Fluid& fluid, std::ptrdiff_t first, std::ptrdiff_t stride, int count, const double* width) {
  double sum = 0;
  for (int n = 0; n < count; ++n) {
    const double part = water_part(fluid, first + n * stride);
    sum += part * width[n];
    if (part < 0.5) break;
  }
  return sum;
}

}  // namespace

void fill_column(Fluid& fluid, double length, double height) {
  const Grid& grid = fluid.grid;
  const Setup& setup = fluid.setup;
  const double rho_air = 1.2, e_air = energy_at(setup.law[air], rho_air, setup.atmospheric_pressure);
  const double start = density_at(setup.law[water], setup.atmospheric_pressure, 0, 1000);
  fill(fluid, {}, [&](int i, int, int k) {
    const double part = part_below(grid.x[i - 1], grid.dx[i], grid.x[0] + length) *
                        part_below(grid.z[k - 1], grid.dz[k], grid.z[0] + height);
    const double depth = std::max(0.0, grid.z[0] + height - grid.centre_z(k));
    const double pressure = setup.atmospheric_pressure + (part > 0 ? start * setup.gravity * depth : 0.0);
    CellState state;
    state.fraction = {part, 1 - part};
    state.density = {density_at(setup.law[water], pressure, 0, start),
                     density_at(setup.law[air], pressure, e_air, rho_air)};
    state.specific_energy = {0, e_air};
    return state;
  });
}

double front_of(const Fluid& fluid) {
  return extent(fluid, fluid.grid.at(1, 1, 1), 1, fluid.grid.nx, fluid.grid.dx.data() + 1);
}

double height_at_wall(const Fluid& fluid) {
  return extent(fluid, fluid.grid.at(1, 1, 1), fluid.grid.sz, fluid.grid.nz, fluid.grid.dz.data() + 1);
}

}  // namespace polynya::fluid
