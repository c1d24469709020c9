#include "fluid_solver/fluid.hpp"

#include <algorithm>
#include <cmath>

#include "core/compute/large_pages.hpp"
#include "fluid_solver/equation_range.hpp"
#include "fluid_solver/phases.hpp"
#include "fluid_solver/row_geometry.hpp"

namespace polynya::fluid {

Fluid::Fluid(Grid grid_in, Setup setup_in)
    : grid(std::move(grid_in)),
      setup(std::move(setup_in)),
      before(grid, setup.boundary),
      after(grid, setup.boundary),
      motion(grid) {
  if (setup.sleeping_threshold > 0 && setup.sweeps == Sweeps::all_orders)
    throw std::invalid_argument(
        "nothing sleeps where the remap takes all orders of the sweeps: they run over all cells");
  const std::size_t size = grid.size;
  for (auto& m : material)
    for (auto* array : {&m.mass, &m.energy, &m.volume}) *array = compute::zeros_in_large_pages(size);
  for (auto* arrays : {&velocity, &face_coefficient, &face_rate, &face_mass, &next_velocity}) {
    for (auto& array : *arrays) array = compute::zeros_in_large_pages(size);
  }
  for (auto* array : {&pressure, &predicted_pressure, &density, &bulk_modulus, &sound_speed, &total_mass,
                      &node_fraction, &node_mass, &kinetic_loss, &volume_change, &viscosity, &rate, &sweep_volume}) {
    *array = compute::zeros_in_large_pages(size);
  }
  for (auto& d : donor)
    for (auto* array : {&d.mass, &d.energy, &d.volume}) *array = compute::zeros_in_large_pages(size);
  for (auto* rows : {&row_materials, &row_held}) rows->assign(static_cast<std::size_t>(grid.ny + 3) * (grid.nz + 3), 0);
  held.assign(size, 0);
  cut_rows.assign(row_materials.size(), 1);
  const std::array<std::size_t, 3> faces{static_cast<std::size_t>(grid.ny) * grid.nz,
                                         static_cast<std::size_t>(grid.nx) * grid.nz,
                                         static_cast<std::size_t>(grid.nx) * grid.ny};
  for (int side = 0; side < 6; ++side) {
    if (setup.boundary[side] != Boundary::wall) outflow[side].assign(faces[side / 2], {});
  }
  label.assign(size, -1);
  for (int m = 0; m < 2; ++m) largest_density[m] = polynya::fluid::largest_density(setup.law[m]);
  ambient.assign(static_cast<std::size_t>(grid.nz) + 3, {});
  wake_all(*this);
}

Ambient ambient_of(const Setup& setup, const CellState& state) {
  Ambient layer;
  double heaviest = -1;
  for (int m = 0; m < 2; ++m) {
    layer.fraction[m] = state.fraction[m];
    layer.density[m] = state.fraction[m] * state.density[m];
    layer.energy_density[m] = layer.density[m] * state.specific_energy[m];
    if (state.fraction[m] > heaviest) {
      heaviest = state.fraction[m];
      layer.pressure = respond(setup.law[m], state.density[m], state.specific_energy[m]).pressure;
    }
  }
  return layer;
}

void set_ambient(Fluid& fluid, int k, const CellState& state) {
  fluid.ambient[static_cast<std::size_t>(k)] = ambient_of(fluid.setup, state);
}

void fill_cell(Fluid& fluid, std::ptrdiff_t cell, const CellState& state) {
  const double free = fluid.after.volume[cell];
  for (int m = 0; m < 2; ++m) {
    Material& own = fluid.material[m];
    own.volume[cell] = state.fraction[m] * free;
    own.mass[cell] = state.fraction[m] > 0 ? state.density[m] * own.volume[cell] : 0.0;
    own.energy[cell] = own.mass[cell] * state.specific_energy[m];
  }
}

void finish_filling(Fluid& fluid) {
  fluid.groups = find_groups(fluid.grid, fluid.before, fluid.after, {}, fluid.label);
  update_face_coefficients(fluid);
  update_node_mass(fluid);
  update_cell_states(fluid);
  update_account(fluid);
}

std::ptrdiff_t pressing_cell(const Fluid& fluid, std::ptrdiff_t cell) {
  if (fluid.density[cell] > 0 || fluid.before.volume[cell] > 0) return cell;
  const std::ptrdiff_t now = fluid.after.pressing_on(cell);
  return now != cell ? now : fluid.before.pressing_on(cell);
}

double height_above(const Fluid& fluid, std::ptrdiff_t cell, std::ptrdiff_t other) {
  return fluid.grid.centre_z(static_cast<int>(cell / fluid.grid.sz)) -
         fluid.grid.centre_z(static_cast<int>(other / fluid.grid.sz));
}

double wall_pressure(const Fluid& fluid, std::ptrdiff_t cell) {
  const std::ptrdiff_t c = pressing_cell(fluid, cell);
  if (fluid.density[c] <= 0 && fluid.before.volume[c] <= 0) return fluid.setup.atmospheric_pressure;
  const bool used = fluid.steps > 0 || fluid.predicted_pressure[c] != 0;
  return (used ? fluid.predicted_pressure[c] : fluid.pressure[c]) -
         fluid.density[c] * fluid.setup.gravity * height_above(fluid, cell, c);
}

void overlap_pressure(const Fluid& fluid, std::span<const std::int64_t> cells, std::vector<double>& value,
                      std::vector<double>& gradient) {
  const std::size_t count = cells.size();
  value.assign(count, 0.0);
  gradient.assign(count, 0.0);
  for (std::size_t m = 0; m < count; ++m) {
    const std::ptrdiff_t c = fluid.grid.from_message(cells[m]);
    value[m] = wall_pressure(fluid, c) - fluid.setup.atmospheric_pressure;
    gradient[m] = fluid.density[pressing_cell(fluid, c)] * fluid.setup.gravity;
  }
}

double stable_step(const Fluid& fluid) {
  const Grid& grid = fluid.grid;
  const std::size_t rows = static_cast<std::size_t>(grid.ny) * grid.nz;
  return 0.5 * compute::ordered_minimum(rows, 16, fluid.sleeping.at_rest.least_step, [&](std::size_t row_number) {
           const int j = 1 + static_cast<int>(row_number % grid.ny), k = 1 + static_cast<int>(row_number / grid.ny);
           const std::ptrdiff_t row = grid.at(0, j, k);
           const double thickness = std::min(grid.dy[j], grid.dz[k]);
           const double* sound = fluid.sound_speed.data() + row;
           const double *u = fluid.velocity[0].data() + row, *v = fluid.velocity[1].data() + row,
                        *w = fluid.velocity[2].data() + row;
           const Span cells = awake_cells(fluid, j, k);
           const double* plane_x = fluid.motion.speed[0].data();
           const double plane_y = fluid.motion.speed[1][static_cast<std::size_t>(j)],
                        plane_z = fluid.motion.speed[2][static_cast<std::size_t>(k)];
           double least = 1e300;
#pragma omp simd reduction(min : least)
           for (int i = cells.first; i <= cells.last; ++i) {
             const double x = u[i] - plane_x[i], y = v[i] - plane_y, z = w[i] - plane_z;
             const double speed = sound[i] + std::sqrt(x * x + y * y + z * z);
             const double step = sound[i] > 0 ? std::min(grid.dx[i], thickness) / (speed > 0 ? speed : 1.0) : 1e300;
             least = std::min(least, step);
           }
           return least;
         });
}

bool update_account(Fluid& fluid) {
  const Grid& grid = fluid.grid;
  const std::array<bool, 2> gas{is_gas(fluid.setup.law[0]), is_gas(fluid.setup.law[1])};
  const auto sums = row_sums<8>(grid, 1, [&](int j, int k) {
    const std::ptrdiff_t row = grid.at(0, j, k);
    const Span cells = awake_cells(fluid, j, k), nodes = awake_nodes(fluid, j, k);
    std::array<double, 8> sum{};
    if (j <= grid.ny && k <= grid.nz) {
      const double *m0 = fluid.material[0].mass.data() + row, *m1 = fluid.material[1].mass.data() + row;
      const double *e0 = fluid.material[0].energy.data() + row, *e1 = fluid.material[1].energy.data() + row;
      double first = 0, second = 0, internal = 0, least = 0;
#pragma omp simd reduction(+ : first, second, internal) reduction(min : least)
      for (int i = cells.first; i <= cells.last; ++i) {
        least = std::min(least, std::min(m0[i], m1[i]));
        first += m0[i];
        second += m1[i];
        internal += e0[i] + e1[i];
      }
      for (int m = 0; m < 2; ++m) {
        const double* e = m == 0 ? e0 : e1;
        for (int i = cells.first; gas[m] && i <= cells.last; ++i) least = std::min(least, e[i]);
      }
      sum = {first, second, internal};
      sum[7] = least;
    }
    const double *m = fluid.node_mass.data() + row, *u = fluid.velocity[0].data() + row,
                 *v = fluid.velocity[1].data() + row, *w = fluid.velocity[2].data() + row;
    double x = 0, y = 0, z = 0, kinetic = 0;
#pragma omp simd reduction(+ : x, y, z, kinetic)
    for (int n = nodes.first; n <= nodes.last; ++n) {
      x += m[n] * u[n];
      y += m[n] * v[n];
      z += m[n] * w[n];
      kinetic += 0.5 * m[n] * (u[n] * u[n] + v[n] * v[n] + w[n] * w[n]);
    }
    sum[3] = x;
    sum[4] = y;
    sum[5] = z;
    sum[6] = kinetic;
    return sum;
  });
  Account& account = fluid.account;
  const RowAtRest& at_rest = fluid.sleeping.at_rest;
  account.mass = {sums[0] + at_rest.mass[0], sums[1] + at_rest.mass[1]};
  account.internal = sums[2] + at_rest.internal;
  account.momentum = {sums[3], sums[4], sums[5]};
  account.kinetic = sums[6];
  // A value that is no number makes its sum none, and so does an infinite one.
  return std::isfinite(sums[2] + sums[3] + sums[4] + sums[5] + sums[6]) && sums[7] >= 0;
}

void update_node_mass(Fluid& fluid) {
  const Grid& grid = fluid.grid;
  for_rows(grid, 1, [&](int j, int k) {
    const std::ptrdiff_t row = grid.at(0, j, k), sy = grid.sy, sz = grid.sz;
    const double *m0 = fluid.material[0].mass.data() + row, *m1 = fluid.material[1].mass.data() + row;
    const Span nodes = touched_nodes(fluid, j, k);
#pragma omp simd
    for (std::ptrdiff_t n = nodes.first; n <= nodes.last; ++n) {
      const auto pair = [&](std::ptrdiff_t c) { return (m0[c] + m1[c]) + (m0[c - 1] + m1[c - 1]); };
      fluid.node_mass[row + n] = 0.125 * ((pair(n) + pair(n - sy)) + (pair(n - sz) + pair(n - sy - sz)));
    }
  });
}

}  // namespace polynya::fluid
