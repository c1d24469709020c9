// Remap of cells: what flowed through each face during the Lagrange phase carries the donor's state to the other side.
#include <algorithm>

#include "fluid_solver/phases.hpp"

namespace polynya::fluid {
namespace {

inline double carried(double volume, double lower, double upper) {
  return std::max(volume, 0.0) * lower + std::min(volume, 0.0) * upper;
}

void row_face_mass(Fluid& fluid, double dt, int j, int k) {
  const Grid& grid = fluid.grid;
  const std::ptrdiff_t row = grid.at(0, j, k), sy = grid.sy, sz = grid.sz;
  const double* d = fluid.donor_mass.data() + row;
  const double *qx = fluid.face_rate[0].data() + row, *qy = fluid.face_rate[1].data() + row, *qz = fluid.face_rate[2].data() + row;
  double* __restrict fx = fluid.face_mass[0].data() + row;
  double* __restrict fy = fluid.face_mass[1].data() + row;
  double* __restrict fz = fluid.face_mass[2].data() + row;
  for (std::ptrdiff_t i = 1; i <= grid.nx + 1; ++i) {
    fx[i] = carried(dt * qx[i], d[i - 1], d[i]);
    fy[i] = carried(dt * qy[i], d[i - sy], d[i]);
    fz[i] = carried(dt * qz[i], d[i - sz], d[i]);
  }
}

void row_update(Fluid& fluid, double dt, int j, int k, const std::vector<double>& donor, std::vector<double>& content) {
  const Grid& grid = fluid.grid;
  const std::ptrdiff_t row = grid.at(0, j, k), sy = grid.sy, sz = grid.sz;
  const double* d = donor.data() + row;
  const double *qx = fluid.face_rate[0].data() + row, *qy = fluid.face_rate[1].data() + row, *qz = fluid.face_rate[2].data() + row;
  double* __restrict out = content.data() + row;
  for (std::ptrdiff_t i = 1; i <= grid.nx; ++i) {
    out[i] += (carried(dt * qx[i], d[i - 1], d[i]) - carried(dt * qx[i + 1], d[i], d[i + 1])) +
              (carried(dt * qy[i], d[i - sy], d[i]) - carried(dt * qy[i + sy], d[i], d[i + sy])) +
              (carried(dt * qz[i], d[i - sz], d[i]) - carried(dt * qz[i + sz], d[i], d[i + sz]));
  }
}

void row_update_by_face_mass(Fluid& fluid, int j, int k, std::vector<double>& mass) {
  const Grid& grid = fluid.grid;
  const std::ptrdiff_t row = grid.at(0, j, k), sy = grid.sy, sz = grid.sz;
  const double *fx = fluid.face_mass[0].data() + row, *fy = fluid.face_mass[1].data() + row, *fz = fluid.face_mass[2].data() + row;
  double* __restrict out = mass.data() + row;
  for (std::ptrdiff_t i = 1; i <= grid.nx; ++i) {
    out[i] += (fx[i] - fx[i + 1]) + (fy[i] - fy[i + sy]) + (fz[i] - fz[i + sz]);
  }
}

}  // namespace

void remap_cells(Fluid& fluid, double dt) {
  const Grid& grid = fluid.grid;
  for_rows(grid, 1, [&](int j, int k) { row_face_mass(fluid, dt, j, k); });
  const std::ptrdiff_t width = grid.ny + 3;
  for_rows(grid, 0, [&](int j, int k) {
    const unsigned char* held = fluid.row_materials.data() + j + width * k;
    const Ambient& outside = fluid.ambient[static_cast<std::size_t>(k)];
    const int near = held[0] | held[-1] | held[1] | held[-width] | held[width] | (outside.density[0] > 0 ? 1 : 0) |
                     (outside.density[1] > 0 ? 2 : 0);
    if (near == 3) {
      for (int m = 0; m < 2; ++m) {
        row_update(fluid, dt, j, k, fluid.donor[m].mass, fluid.material[m].mass);
        row_update(fluid, dt, j, k, fluid.donor[m].energy, fluid.material[m].energy);
        row_update(fluid, dt, j, k, fluid.donor[m].volume, fluid.material[m].volume);
      }
      return;
    }
    Material& only = fluid.material[near == 2 ? 1 : 0];
    row_update_by_face_mass(fluid, j, k, only.mass);
    row_update(fluid, dt, j, k, fluid.donor[near == 2 ? 1 : 0].energy, only.energy);
    // The cells of a group are the exception: their volumes were gathered at the root and are spread by mix_groups.
    row_update(fluid, dt, j, k, fluid.donor[near == 2 ? 1 : 0].volume, only.volume);
  });
}

}  // namespace polynya::fluid
