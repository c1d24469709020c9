// Viscosity against hourglass modes: the part of a full cell's eight corner velocities that no linear field can be. It
// scales with density times (0.002 c + 0.1 |u|): with density times c it would inflate the added mass (OVERLAP).
#include <algorithm>

#include "fluid_solver/phases.hpp"

namespace polynya::fluid {
namespace {

/// One component in a row of cells: the force on the corners along the four edges in x, lower ends in `lower` (4 rows
/// of `width`, by y + 2 z), upper ends in `upper`. The part that no linear field can be: with sums s and differences d
/// along x, d less its mean over the four edges, and of s what alternates in y and z.
void edge_forces(const double* __restrict u, const double* __restrict coefficient, int count, std::ptrdiff_t sy,
                 std::ptrdiff_t sz, std::ptrdiff_t width, double* __restrict lower, double* __restrict upper) {
#pragma omp simd
  for (int i = 1; i <= count; ++i) {
    const double s0 = u[i] + u[i + 1], d0 = u[i] - u[i + 1];
    const double s1 = u[i + sy] + u[i + sy + 1], d1 = u[i + sy] - u[i + sy + 1];
    const double s2 = u[i + sz] + u[i + sz + 1], d2 = u[i + sz] - u[i + sz + 1];
    const double s3 = u[i + sy + sz] + u[i + sy + sz + 1], d3 = u[i + sy + sz] - u[i + sy + sz + 1];
    const double half = -0.5 * coefficient[i];
    const double twist = half * 0.25 * ((s0 - s1) - (s2 - s3)), mean = 0.25 * ((d0 + d1) + (d2 + d3));
    const double e0 = half * (d0 - mean), e1 = half * (d1 - mean), e2 = half * (d2 - mean), e3 = half * (d3 - mean);
    lower[i] = twist + e0;
    upper[i] = twist - e0;
    lower[i + width] = e1 - twist;
    upper[i + width] = -e1 - twist;
    lower[i + 2 * width] = e2 - twist;
    upper[i + 2 * width] = -e2 - twist;
    lower[i + 3 * width] = twist + e3;
    upper[i + 3 * width] = twist - e3;
  }
}

/// Forces of one layer of cells on the nodes of the layers below and above it. A layer of nodes that another layer of
/// cells has reached before is added to, else written.
void layer_force(Fluid& fluid, int k, bool add_below, bool add_above) {
  const Grid& grid = fluid.grid;
  const std::ptrdiff_t sy = grid.sy, sz = grid.sz, width = grid.nx + 2;
  thread_local std::vector<double> scratch;  // two rows of cells, each with lower and upper ends; ends of rows stay 0
  for (int axis = 0; axis < 3; ++axis) {
    scratch.assign(16 * static_cast<std::size_t>(width), 0.0);
    const auto lower_of = [&](int j) { return scratch.data() + 8 * width * (j % 2); };
    for (int j = 1; j <= grid.ny + 1; ++j) {
      const std::ptrdiff_t row = grid.at(0, j, k);
      double *lower = lower_of(j), *upper = lower + 4 * width;
      if (j <= grid.ny)
        edge_forces(fluid.velocity[axis].data() + row, fluid.viscosity.data() + row, grid.nx, sy, sz, width, lower,
                    upper);
      else
        std::fill_n(lower, 8 * width, 0.0);
      const double *low = lower_of(j - 1) + width, *up = low + 4 * width;  // the edges at higher y of the row before
      for (int above = 0; above < 2; ++above) {
        double* __restrict force = fluid.force[axis].data() + row + above * sz;
        const double *l = lower + 2 * above * width, *u = upper + 2 * above * width, *lb = low + 2 * above * width,
                     *ub = up + 2 * above * width;
        if (above ? add_above : add_below) {
          for (int i = 1; i <= grid.nx + 1; ++i) force[i] += (l[i] + u[i - 1]) + (lb[i] + ub[i - 1]);
        } else {
          for (int i = 1; i <= grid.nx + 1; ++i) force[i] = (l[i] + u[i - 1]) + (lb[i] + ub[i - 1]);
        }
      }
    }
  }
}

}  // namespace

void hourglass_force(Fluid& fluid) {
  // Layers of cells write to the layers of nodes below and above: every other layer first, then those between.
  const int nz = fluid.grid.nz;
  for (int colour = 0; colour < 2; ++colour) {
    const std::size_t layers = static_cast<std::size_t>((nz + 1 - colour) / 2);
    compute::for_chunks(layers, 1, [&](std::size_t layer, std::size_t) {
      const int k = 1 + colour + 2 * static_cast<int>(layer);
      layer_force(fluid, k, colour == 1, colour == 1 && k < nz);
    });
  }
}

}  // namespace polynya::fluid
