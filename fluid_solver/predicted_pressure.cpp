// The pressure of a step: that of the middle of the step, and shock viscosity. Both have a part that damps what the
// grid does not resolve and would spoil what it does. That part feels only the strain by which a cell differs from what
// its neighbours along each axis let expect (Christensen 1990; Benson 1992, section 2.4): none in smooth flow, all of
// it at the scale of the grid and beside solids. The quadratic part of the shock viscosity (von Neumann & Richtmyer
// 1950) is of second order in the cell itself and feels the whole compression: limited, it would be too weak in the
// middle of a shock that forms.
#include <algorithm>
#include <cmath>

#include "fluid_solver/phases.hpp"
#include "fluid_solver/prediction.hpp"
#include "fluid_solver/row_geometry.hpp"

namespace polynya::fluid {
namespace {

constexpr double least_linear_viscosity = 0.06;   ///< of the reference
constexpr double limited_linear_viscosity = 0.2;  ///< where the strain is not smooth
constexpr double excess_prediction = whole_cell_prediction - 0.5;

/// The part of a strain that those of the two neighbours do not explain; has the sign of the strain.
inline double unexplained(double before, double own, double after) {
  const double sign = own < 0 ? -1.0 : 1.0, a = sign * before, b = sign * own, c = sign * after;
  const double smooth = std::min(std::min(0.5 * (a + c), b), 2.0 * std::min(a, c));
  return sign * (b - std::max(smooth, 0.0));
}

/// Widths over those of the neighbours, which turn rates of volume into strains up to a common factor.
struct WidthRatios {
  std::vector<double> before, after;
  explicit WidthRatios(const std::vector<double>& width) : before(width.size(), 1.0), after(width.size(), 1.0) {
    for (std::size_t i = 1; i + 1 < width.size(); ++i) {
      before[i] = width[i] / width[i - 1];
      after[i] = width[i] / width[i + 1];
    }
  }
};

/// What all rows share.
struct Step {
  double dt, excess;  ///< s; linear viscosity beyond the least
  WidthRatios x, y, z;
};

/// Flow out of a row of cells along each axis, and along y and z out of the rows before and after it.
struct RowFlow {
  const double *x, *y_before, *y, *y_after, *z_before, *z, *z_after;
};

template <bool touched>
void predict_row(Fluid& fluid, const Step& step, int j, int k, Span cells, const RowFlow& flow) {
  const Grid& grid = fluid.grid;
  const std::ptrdiff_t sy = grid.sy, sz = grid.sz, row = grid.at(0, j, k);
  const double *v0 = fluid.before.volume.data() + row, *v1 = fluid.after.volume.data() + row;
  const double* change = fluid.volume_change.data() + row;
  const double *p = fluid.pressure.data() + row, *bulk = fluid.bulk_modulus.data() + row;
  const double *rho = fluid.density.data() + row, *sound = fluid.sound_speed.data() + row;
  const double *m0 = fluid.material[0].mass.data() + row, *m1 = fluid.material[1].mass.data() + row;
  const double *u = fluid.velocity[0].data() + row, *v = fluid.velocity[1].data() + row,
               *w = fluid.velocity[2].data() + row;
  const double* plane_x = fluid.motion.speed[0].data();
  const double plane_y = fluid.motion.speed[1][static_cast<std::size_t>(j)],
               plane_z = fluid.motion.speed[2][static_cast<std::size_t>(k)];
  const double* b = fluid.node_fraction.data() + row;
  double* rate = fluid.rate.data() + row;
  double* out = fluid.predicted_pressure.data() + row;
  double* viscosity = fluid.viscosity.data() + row;
  const double thickness = std::min(grid.dy[j], grid.dz[k]), area = grid.dy[j] * grid.dz[k], dt = step.dt,
               over_dt = 1.0 / dt, excess = step.excess;
  const double floor0 = fluid.setup.pressure_floor[0], floor1 = fluid.setup.pressure_floor[1];
  const double *dx = grid.dx.data(), *x_before = step.x.before.data(), *x_after = step.x.after.data();
  const double y_before = step.y.before[j], y_after = step.y.after[j], z_before = step.z.before[k],
               z_after = step.z.after[k];
  const bool limits = fluid.setup.shock_viscosity == ShockViscosity::limited;
#pragma omp simd
  for (int i = cells.first; i <= cells.last; ++i) {
    const double ex = flow.x[i], ey = flow.y[i], ez = flow.z[i];
    const double x = unexplained(flow.x[i - 1] * x_before[i], ex, flow.x[i + 1] * x_after[i]);
    const double y = unexplained(flow.y_before[i] * y_before, ey, flow.y_after[i] * y_after);
    const double z = unexplained(flow.z_before[i] * z_before, ez, flow.z_after[i] * z_after);
    const double full = dx[i] * area;
    double r = ex + ey + ez, volume = full;
    bool whole = true, limited = limits;
    if (touched) {
      r += change[i] * over_dt;
      rate[i] = r;
      volume = v0[i];
      whole = std::min(v0[i], v1[i]) >= 0.999999 * full;
      // Nodes that solids cut are light: the reference's small coefficient suits them, a large one would shake them.
      const double open =
          std::min(std::min(std::min(b[i], b[i + 1]), std::min(b[i + sy], b[i + sy + 1])),
                   std::min(std::min(b[i + sz], b[i + sz + 1]), std::min(b[i + sy + sz], b[i + sy + sz + 1])));
      limited = limits && open > 0.999999;
    }
    const double per_volume = 1.0 / (volume > 0 ? volume : 1.0), strain = r * per_volume,
                 length = std::min(dx[i], thickness);
    const double rough = limited ? ((x + y) + z) * per_volume : strain;
    const double closing_part =
        limited ? -((std::min(x, 0.0) + std::min(y, 0.0)) + std::min(z, 0.0)) * per_volume : -strain;
    const double closing = std::max(-strain, 0.0), closing_rough = std::min(closing, std::max(closing_part, 0.0));
    const double q = rho[i] * length *
                     (closing * (quadratic_viscosity * length * closing + excess * sound[i]) +
                      closing_rough * (limited ? limited_linear_viscosity : least_linear_viscosity) * sound[i]);
    const double floor = std::max(m0[i] > 0 ? floor0 : -1e300, m1[i] > 0 ? floor1 : -1e300);
    const double ahead = std::max(p[i] - bulk[i] * dt * (0.5 * strain + excess_prediction * rough), floor) + q;
    out[i] = volume > 0 ? ahead : 0.0;
    const double along_x = u[i] - plane_x[i], along_y = v[i] - plane_y, along_z = w[i] - plane_z;
    const double speed = std::sqrt(along_x * along_x + along_y * along_y + along_z * along_z);
    const double coefficient = rho[i] * (0.002 * sound[i] + 0.1 * speed) * length * length;
    viscosity[i] = whole ? coefficient : 0.0;
  }
}

/// Layer by layer through a block of cells. Flows through faces are made from the velocities and kept for as long as a
/// neighbour needs them: along z three layers, along y three rows. Beyond the grid the strain repeats.
class March {
 public:
  March(Fluid& fluid, const Step& step, const Block& block)
      : fluid_(fluid),
        grid_(fluid.grid),
        step_(step),
        block_(block),
        width_(static_cast<std::size_t>(grid_.nx) + 3),
        rows_(static_cast<std::size_t>(block.last_j - block.first_j + 1)),
        storage_(scratch()) {
    storage_.resize(width_ * (4 * rows_ + 7));
  }

  void run() {
    const int first = block_.first_k, last = block_.last_k;
    const int below = std::max(first - 1, 1);
    for (int j = block_.first_j; j <= block_.last_j; ++j) through_z(j, below, face_z(j));
    for (int k = below; k <= first; ++k) leave_z(k);
    for (int k = first; k <= last; ++k) {
      if (k < grid_.nz) leave_z(k + 1);
      layer(k);
    }
  }

 private:
  static std::vector<double>& scratch() {
    thread_local std::vector<double> kept;
    return kept;
  }
  double* at(std::size_t place) { return storage_.data() + width_ * place; }
  double* face_z(int j) { return at(static_cast<std::size_t>(j - block_.first_j)); }
  /// Flow out of row (j, k) along z; beyond the grid that of the outermost layer.
  double* out_z(int j, int k) {
    const std::size_t layer = static_cast<std::size_t>(std::clamp(k, 1, grid_.nz) % 3) + 1;
    return at(layer * rows_ + static_cast<std::size_t>(j - block_.first_j));
  }
  double* out_y(int j) { return at(4 * rows_ + static_cast<std::size_t>(std::clamp(j, 1, grid_.ny) % 3)); }
  double* face_y(int j) { return at(4 * rows_ + 3 + static_cast<std::size_t>(j % 2)); }
  double* out_x() { return at(4 * rows_ + 5); }
  double* face_x() { return at(4 * rows_ + 6); }

  void through_z(int j, int k, double* out) {
    const double* w = fluid_.velocity[2].data() + grid_.at(0, j, k);
    const std::ptrdiff_t sy = grid_.sy;
    with_row(fluid_, j, k, [&](auto row) {
#pragma omp simd
      for (int i = block_.along.first; i <= block_.along.last; ++i) out[i] = flow_z(row, w, i, sy);
    });
    set_wall_flow(fluid_, 2, j, k, out);
  }
  void through_y(int j, int k, double* out) {
    const double* v = fluid_.velocity[1].data() + grid_.at(0, j, k);
    const std::ptrdiff_t sz = grid_.sz;
    with_row(fluid_, j, k, [&](auto row) {
#pragma omp simd
      for (int i = block_.along.first; i <= block_.along.last; ++i) out[i] = flow_y(row, v, i, sz);
    });
    set_wall_flow(fluid_, 1, j, k, out);
  }
  /// Flow out of the layer k along z; the lower faces are there from the layer before.
  void leave_z(int k) {
    for (int j = block_.first_j; j <= block_.last_j; ++j) {
      double *lower = face_z(j), *out = out_z(j, k), *upper = face_x();
      through_z(j, k + 1, upper);
#pragma omp simd
      for (int i = block_.along.first; i <= block_.along.last; ++i) {
        out[i] = upper[i] - lower[i];
        lower[i] = upper[i];
      }
    }
  }
  void leave_y(int j, int k) {
    const double* lower = face_y(j);
    double *out = out_y(j), *upper = face_y(j + 1);
    through_y(j + 1, k, upper);
#pragma omp simd
    for (int i = block_.along.first; i <= block_.along.last; ++i) out[i] = upper[i] - lower[i];
  }
  void leave_x(int j, int k) {
    const double* u = fluid_.velocity[0].data() + grid_.at(0, j, k);
    double *face = face_x(), *out = out_x();
    const std::ptrdiff_t sy = grid_.sy, sz = grid_.sz;
    const int first = std::max(block_.along.first - 1, 1), last = std::min(block_.along.last + 1, grid_.nx);
    with_row(fluid_, j, k, [&](auto row) {
#pragma omp simd
      for (int i = first; i <= last + 1; ++i) face[i] = flow_x(row, u, i, sy, sz);
    });
    set_wall_flow(fluid_, 0, j, k, face);
#pragma omp simd
    for (int i = first; i <= last; ++i) out[i] = face[i + 1] - face[i];
    out[0] = out[1];
    out[grid_.nx + 1] = out[grid_.nx];
  }

  void layer(int k) {
    const int before = std::max(block_.first_j - 1, 1);
    through_y(before, k, face_y(before));
    for (int j = before; j <= block_.first_j; ++j) leave_y(j, k);
    for (int j = block_.first_j; j <= block_.last_j; ++j) {
      if (j < grid_.ny) leave_y(j + 1, k);
      leave_x(j, k);
      const RowFlow flow{out_x(), out_y(j - 1), out_y(j), out_y(j + 1), out_z(j, k - 1), out_z(j, k), out_z(j, k + 1)};
      untouched(fluid_, j, k) ? predict_row<false>(fluid_, step_, j, k, block_.along, flow)
                              : predict_row<true>(fluid_, step_, j, k, block_.along, flow);
    }
  }

  Fluid& fluid_;
  const Grid& grid_;
  const Step& step_;
  Block block_;
  std::size_t width_, rows_;
  std::vector<double>& storage_;
};

}  // namespace

double linear_viscosity(const Fluid& fluid) {
  return least_linear_viscosity + fluid.start_damping.excess * std::exp(-fluid.time / fluid.start_damping.decay);
}

void predict_pressure(Fluid& fluid, double dt) {
  const Grid& grid = fluid.grid;
  const double linear = linear_viscosity(fluid);
  const Step step{dt, linear - least_linear_viscosity, WidthRatios(grid.dx), WidthRatios(grid.dy),
                  WidthRatios(grid.dz)};
  for_blocks(fluid.sleeping.cell_blocks, [&](std::size_t, const Block& block) { March(fluid, step, block).run(); });
}

}  // namespace polynya::fluid
