// The flow through faces of the Lagrange phase, and the work of the pressure that accelerated the nodes by the adjoint
// of the same average: kinetic plus internal energy changes only by the works that are booked.
#include <algorithm>
#include <cmath>
#include <utility>

#include "fluid_solver/phases.hpp"
#include "fluid_solver/pressure_equilibrium.hpp"
#include "fluid_solver/row_geometry.hpp"

namespace polynya::fluid {
namespace {

/// The sum of two fields, read like one.
struct Sum {
  const double *first, *second;
  double operator[](std::ptrdiff_t i) const { return first[i] + second[i]; }
};

/// Volume per time through the lower faces of rows (j, k), entries `first` to `last`: half the flow if velocities are
/// sums of two.
template <class Row, class Velocity>
void row_rates(const Row& row, const Grid& grid, const std::array<Velocity, 3>& velocity, double part, int first,
               int last, const std::array<double*, 3>& rate) {
  const std::ptrdiff_t sy = grid.sy, sz = grid.sz;
  const auto [u, v, w] = velocity;
  const auto [qx, qy, qz] = rate;
#pragma omp simd
  for (int i = first; i <= last; ++i) {
    qx[i] = part * flow_x(row, u, i, sy, sz);
    qy[i] = part * flow_y(row, v, i, sz);
    qz[i] = part * flow_z(row, w, i, sy);
  }
}

using Field3 = std::array<std::vector<double>, 3>;

std::array<const double*, 3> row_of(const Field3& field, std::ptrdiff_t row) {
  return {field[0].data() + row, field[1].data() + row, field[2].data() + row};
}
std::array<double*, 3> row_of(Field3& field, std::ptrdiff_t row) {
  return {field[0].data() + row, field[1].data() + row, field[2].data() + row};
}

}  // namespace

void face_rates(const Fluid& fluid, const Field3& velocity, Field3& rate) {
  const Grid& grid = fluid.grid;
  for_rows(grid, 1, [&](int j, int k) {
    const std::ptrdiff_t row = grid.at(0, j, k);
    with_row(fluid, j, k,
             [&](auto at) { row_rates(at, grid, row_of(velocity, row), 1.0, 1, grid.nx + 1, row_of(rate, row)); });
  });
}

void boundary_face_rates(Fluid& fluid) {
  const Grid& grid = fluid.grid;
  const auto& side = fluid.setup.boundary;
  const auto open = [&](int number) { return side[number] != Boundary::wall; };
  for_rows(grid, 1, [&](int j, int k) {
    const bool whole_row =
        (j == 1 && open(2)) || (j > grid.ny && open(3)) || (k == 1 && open(4)) || (k > grid.nz && open(5));
    const Span faces = touched_nodes(fluid, j, k);
    if (faces.empty() || (!whole_row && !open(0) && !open(1))) return;
    const std::ptrdiff_t row = grid.at(0, j, k);
    with_row(fluid, j, k, [&](auto at) {
      const auto velocity = row_of(std::as_const(fluid.velocity), row);
      const auto rate = row_of(fluid.face_rate, row);
      if (whole_row) row_rates(at, grid, velocity, 1.0, faces.first, faces.last, rate);
      for (const int end : {1, grid.nx + 1}) rate[0][end] = flow_x(at, velocity[0], end, grid.sy, grid.sz);
    });
  });
}

void mean_face_rates(Fluid& fluid) {
  const Grid& grid = fluid.grid;
  for_rows(grid, 1, [&](int j, int k) {
    const std::ptrdiff_t row = grid.at(0, j, k);
    const Span faces = touched_nodes(fluid, j, k);
    const auto before = row_of(std::as_const(fluid.velocity), row),
               after = row_of(std::as_const(fluid.next_velocity), row);
    const std::array<Sum, 3> velocity{Sum{before[0], after[0]}, Sum{before[1], after[1]}, Sum{before[2], after[2]}};
    with_row(fluid, j, k, [&](auto at) {
      row_rates(at, grid, velocity, 0.5, faces.first, faces.last, row_of(fluid.face_rate, row));
    });
    for (int axis = 0; axis < 3; ++axis) set_wall_flow(fluid, axis, j, k, fluid.face_rate[axis].data() + row);
  });
}

namespace {

/// What a row of cells exchanges: volume per time through lower faces, and the weight of half a cell below and above a
/// face over density and area.
struct WorkRow {
  const double *qx, *qy, *qz, *p, *rho;
  double low, high;

  WorkRow(const Fluid& fluid, int j, int k) {
    const std::ptrdiff_t row = fluid.grid.at(0, j, k);
    qx = fluid.face_rate[0].data() + row;
    qy = fluid.face_rate[1].data() + row;
    qz = fluid.face_rate[2].data() + row;
    p = fluid.predicted_pressure.data() + row;
    rho = fluid.density.data() + row;
    low = 0.5 * fluid.setup.gravity * fluid.grid.dz[k - 1];
    high = 0.5 * fluid.setup.gravity * fluid.grid.dz[k];
  }
  double flow(std::ptrdiff_t i, std::ptrdiff_t sy, std::ptrdiff_t sz) const {
    return qx[i + 1] - qx[i] + qy[i + sy] - qy[i] + qz[i + sz] - qz[i];
  }
  double lifted(std::ptrdiff_t i, std::ptrdiff_t sz) const { return qz[i] * (low * rho[i - sz] + high * rho[i]); }
};

/// Sums over a row: work against gravity per time, and what the pressure of vapour did.
using Works = std::array<double, 2>;

/// Where a liquid cavitates, its least pressure is that of vapour at saturation, whose energy is not the liquid's: were
/// it taken from there, the traces left in a void would be as hot as its whole volume once that closes. So this part of
/// the work goes to the account and comes back from it. 0 Pa for materials that do not cavitate.
double vapour_pressure(const Fluid& fluid, int material) {
  return std::max(0.0, fluid.setup.pressure_floor[material]);
}

/// A row of one material that no solid touches.
Works work_in_open_row(Fluid& fluid, double dt, int j, int k, int material) {
  const Grid& grid = fluid.grid;
  const std::ptrdiff_t row = grid.at(0, j, k), sy = grid.sy, sz = grid.sz;
  const WorkRow at(fluid, j, k);
  Material& own = fluid.material[material];
  const double area = grid.dy[j] * grid.dz[k], *dx = grid.dx.data(), *m = own.mass.data() + row,
               *bulk = fluid.bulk_modulus.data() + row, vapour = vapour_pressure(fluid, material);
  double *volume = fluid.sweep_volume.data() + row, *e = own.energy.data() + row, *held = own.volume.data() + row;
  const Span cells = awake_cells(fluid, j, k);
  double work = 0, of_vapour = 0;
#pragma omp simd reduction(+ : work, of_vapour)
  for (int i = cells.first; i <= cells.last; ++i) {
    const double change = dt * at.flow(i, sy, sz), later = dx[i] * area + change;
    const double apart = m[i] > 0 ? bulk[i] > 0 ? 0.0 : vapour : at.p[i];
    volume[i] = later;
    e[i] -= (at.p[i] - apart) * change;
    of_vapour += apart * change;
    held[i] = m[i] > 0 ? later : 0.0;
    work += at.lifted(i, sz);
  }
  return {work, of_vapour};
}

/// Any row: first what its volumes become, then the work on the materials.
double volumes_of_row(Fluid& fluid, double dt, int j, int k) {
  const Grid& grid = fluid.grid;
  const std::ptrdiff_t row = grid.at(0, j, k), sy = grid.sy, sz = grid.sz;
  const WorkRow at(fluid, j, k);
  const double *v0 = fluid.before.volume.data() + row, *swept = fluid.volume_change.data() + row;
  double *volume = fluid.sweep_volume.data() + row, *rate = fluid.rate.data() + row;
  const double over_dt = 1.0 / dt;
  const Span cells = awake_cells(fluid, j, k);
  double work = 0;
#pragma omp simd reduction(+ : work)
  for (int i = cells.first; i <= cells.last; ++i) {
    const double flow = at.flow(i, sy, sz);
    rate[i] = flow + swept[i] * over_dt;
    volume[i] = v0[i] + (dt * flow + swept[i]);
    work += at.lifted(i, sz);
  }
  return work;
}

/// Returns the work of vapour, as does the next one.
double work_on_one(Fluid& fluid, double dt, std::ptrdiff_t row, Span cells, int material) {
  Material& own = fluid.material[material];
  const double *bulk = fluid.bulk_modulus.data() + row, vapour = vapour_pressure(fluid, material);
  const double *m = own.mass.data() + row, *p = fluid.predicted_pressure.data() + row, *rate = fluid.rate.data() + row,
               *volume = fluid.sweep_volume.data() + row;
  double *e = own.energy.data() + row, *held = own.volume.data() + row;
  double of_vapour = 0;
#pragma omp simd reduction(+ : of_vapour)
  for (int i = cells.first; i <= cells.last; ++i) {
    const double change = dt * rate[i], apart = m[i] > 0 ? bulk[i] > 0 ? 0.0 : vapour : p[i];
    e[i] -= (p[i] - apart) * change;
    of_vapour += apart * change;
    held[i] = m[i] > 0 ? volume[i] : 0.0;
  }
  return of_vapour;
}

double work_on_both(Fluid& fluid, std::ptrdiff_t row, Span cells) {
  double of_vapour = 0;
  for (std::ptrdiff_t c = row + cells.first; c <= row + cells.last; ++c) {
    const double change = fluid.sweep_volume[c] - fluid.before.volume[c];
    Mixture mixture;
    for (int m = 0; m < 2; ++m) {
      mixture.mass[m] = fluid.material[m].mass[c];
      mixture.energy[m] = fluid.material[m].energy[c];
      mixture.volume[m] = fluid.material[m].volume[c];
    }
    const std::array<double, 2> share = volume_shares(fluid.setup.law, fluid.setup.pressure_floor, mixture, change);
    const double p = fluid.predicted_pressure[c], apart = pressure_of_vapour(fluid, c);
    of_vapour += apart * change;
    for (int m = 0; m < 2; ++m) {
      fluid.material[m].energy[c] -= (p - apart) * change * share[m];
      fluid.material[m].volume[c] += change * share[m];
    }
  }
  return of_vapour;
}

}  // namespace

double pressure_of_vapour(const Fluid& fluid, std::ptrdiff_t cell) {
  const bool has_water = fluid.material[water].mass[cell] > 0, has_air = fluid.material[air].mass[cell] > 0;
  if (!has_water && !has_air) return fluid.predicted_pressure[cell];
  if ((has_water && has_air) || fluid.bulk_modulus[cell] > 0) return 0;
  return vapour_pressure(fluid, has_water ? water : air);
}

void work_and_volumes(Fluid& fluid, double dt) {
  const Grid& grid = fluid.grid;
  const Works done = row_sums<2>(grid, 0, [&](int j, int k) {
    const std::ptrdiff_t row = grid.at(0, j, k);
    const Span cells = awake_cells(fluid, j, k);
    if (cells.empty()) return Works{};
    const int materials = fluid.row_materials[static_cast<std::size_t>(j + (grid.ny + 3) * k)];
    const int own = materials == 2 ? 1 : 0;
    Works work{};
    if (materials != 3 && untouched(fluid, j, k)) {
      work = work_in_open_row(fluid, dt, j, k, own);
    } else {
      work[0] = volumes_of_row(fluid, dt, j, k);
      work[1] = materials != 3 ? work_on_one(fluid, dt, row, cells, own) : work_on_both(fluid, row, cells);
    }
    if (k < grid.nz) return work;
    const WorkRow at(fluid, j, k);
    for (int i = cells.first; i <= cells.last; ++i) work[0] += at.qz[i + grid.sz] * (at.high * at.rho[i]);
    return work;
  });
  fluid.account.gravity += dt * done[0];
  fluid.account.vapour -= done[1];
}

void hold_cut_cells(Fluid& fluid) {
  for (const std::ptrdiff_t c : fluid.held_cells)
    fluid.held[c] = fluid.row_held[static_cast<std::size_t>(c / fluid.grid.sy)] = 0;
  fluid.held_cells.clear();
  const auto hold = [&](std::ptrdiff_t c) {
    if (fluid.held[c]) return;
    fluid.held[c] = fluid.row_held[static_cast<std::size_t>(c / fluid.grid.sy)] = 1;
    fluid.held_cells.push_back(c);
    const double volume = fluid.sweep_volume[c], inverse = volume > 0 ? 1.0 / volume : 0.0;
    for (int m = 0; m < 2; ++m) {
      fluid.donor[m].mass[c] = fluid.material[m].mass[c] * inverse;
      fluid.donor[m].energy[c] = fluid.material[m].energy[c] * inverse;
      fluid.donor[m].volume[c] = fluid.material[m].volume[c] * inverse;
    }
  };
  for (const WallPiece& wall : fluid.before.walls) hold(wall.cell);
  for (const WallPiece& wall : fluid.after.walls) hold(wall.cell);
  for (const Groups::Member& member : fluid.groups.members) hold(member.cell);
}

}  // namespace polynya::fluid
