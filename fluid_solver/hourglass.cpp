// Viscosity against hourglass modes: the part of a full cell's eight corner velocities that no linear field can be. It
// scales with density times (0.002 c + 0.1 |u|): with density times c it would inflate the added mass (OVERLAP).
#include <algorithm>

#include "fluid_solver/phases.hpp"

namespace polynya::fluid {
namespace {

/// One component in a row of cells: the force on the corners along the four edges in x, lower ends in `lower` (4 rows of
/// `width`, by y + 2 z), upper ends in `upper`. The part that no linear field can be: with sums s and differences d along
/// x, d less its mean over the four edges, and of s what alternates in y and z.
void edge_forces(const double* __restrict u, const double* __restrict coefficient, int count, std::ptrdiff_t sy, std::ptrdiff_t sz,
                 std::ptrdiff_t width, double* __restrict lower, double* __restrict upper) {
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

void row_force(Fluid& fluid, int j, int k, std::vector<double>& scratch) {
  const Grid& grid = fluid.grid;
  const std::ptrdiff_t row = grid.at(0, j, k), sy = grid.sy, sz = grid.sz, width = grid.nx + 2;
  double *lower = scratch.data(), *upper = scratch.data() + 4 * width;  // ends of rows stay 0
  for (int axis = 0; axis < 3; ++axis) {
    edge_forces(fluid.velocity[axis].data() + row, fluid.viscosity.data() + row, grid.nx, sy, sz, width, lower, upper);
    for (int edge = 0; edge < 4; ++edge) {
      double* __restrict force = fluid.force[axis].data() + row + (edge & 1 ? sy : 0) + (edge & 2 ? sz : 0);
      const double *low = lower + edge * width, *up = upper + edge * width;
      for (int i = 1; i <= grid.nx + 1; ++i) force[i] += low[i] + up[i - 1];
    }
  }
}

}  // namespace

void hourglass_force(Fluid& fluid) {
  const Grid& grid = fluid.grid;
  for (auto& force : fluid.force) {
    double* f = force.data();
    compute::for_chunks(force.size(), 1 << 15, [&](std::size_t begin, std::size_t end) { std::fill(f + begin, f + end, 0.0); });
  }
  // Layers of cells write to the layers of nodes below and above: every other layer first, then those between.
  for (int colour = 0; colour < 2; ++colour) {
    const std::size_t layers = static_cast<std::size_t>((grid.nz + 1 - colour) / 2);
    compute::for_chunks(layers, 1, [&](std::size_t begin, std::size_t end) {
      std::vector<double> scratch(8 * (static_cast<std::size_t>(grid.nx) + 2), 0.0);
      for (std::size_t layer = begin; layer < end; ++layer) {
        for (int j = 1; j <= grid.ny; ++j) row_force(fluid, j, 1 + colour + 2 * static_cast<int>(layer), scratch);
      }
    });
  }
}

}  // namespace polynya::fluid
