// The Lagrange phase: volume rates, predicted pressure, acceleration of nodes by the adjoint of the face average, and the
// work that goes with it, so that kinetic plus internal energy changes only by the works that are booked.
#include <algorithm>
#include <cmath>

#include "fluid_solver/phases.hpp"
#include "fluid_solver/pressure_equilibrium.hpp"

namespace polynya::fluid {
namespace {

constexpr double prediction = 0.6;         ///< share of a step the pressure is predicted ahead (theta)
constexpr double least_linear_viscosity = 0.06, quadratic_viscosity = 1.5;  ///< shock viscosity

template <bool mean>
void rates(const Fluid& fluid, const std::array<std::vector<double>, 3>& velocity, std::array<std::vector<double>, 3>& rate) {
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
    for (int i = 1; i <= grid.nx + 1; ++i) {
      const double b00 = b[i], b10 = b[i + 1], by0 = b[i + sy], by1 = b[i + 1 + sy], bz0 = b[i + sz], bz1 = b[i + 1 + sz];
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

double linear_viscosity(const Fluid& fluid) {
  return least_linear_viscosity + fluid.start_damping.excess * std::exp(-fluid.time / fluid.start_damping.decay);
}

void face_rates(const Fluid& fluid, const std::array<std::vector<double>, 3>& velocity, std::array<std::vector<double>, 3>& rate) {
  rates<false>(fluid, velocity, rate);
}

void mean_face_rates(Fluid& fluid) { rates<true>(fluid, fluid.next_velocity, fluid.face_rate); }

void predict_pressure(Fluid& fluid, double dt) {
  const Grid& grid = fluid.grid;
  const std::ptrdiff_t sy = grid.sy, sz = grid.sz;
  const double over_dt = 1.0 / dt, linear = linear_viscosity(fluid);
  for_rows(grid, 0, [&](int j, int k) {
    const std::ptrdiff_t row = grid.at(0, j, k);
    const double *qx = fluid.face_rate[0].data() + row, *qy = fluid.face_rate[1].data() + row, *qz = fluid.face_rate[2].data() + row;
    const double *v0 = fluid.before.volume.data() + row, *v1 = fluid.after.volume.data() + row;
    const double* change = fluid.volume_change.data() + row;
    const double *p = fluid.pressure.data() + row, *bulk = fluid.bulk_modulus.data() + row;
    const double *rho = fluid.density.data() + row, *sound = fluid.sound_speed.data() + row;
    const double *m0 = fluid.material[0].mass.data() + row, *m1 = fluid.material[1].mass.data() + row;
    const double *u = fluid.velocity[0].data() + row, *v = fluid.velocity[1].data() + row, *w = fluid.velocity[2].data() + row;
    double* __restrict rate = fluid.rate.data() + row;
    double* __restrict out = fluid.predicted_pressure.data() + row;
    double* __restrict viscosity = fluid.viscosity.data() + row;
    const double thickness = std::min(grid.dy[j], grid.dz[k]), area = grid.dy[j] * grid.dz[k];
    const double floor0 = fluid.setup.pressure_floor[0], floor1 = fluid.setup.pressure_floor[1];
    const double* dx = grid.dx.data();
    for (int i = 1; i <= grid.nx; ++i) {
      const double r = qx[i + 1] - qx[i] + qy[i + sy] - qy[i] + qz[i + sz] - qz[i] + change[i] * over_dt;
      rate[i] = r;
      const double strain = r / (v0[i] > 0 ? v0[i] : 1.0), length = std::min(dx[i], thickness);
      const double closing = strain < 0 ? -strain : 0.0;
      const double q = rho[i] * length * closing * (quadratic_viscosity * length * closing + linear * sound[i]);
      const double floor = std::max(m0[i] > 0 ? floor0 : -1e300, m1[i] > 0 ? floor1 : -1e300);
      const double ahead = std::max(p[i] - bulk[i] * dt * prediction * strain, floor) + q;
      out[i] = v0[i] > 0 ? ahead : 0.0;
      const double full = 0.999999 * dx[i] * area;
      const double speed = std::sqrt(u[i] * u[i] + v[i] * v[i] + w[i] * w[i]);
      const double coefficient = rho[i] * (0.002 * sound[i] + 0.1 * speed) * length * length;
      viscosity[i] = std::min(v0[i], v1[i]) >= full ? coefficient : 0.0;
    }
  });
}

void accelerate_nodes(Fluid& fluid, double dt) {
  const Grid& grid = fluid.grid;
  const std::ptrdiff_t sy = grid.sy, sz = grid.sz;
  const double g = fluid.setup.gravity;
  const double dissipated = row_sum(grid, 1, [&](int j, int k) {
    const std::ptrdiff_t row = grid.at(0, j, k);
    const double *m = fluid.total_mass.data() + row, *p = fluid.predicted_pressure.data() + row, *rho = fluid.density.data() + row;
    const double *ax = fluid.face_coefficient[0].data() + row, *ay = fluid.face_coefficient[1].data() + row,
                 *az = fluid.face_coefficient[2].data() + row;
    const double* b = fluid.node_fraction.data() + row;
    const double *u = fluid.velocity[0].data() + row, *v = fluid.velocity[1].data() + row, *w = fluid.velocity[2].data() + row;
    const double *hx = fluid.force[0].data() + row, *hy = fluid.force[1].data() + row, *hz = fluid.force[2].data() + row;
    double* __restrict un = fluid.next_velocity[0].data() + row;
    double* __restrict vn = fluid.next_velocity[1].data() + row;
    double* __restrict wn = fluid.next_velocity[2].data() + row;
    double* __restrict mass = fluid.node_mass.data() + row;
    const double low = 0.5 * g * grid.dz[k - 1], high = 0.5 * g * grid.dz[k];
    const auto lift = [&](std::ptrdiff_t f) { return p[f - sz] - p[f] - (low * rho[f - sz] + high * rho[f]); };
    double loss = 0;
    for (std::ptrdiff_t n = 1; n <= grid.nx + 1; ++n) {
      const std::ptrdiff_t y = n - sy, z = n - sz, yz = n - sy - sz;
      const double node = 0.125 * (((m[n] + m[n - 1]) + (m[y] + m[y - 1])) + ((m[z] + m[z - 1]) + (m[yz] + m[yz - 1])));
      const double fx = ax[n] * (p[n - 1] - p[n]) + ax[y] * (p[y - 1] - p[y]) + ax[z] * (p[z - 1] - p[z]) + ax[yz] * (p[yz - 1] - p[yz]);
      const double fy = ay[n] * (p[n - sy] - p[n]) + ay[n - 1] * (p[n - 1 - sy] - p[n - 1]) + ay[z] * (p[z - sy] - p[z]) +
                        ay[z - 1] * (p[z - 1 - sy] - p[z - 1]);
      const double fz = az[n] * lift(n) + az[n - 1] * lift(n - 1) + az[y] * lift(y) + az[y - 1] * lift(y - 1);
      const double per_mass = node > 0 ? dt / (node > 0 ? node : 1.0) : 0.0;
      un[n] = u[n] + per_mass * (b[n] * fx + hx[n]);
      vn[n] = v[n] + per_mass * (b[n] * fy + hy[n]);
      wn[n] = w[n] + per_mass * (b[n] * fz + hz[n]);
      mass[n] = node;
      loss -= 0.5 * (node > 0 ? dt : 0.0) * (hx[n] * (u[n] + un[n]) + hy[n] * (v[n] + vn[n]) + hz[n] * (w[n] + wn[n]));
    }
    return loss;
  });
  fluid.account.hourglass += dissipated;
}

void work_and_donors(Fluid& fluid, double dt) {
  const Grid& grid = fluid.grid;
  const std::ptrdiff_t sy = grid.sy, sz = grid.sz;
  const double g = fluid.setup.gravity;
  const double lifted = row_sum(grid, 0, [&](int j, int k) {
    const std::ptrdiff_t row = grid.at(0, j, k);
    const double *qx = fluid.face_rate[0].data() + row, *qy = fluid.face_rate[1].data() + row, *qz = fluid.face_rate[2].data() + row;
    const double *v0 = fluid.before.volume.data() + row, *swept = fluid.volume_change.data() + row;
    const double *p = fluid.predicted_pressure.data() + row, *rho = fluid.density.data() + row, *mass = fluid.total_mass.data() + row;
    double* __restrict mixture = fluid.donor_mass.data() + row;
    double* __restrict rate = fluid.rate.data() + row;
    const double low = 0.5 * g * grid.dz[k - 1], high = 0.5 * g * grid.dz[k];
    double work = 0;
    for (int i = 1; i <= grid.nx; ++i) {
      const double flow = qx[i + 1] - qx[i] + qy[i + sy] - qy[i] + qz[i + sz] - qz[i];
      rate[i] = flow + swept[i] / dt;
      const double lagrangian = v0[i] + (dt * flow + swept[i]);
      mixture[i] = lagrangian > 0 ? mass[i] / (lagrangian > 0 ? lagrangian : 1.0) : 0.0;
      work += qz[i] * (low * rho[i - sz] + high * rho[i]);
    }
    if (k == grid.nz) {
      for (int i = 1; i <= grid.nx; ++i) work += qz[i + sz] * (0.5 * g * grid.dz[k] * rho[i]);
    }
    const int held = fluid.row_materials[static_cast<std::size_t>(j + (grid.ny + 3) * k)];
    if (held != 3) {
      const int only = held == 2 ? 1 : 0;
      const double* m = fluid.material[only].mass.data() + row;
      double* __restrict e = fluid.material[only].energy.data() + row;
      double* __restrict dm = fluid.donor[only].mass.data() + row;
      double* __restrict de = fluid.donor[only].energy.data() + row;
      double* __restrict dv = fluid.donor[only].volume.data() + row;
      double* __restrict volume = fluid.material[only].volume.data() + row;
      for (int i = 1; i <= grid.nx; ++i) {
        const double lagrangian = v0[i] + dt * rate[i], inverse = lagrangian > 0 ? 1.0 / (lagrangian > 0 ? lagrangian : 1.0) : 0.0;
        e[i] -= m[i] > 0 ? dt * p[i] * rate[i] : 0.0;
        dm[i] = m[i] * inverse;
        de[i] = e[i] * inverse;
        dv[i] = m[i] > 0 ? 1.0 : 0.0;
        volume[i] = m[i] > 0 ? lagrangian : 0.0;
      }
      double* __restrict om = fluid.donor[1 - only].mass.data() + row;
      double* __restrict oe = fluid.donor[1 - only].energy.data() + row;
      double* __restrict ov = fluid.donor[1 - only].volume.data() + row;
      for (int i = 1; i <= grid.nx; ++i) om[i] = oe[i] = ov[i] = 0.0;
      return work;
    }
    for (int i = 1; i <= grid.nx; ++i) {
      const std::ptrdiff_t c = row + i;
      const double change = dt * rate[i], lagrangian = v0[i] + change;
      Mixture mixture;
      for (int m = 0; m < 2; ++m) {
        mixture.mass[m] = fluid.material[m].mass[c];
        mixture.energy[m] = fluid.material[m].energy[c];
        mixture.volume[m] = fluid.material[m].volume[c];
      }
      const std::array<double, 2> share = volume_shares(fluid.setup.law, fluid.setup.pressure_floor, mixture, change);
      for (int m = 0; m < 2; ++m) {
        Material& own = fluid.material[m];
        own.energy[c] -= p[i] * change * share[m];
        own.volume[c] += change * share[m];
        const double inverse = lagrangian > 0 ? 1.0 / lagrangian : 0.0;
        fluid.donor[m].mass[c] = own.mass[c] * inverse;
        fluid.donor[m].energy[c] = own.energy[c] * inverse;
        fluid.donor[m].volume[c] = own.volume[c] * inverse;
      }
    }
    return work;
  });
  fluid.account.gravity += dt * lifted;
}

}  // namespace polynya::fluid
