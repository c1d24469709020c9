// Viscosity against hourglass modes: the part of a full cell's eight corner velocities that no linear field can be. It
// scales with density times (0.002 c + 0.1 |u|): with density times c it would inflate the added mass (OVERLAP).
#include <algorithm>

#include "fluid_solver/phases.hpp"

namespace polynya::fluid {
namespace {

/// Replaces eight corner values (bit 0: x, bit 1: y, bit 2: z) by the part orthogonal to constants and linear fields.
inline void keep_hourglass(double (&u)[8]) {
  for (int bit = 1; bit < 8; bit *= 2) {
    for (int corner = 0; corner < 8; ++corner) {
      if (corner & bit) continue;
      const double a = u[corner], b = u[corner | bit];
      u[corner] = a + b;
      u[corner | bit] = a - b;
    }
  }
  u[0] = u[1] = u[2] = u[4] = 0;
  for (int bit = 1; bit < 8; bit *= 2) {
    for (int corner = 0; corner < 8; ++corner) {
      if (corner & bit) continue;
      const double a = u[corner], b = u[corner | bit];
      u[corner] = a + b;
      u[corner | bit] = a - b;
    }
  }
}

void row_force(Fluid& fluid, int j, int k, std::vector<double>& scratch) {
  const Grid& grid = fluid.grid;
  const std::ptrdiff_t row = grid.at(0, j, k), sy = grid.sy, sz = grid.sz;
  const std::size_t width = static_cast<std::size_t>(grid.nx) + 2;
  const double* coefficient = fluid.viscosity.data() + row;
  for (int axis = 0; axis < 3; ++axis) {
    const double* u = fluid.velocity[axis].data() + row;
    double* __restrict out = scratch.data();
    for (int i = 1; i <= grid.nx; ++i) {
      double corner[8] = {u[i],      u[i + 1],      u[i + sy],      u[i + 1 + sy],
                          u[i + sz], u[i + 1 + sz], u[i + sy + sz], u[i + 1 + sy + sz]};
      keep_hourglass(corner);
      const double scale = -0.125 * coefficient[i];
      for (int n = 0; n < 8; ++n) out[width * n + i] = scale * corner[n];
    }
    double* __restrict force = fluid.force[axis].data() + row;
    for (int n = 0; n < 8; ++n) {
      const std::ptrdiff_t to = (n & 1) + (n & 2 ? sy : 0) + (n & 4 ? sz : 0);
      for (int i = 1; i <= grid.nx; ++i) force[i + to] += out[width * n + i];
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
      std::vector<double> scratch(8 * (static_cast<std::size_t>(grid.nx) + 2));
      for (std::size_t layer = begin; layer < end; ++layer) {
        for (int j = 1; j <= grid.ny; ++j) row_force(fluid, j, 1 + colour + 2 * static_cast<int>(layer), scratch);
      }
    });
  }
}

}  // namespace polynya::fluid
