// The Lagrange phase: volume rates, predicted pressure, acceleration of nodes by the adjoint of the face average, and
// the work that goes with it, so that kinetic plus internal energy changes only by the works that are booked.
#include <algorithm>
#include <cmath>

#include "fluid_solver/phases.hpp"
#include "fluid_solver/pressure_equilibrium.hpp"

namespace polynya::fluid {
namespace {

template <bool mean>
void rates(const Fluid& fluid, const std::array<std::vector<double>, 3>& velocity,
           std::array<std::vector<double>, 3>& rate) {
  const Grid& grid = fluid.grid;
  const std::ptrdiff_t sy = grid.sy, sz = grid.sz;
  for_rows(grid, 1, [&](int j, int k) {
    const std::ptrdiff_t row = grid.at(0, j, k);
    const double* b = fluid.node_fraction.data() + row;
    const double *u = velocity[0].data() + row, *v = velocity[1].data() + row, *w = velocity[2].data() + row;
    const double *ax = fluid.face_coefficient[0].data() + row, *ay = fluid.face_coefficient[1].data() + row,
                 *az = fluid.face_coefficient[2].data() + row;
    double* __restrict qx = rate[0].data() + row;
    double* __restrict qy = rate[1].data() + row;
    double* __restrict qz = rate[2].data() + row;
#pragma omp simd
    for (int i = 1; i <= grid.nx + 1; ++i) {
      const double b00 = b[i], b10 = b[i + 1], by0 = b[i + sy], by1 = b[i + 1 + sy], bz0 = b[i + sz],
                   bz1 = b[i + 1 + sz];
      const double rx = ax[i] * ((b00 * u[i] + by0 * u[i + sy]) + (bz0 * u[i + sz] + b[i + sy + sz] * u[i + sy + sz]));
      const double ry = ay[i] * ((b00 * v[i] + b10 * v[i + 1]) + (bz0 * v[i + sz] + bz1 * v[i + 1 + sz]));
      const double rz = az[i] * ((b00 * w[i] + b10 * w[i + 1]) + (by0 * w[i + sy] + by1 * w[i + 1 + sy]));
      qx[i] = mean ? 0.5 * (qx[i] + rx) : rx;
      qy[i] = mean ? 0.5 * (qy[i] + ry) : ry;
      qz[i] = mean ? 0.5 * (qz[i] + rz) : rz;
    }
  });
}

}  // namespace

void face_rates(const Fluid& fluid, const std::array<std::vector<double>, 3>& velocity,
                std::array<std::vector<double>, 3>& rate) {
  rates<false>(fluid, velocity, rate);
}

void mean_face_rates(Fluid& fluid) {
  rates<true>(fluid, fluid.next_velocity, fluid.face_rate);
}

double accelerate_nodes(Fluid& fluid, double dt) {
  const Grid& grid = fluid.grid;
  const std::ptrdiff_t sy = grid.sy, sz = grid.sz;
  const double g = fluid.setup.gravity;
  const auto [dissipated, kinetic] = row_sums<2>(grid, 1, [&](int j, int k) {
    const std::ptrdiff_t row = grid.at(0, j, k);
    const double *m = fluid.total_mass.data() + row, *p = fluid.predicted_pressure.data() + row,
                 *rho = fluid.density.data() + row;
    const double *ax = fluid.face_coefficient[0].data() + row, *ay = fluid.face_coefficient[1].data() + row,
                 *az = fluid.face_coefficient[2].data() + row;
    const double* b = fluid.node_fraction.data() + row;
    const double *u = fluid.velocity[0].data() + row, *v = fluid.velocity[1].data() + row,
                 *w = fluid.velocity[2].data() + row;
    const double *hx = fluid.force[0].data() + row, *hy = fluid.force[1].data() + row,
                 *hz = fluid.force[2].data() + row;
    double* __restrict un = fluid.next_velocity[0].data() + row;
    double* __restrict vn = fluid.next_velocity[1].data() + row;
    double* __restrict wn = fluid.next_velocity[2].data() + row;
    double* __restrict mass = fluid.node_mass.data() + row;
    const double low = 0.5 * g * grid.dz[k - 1], high = 0.5 * g * grid.dz[k];
    const auto lift = [&](std::ptrdiff_t f) { return p[f - sz] - p[f] - (low * rho[f - sz] + high * rho[f]); };
    double loss = 0, moving = 0;
#pragma omp simd reduction(+ : moving, loss)
    for (std::ptrdiff_t n = 1; n <= grid.nx + 1; ++n) {
      const std::ptrdiff_t y = n - sy, z = n - sz, yz = n - sy - sz;
      const double node = 0.125 * (((m[n] + m[n - 1]) + (m[y] + m[y - 1])) + ((m[z] + m[z - 1]) + (m[yz] + m[yz - 1])));
      const double fx = ax[n] * (p[n - 1] - p[n]) + ax[y] * (p[y - 1] - p[y]) + ax[z] * (p[z - 1] - p[z]) +
                        ax[yz] * (p[yz - 1] - p[yz]);
      const double fy = ay[n] * (p[n - sy] - p[n]) + ay[n - 1] * (p[n - 1 - sy] - p[n - 1]) +
                        ay[z] * (p[z - sy] - p[z]) + ay[z - 1] * (p[z - 1 - sy] - p[z - 1]);
      const double fz = az[n] * lift(n) + az[n - 1] * lift(n - 1) + az[y] * lift(y) + az[y - 1] * lift(y - 1);
      const double per_mass = node > 0 ? dt / (node > 0 ? node : 1.0) : 0.0;
      un[n] = u[n] + per_mass * (b[n] * fx + hx[n]);
      vn[n] = v[n] + per_mass * (b[n] * fy + hy[n]);
      wn[n] = w[n] + per_mass * (b[n] * fz + hz[n]);
      mass[n] = node;
      moving += 0.5 * node * (un[n] * un[n] + vn[n] * vn[n] + wn[n] * wn[n]);
      loss += -0.5 * (node > 0 ? dt : 0.0) * (hx[n] * (u[n] + un[n]) + hy[n] * (v[n] + vn[n]) + hz[n] * (w[n] + wn[n]));
    }
    return std::array<double, 2>{loss, moving};
  });
  fluid.account.hourglass += dissipated;
  return kinetic;
}

void work_and_volumes(Fluid& fluid, double dt) {
  const Grid& grid = fluid.grid;
  const std::ptrdiff_t sy = grid.sy, sz = grid.sz;
  const double g = fluid.setup.gravity;
  const double lifted = row_sum(grid, 0, [&](int j, int k) {
    const std::ptrdiff_t row = grid.at(0, j, k);
    const double *qx = fluid.face_rate[0].data() + row, *qy = fluid.face_rate[1].data() + row,
                 *qz = fluid.face_rate[2].data() + row;
    const double *v0 = fluid.before.volume.data() + row, *swept = fluid.volume_change.data() + row;
    const double *p = fluid.predicted_pressure.data() + row, *rho = fluid.density.data() + row;
    double* __restrict volume = fluid.sweep_volume.data() + row;
    double* __restrict rate = fluid.rate.data() + row;
    const double low = 0.5 * g * grid.dz[k - 1], high = 0.5 * g * grid.dz[k], over_dt = 1.0 / dt;
    double work = 0;
#pragma omp simd reduction(+ : work)
    for (int i = 1; i <= grid.nx; ++i) {
      const double flow = qx[i + 1] - qx[i] + qy[i + sy] - qy[i] + qz[i + sz] - qz[i];
      rate[i] = flow + swept[i] * over_dt;
      volume[i] = v0[i] + (dt * flow + swept[i]);
      work += qz[i] * (low * rho[i - sz] + high * rho[i]);
    }
    if (k == grid.nz) {
      for (int i = 1; i <= grid.nx; ++i) work += qz[i + sz] * (0.5 * g * grid.dz[k] * rho[i]);
    }
    const int materials = fluid.row_materials[static_cast<std::size_t>(j + (grid.ny + 3) * k)];
    if (materials != 3) {
      Material& own = fluid.material[materials == 2 ? 1 : 0];
      const double* m = own.mass.data() + row;
      double* __restrict e = own.energy.data() + row;
      double* __restrict held = own.volume.data() + row;
      for (int i = 1; i <= grid.nx; ++i) {
        e[i] -= m[i] > 0 ? dt * p[i] * rate[i] : 0.0;
        held[i] = m[i] > 0 ? volume[i] : 0.0;
      }
      return work;
    }
    for (int i = 1; i <= grid.nx; ++i) {
      const std::ptrdiff_t c = row + i;
      const double change = volume[i] - v0[i];
      Mixture mixture;
      for (int m = 0; m < 2; ++m) {
        mixture.mass[m] = fluid.material[m].mass[c];
        mixture.energy[m] = fluid.material[m].energy[c];
        mixture.volume[m] = fluid.material[m].volume[c];
      }
      const std::array<double, 2> share = volume_shares(fluid.setup.law, fluid.setup.pressure_floor, mixture, change);
      for (int m = 0; m < 2; ++m) {
        fluid.material[m].energy[c] -= p[i] * change * share[m];
        fluid.material[m].volume[c] += change * share[m];
      }
    }
    return work;
  });
  fluid.account.gravity += dt * lifted;
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
