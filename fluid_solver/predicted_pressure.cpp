// The pressure of a step: that of the middle of the step, and shock viscosity. Both have a part that damps what the
// grid does not resolve and would spoil what it does. That part feels only the strain by which a cell differs from what
// its neighbours along each axis let expect (Christensen 1990; Benson 1992, section 2.4): none in smooth flow, all of
// it at the scale of the grid and beside solids.
#include <algorithm>
#include <cmath>

#include "fluid_solver/phases.hpp"

namespace polynya::fluid {
namespace {

constexpr double least_linear_viscosity = 0.06, quadratic_viscosity = 1.5;  ///< of the reference
constexpr double limited_linear_viscosity = 0.2;                            ///< where the strain is not smooth
constexpr double excess_prediction = 0.35;                                  ///< theta less a half

/// The part of a strain that those of the two neighbours do not explain; has the sign of the strain.
inline double unexplained(double before, double own, double after) {
  const double sign = own < 0 ? -1.0 : 1.0, a = sign * before, b = sign * own, c = sign * after;
  const double smooth = std::min(std::min(0.5 * (a + c), b), 2.0 * std::min(a, c));
  return sign * (b - std::max(smooth, 0.0));
}

/// Strains of ghost cells are those of the cells beside them.
void extend_rates(Fluid& fluid) {
  const Grid& grid = fluid.grid;
  const auto extend = [&](int axis, std::ptrdiff_t first, int n) {
    const std::ptrdiff_t s = grid.stride(axis);
    double* q = fluid.face_rate[axis].data() + first;
    q[0] = 2 * q[s] - q[2 * s];
    q[(n + 2) * s] = 2 * q[(n + 1) * s] - q[n * s];
  };
  for (int k = 1; k <= grid.nz; ++k) {
    for (int j = 1; j <= grid.ny; ++j) extend(0, grid.at(0, j, k), grid.nx);
    for (int i = 1; i <= grid.nx; ++i) extend(1, grid.at(i, 0, k), grid.ny);
  }
  for (int j = 1; j <= grid.ny; ++j) {
    for (int i = 1; i <= grid.nx; ++i) extend(2, grid.at(i, j, 0), grid.nz);
  }
}

}  // namespace

double linear_viscosity(const Fluid& fluid) {
  return least_linear_viscosity + fluid.start_damping.excess * std::exp(-fluid.time / fluid.start_damping.decay);
}

void predict_pressure(Fluid& fluid, double dt) {
  extend_rates(fluid);
  const Grid& grid = fluid.grid;
  const std::ptrdiff_t sy = grid.sy, sz = grid.sz;
  const double over_dt = 1.0 / dt, linear = linear_viscosity(fluid), excess = linear - least_linear_viscosity;
  for_rows(grid, 0, [&](int j, int k) {
    const std::ptrdiff_t row = grid.at(0, j, k);
    const double *qx = fluid.face_rate[0].data() + row, *qy = fluid.face_rate[1].data() + row,
                 *qz = fluid.face_rate[2].data() + row;
    const double *v0 = fluid.before.volume.data() + row, *v1 = fluid.after.volume.data() + row;
    const double* change = fluid.volume_change.data() + row;
    const double *p = fluid.pressure.data() + row, *bulk = fluid.bulk_modulus.data() + row;
    const double *rho = fluid.density.data() + row, *sound = fluid.sound_speed.data() + row;
    const double *m0 = fluid.material[0].mass.data() + row, *m1 = fluid.material[1].mass.data() + row;
    const double *u = fluid.velocity[0].data() + row, *v = fluid.velocity[1].data() + row,
                 *w = fluid.velocity[2].data() + row;
    const double* b = fluid.node_fraction.data() + row;
    double* __restrict rate = fluid.rate.data() + row;
    double* __restrict out = fluid.predicted_pressure.data() + row;
    double* __restrict viscosity = fluid.viscosity.data() + row;
    const double thickness = std::min(grid.dy[j], grid.dz[k]), area = grid.dy[j] * grid.dz[k];
    const double floor0 = fluid.setup.pressure_floor[0], floor1 = fluid.setup.pressure_floor[1];
    const double* dx = grid.dx.data();
    // Widths over those of the neighbours, which turn rates of volume into strains up to a common factor.
    const double y_before = grid.dy[j] / grid.dy[j - 1], y_after = grid.dy[j] / grid.dy[j + 1];
    const double z_before = grid.dz[k] / grid.dz[k - 1], z_after = grid.dz[k] / grid.dz[k + 1];
    const bool limits = fluid.setup.shock_viscosity == ShockViscosity::limited;
#pragma omp simd
    for (int i = 1; i <= grid.nx; ++i) {
      const double ex = qx[i + 1] - qx[i], ey = qy[i + sy] - qy[i], ez = qz[i + sz] - qz[i];
      const double r = (ex + ey + ez) + change[i] * over_dt;
      rate[i] = r;
      const double x =
          unexplained((qx[i] - qx[i - 1]) * (dx[i] / dx[i - 1]), ex, (qx[i + 2] - qx[i + 1]) * (dx[i] / dx[i + 1]));
      const double y = unexplained((qy[i] - qy[i - sy]) * y_before, ey, (qy[i + 2 * sy] - qy[i + sy]) * y_after);
      const double z = unexplained((qz[i] - qz[i - sz]) * z_before, ez, (qz[i + 2 * sz] - qz[i + sz]) * z_after);
      const double full = 0.999999 * dx[i] * area;
      const bool whole = std::min(v0[i], v1[i]) >= full;
      // Nodes that solids cut are light: the reference's small coefficient suits them, a large one would shake them.
      const double open =
          std::min(std::min(std::min(b[i], b[i + 1]), std::min(b[i + sy], b[i + sy + 1])),
                   std::min(std::min(b[i + sz], b[i + sz + 1]), std::min(b[i + sy + sz], b[i + sy + sz + 1])));
      const bool limited = limits && open > 0.999999;
      const double per_volume = 1.0 / (v0[i] > 0 ? v0[i] : 1.0), strain = r * per_volume,
                   length = std::min(dx[i], thickness);
      const double rough = limited ? ((x + y) + z) * per_volume : strain;
      const double closing_part =
          limited ? -((std::min(x, 0.0) + std::min(y, 0.0)) + std::min(z, 0.0)) * per_volume : -strain;
      const double closing = std::max(-strain, 0.0), closing_rough = std::min(closing, std::max(closing_part, 0.0));
      const double q = rho[i] * length *
                       (closing_rough * (quadratic_viscosity * length * closing_rough +
                                         (limited ? limited_linear_viscosity : least_linear_viscosity) * sound[i]) +
                        closing * excess * sound[i]);
      const double floor = std::max(m0[i] > 0 ? floor0 : -1e300, m1[i] > 0 ? floor1 : -1e300);
      const double ahead = std::max(p[i] - bulk[i] * dt * (0.5 * strain + excess_prediction * rough), floor) + q;
      out[i] = v0[i] > 0 ? ahead : 0.0;
      const double speed = std::sqrt(u[i] * u[i] + v[i] * v[i] + w[i] * w[i]);
      const double coefficient = rho[i] * (0.002 * sound[i] + 0.1 * speed) * length * length;
      viscosity[i] = whole ? coefficient : 0.0;
    }
  });
}

}  // namespace polynya::fluid
