// Pressure, density and stiffness of every cell from what it holds. Runs of cells of one material go through one loop
// that vectorises; cells that hold both go one by one.
#include <algorithm>
#include <cmath>

#include "fluid_solver/phases.hpp"
#include "fluid_solver/pressure_equilibrium.hpp"
#include "fluid_solver/row_geometry.hpp"

namespace polynya::fluid {
namespace {

template <class Law>
void evaluate_row(const Law& law, double floor, double void_pressure, std::ptrdiff_t begin, std::ptrdiff_t end,
                  const double* __restrict mass, const double* __restrict energy, const double* __restrict volume,
                  double* __restrict pressure, double* __restrict bulk_modulus_out, double* __restrict density,
                  double* __restrict sound_speed) {
  const double largest = 1.0 / least_wave_density(law);
  for (std::ptrdiff_t c = begin; c < end; ++c) {
    const bool filled = mass[c] > void_density * volume[c] && volume[c] > 0;
    const double m = filled ? mass[c] : 1.0, e = filled ? energy[c] : 0.0, v = filled ? volume[c] : 1.0;
    const double rho = m / v;
    const Response r = law(rho, e / m);
    const double bulk = std::max(0.0, rho * r.by_density + r.pressure * r.by_energy * v / m);
    const double p = std::max(r.pressure, floor);
    pressure[c] = filled ? p : volume[c] > 0 ? void_pressure : 0.0;
    bulk_modulus_out[c] = filled && r.pressure > floor ? bulk : 0.0;
    density[c] = filled ? rho : 0.0;
    sound_speed[c] = filled ? std::sqrt(std::max(0.0, square_of_sound_speed(r, std::min(v / m, largest)))) : 0.0;
  }
}

void evaluate_mixed_cell(Fluid& fluid, std::ptrdiff_t c, double volume) {
  const auto& law = fluid.setup.law;
  const auto& floor = fluid.setup.pressure_floor;
  PointState state{};
  Mixture mixture;
  for (int m = 0; m < 2; ++m) {
    mixture.mass[m] = fluid.material[m].mass[c];
    mixture.energy[m] = fluid.material[m].energy[c];
    mixture.volume[m] = fluid.material[m].volume[c];
  }
  if (volume > 0 && mixture.mass[0] + mixture.mass[1] > void_density * volume) {
    state = settle(law, floor, volume, mixture);
    for (int m = 0; m < 2; ++m) {
      fluid.material[m].energy[c] = mixture.energy[m];
      fluid.material[m].volume[c] = mixture.volume[m];
    }
  } else {
    state.pressure = volume > 0 ? floor[water] : 0.0;
  }
  fluid.pressure[c] = state.pressure;
  fluid.bulk_modulus[c] = state.bulk_modulus;
  fluid.sound_speed[c] = state.sound_speed;
  fluid.density[c] = volume > 0 ? (mixture.mass[0] + mixture.mass[1]) / volume : 0.0;
}

/// A run of cells that hold material m alone.
void evaluate_pure_cells(Fluid& fluid, int m, std::ptrdiff_t begin, std::ptrdiff_t end,
                         const std::vector<double>& volume) {
  std::visit(
      [&](const auto& law) {
        evaluate_row(law, fluid.setup.pressure_floor[m], fluid.setup.pressure_floor[water], begin, end,
                     fluid.material[m].mass.data(), fluid.material[m].energy.data(), volume.data(),
                     fluid.pressure.data(), fluid.bulk_modulus.data(), fluid.density.data(), fluid.sound_speed.data());
      },
      fluid.setup.law[m]);
  for (std::ptrdiff_t c = begin; c < end; ++c) {
    fluid.material[m].volume[c] = volume[c];
    fluid.material[1 - m].volume[c] = 0;
  }
}

}  // namespace

void evaluate_cells(Fluid& fluid, const std::vector<double>& volume) {
  const Grid& grid = fluid.grid;
  for_rows(grid, 0, [&](int j, int k) {
    const Span awake = awake_cells(fluid, j, k);
    if (awake.empty()) return;
    const std::ptrdiff_t begin = grid.at(awake.first, j, k), end = grid.at(awake.last, j, k) + 1;
    const double *m0 = fluid.material[0].mass.data(), *m1 = fluid.material[1].mass.data();
    double has0 = 0, has1 = 0;
    for (std::ptrdiff_t c = begin; c < end; ++c) {
      has0 = std::max(has0, m0[c]);
      has1 = std::max(has1, m1[c]);
    }
    const int held = (has0 > 0 ? 1 : 0) | (has1 > 0 ? 2 : 0) | materials_at_rest(fluid, j, k);
    fluid.row_materials[static_cast<std::size_t>(j + (grid.ny + 3) * k)] = static_cast<unsigned char>(held);
    if (held == 3 || !untouched(fluid, j, k)) {
      for (std::ptrdiff_t c = begin; c < end; ++c) fluid.total_mass[c] = m0[c] + m1[c];
    }
    if (held != 3) {
      evaluate_pure_cells(fluid, held == 2 ? 1 : 0, begin, end, volume);
      return;
    }
    const auto alone = [&](std::ptrdiff_t c) { return m1[c] == 0 ? 0 : m0[c] == 0 ? 1 : 2; };
    for (std::ptrdiff_t c = begin; c < end;) {
      const int material = alone(c);
      if (material == 2) {
        evaluate_mixed_cell(fluid, c, volume[c]);
        ++c;
        continue;
      }
      const std::ptrdiff_t first = c;
      while (c < end && alone(c) == material) ++c;
      evaluate_pure_cells(fluid, material, first, c, volume);
    }
  });
}

void update_cell_states(Fluid& fluid) {
  evaluate_cells(fluid, fluid.after.volume);
  evaluate_groups(fluid);
}

}  // namespace polynya::fluid
