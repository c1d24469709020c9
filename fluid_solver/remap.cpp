// Remap of cells: what flowed through each face during the Lagrange phase carries the donor's state to the other side.
#include <algorithm>

#include "fluid_solver/phases.hpp"

namespace polynya::fluid {
namespace {

constexpr double smoothing = 0.05;  ///< of alternating pressures, in units of sound speed times density

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

/// Pressures that alternate from cell to cell push no node, so nothing in the Lagrange phase would ever even them out.
/// A little water moves, at constant volume, from the high to the low of that pattern only: the difference across a face
/// less its (1,2,1)x(1,2,1) mean. Fields that vary along one axis alone, hydrostatic pressure and plane waves too, do not
/// feel it. Faces whose surroundings are cut are left out. (After Rhie & Chow 1983.)
void row_smoothing(Fluid& fluid, double dt, int axis, int j, int k) {
  const Grid& grid = fluid.grid;
  const std::ptrdiff_t row = grid.at(0, j, k), s = grid.stride(axis);
  const std::ptrdiff_t t1 = grid.stride((axis + 1) % 3), t2 = grid.stride((axis + 2) % 3);
  const double *p = fluid.pressure.data() + row, *sound = fluid.sound_speed.data() + row, *b = fluid.node_fraction.data() + row;
  const double area_by_dx = axis == 0 ? 0 : axis == 1 ? grid.dz[k] : grid.dy[j], area_x = axis == 0 ? grid.dy[j] * grid.dz[k] : 0.0;
  double* __restrict face_mass = fluid.face_mass[axis].data() + row;
  for (std::ptrdiff_t i = axis == 0 ? 2 : 1; i <= grid.nx; ++i) {
    const auto jump = [&](std::ptrdiff_t c) { return p[c] - p[c - s]; };
    const auto band = [&](std::ptrdiff_t c) { return 0.25 * (jump(c - t1) + jump(c + t1)) + 0.5 * jump(c); };
    const double mean = 0.25 * (band(i - t2) + band(i + t2)) + 0.5 * band(i);
    const double whole = std::min(std::min(b[i], b[i + t1]), std::min(b[i + t2], b[i + t1 + t2]));
    const double rate = whole >= 1.0 ? smoothing * dt / std::max(sound[i], 1.0) : 0.0;
    face_mass[i] -= rate * (area_x + area_by_dx * grid.dx[i]) * (jump(i) - mean);
  }
}

/// Materials in a row of cells and the four rows beside it, and what may flow in at its ends: bit 1 water, bit 2 air.
int materials_near(const Fluid& fluid, int j, int k) {
  const std::ptrdiff_t width = fluid.grid.ny + 3;
  const unsigned char* held = fluid.row_materials.data() + j + width * k;
  const Ambient& outside = fluid.ambient[static_cast<std::size_t>(k)];
  return held[0] | held[-1] | held[1] | held[-width] | held[width] | (outside.density[0] > 0 ? 1 : 0) | (outside.density[1] > 0 ? 2 : 0);
}

/// Smooths the faces of a row towards its lower neighbours where both rows see water only.
void smooth_row(Fluid& fluid, double dt, int j, int k) {
  const Grid& grid = fluid.grid;
  if (j > grid.ny || k > grid.nz || materials_near(fluid, j, k) != 1) return;
  row_smoothing(fluid, dt, 0, j, k);
  if (j > 1 && materials_near(fluid, j - 1, k) == 1) row_smoothing(fluid, dt, 1, j, k);
  if (k > 1 && materials_near(fluid, j, k - 1) == 1) row_smoothing(fluid, dt, 2, j, k);
}

}  // namespace

void remap_cells(Fluid& fluid, double dt) {
  const Grid& grid = fluid.grid;
  mirror_pressure(fluid);
  for_rows(grid, 1, [&](int j, int k) {
    row_face_mass(fluid, dt, j, k);
    smooth_row(fluid, dt, j, k);
  });
  for_rows(grid, 0, [&](int j, int k) {
    const int near = materials_near(fluid, j, k);
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
