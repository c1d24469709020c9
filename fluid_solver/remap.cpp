// Remap of cells: what flowed through each face during the Lagrange phase is moved axis by axis, in turns xyz and zyx, so
// that the error of splitting cancels over two steps.
#include <algorithm>

#include "fluid_solver/sweep.hpp"
#include "fluid_solver/phases.hpp"

namespace polynya::fluid {
namespace {

constexpr double smoothing = 0.05;  ///< of alternating pressures, in units of sound speed times density

int bits(const Ambient& layer) { return (layer.density[0] > 0 ? 1 : 0) | (layer.density[1] > 0 ? 2 : 0); }

bool encloses(const std::array<Boundary, 6>& boundary, int axis) {
  return boundary[2 * axis] == Boundary::wall && boundary[2 * axis + 1] == Boundary::wall;
}

/// Materials in a row of cells and the four rows beside it.
int materials_beside(const Fluid& fluid, int j, int k) {
  const std::ptrdiff_t width = fluid.grid.ny + 3;
  const unsigned char* held = fluid.row_materials.data() + j + width * k;
  return held[0] | held[-1] | held[1] | held[-width] | held[width];
}

/// Pressures that alternate from cell to cell push no node, so nothing in the Lagrange phase would ever even them out.
/// A little water moves, at constant volume, from the high to the low of that pattern only: the difference across a face
/// less its (1,2,1)x(1,2,1) mean. Fields that vary along one axis alone, hydrostatic pressure and plane waves too, do not
/// feel it. Faces whose surroundings are cut are left out. (After Rhie & Chow 1983.)
void smooth_row(const Fluid& fluid, double dt, int axis, int j, int k, double* __restrict face_mass) {
  const Grid& grid = fluid.grid;
  const std::ptrdiff_t row = grid.at(0, j, k), s = grid.stride(axis);
  const std::ptrdiff_t t1 = grid.stride((axis + 1) % 3), t2 = grid.stride((axis + 2) % 3);
  const double *p = fluid.pressure.data() + row, *sound = fluid.sound_speed.data() + row, *b = fluid.node_fraction.data() + row;
  const double area_by_dx = axis == 0 ? 0 : axis == 1 ? grid.dz[k] : grid.dy[j], area_x = axis == 0 ? grid.dy[j] * grid.dz[k] : 0.0;
  for (std::ptrdiff_t i = axis == 0 ? 2 : 1; i <= grid.nx; ++i) {
    const auto jump = [&](std::ptrdiff_t c) { return p[c] - p[c - s]; };
    const auto band = [&](std::ptrdiff_t c) { return 0.25 * (jump(c - t1) + jump(c + t1)) + 0.5 * jump(c); };
    const double mean = 0.25 * (band(i - t2) + band(i + t2)) + 0.5 * band(i);
    const double whole = std::min(std::min(b[i], b[i + t1]), std::min(b[i + t2], b[i + t1 + t2]));
    const double rate = whole >= 1.0 ? smoothing * dt / std::max(sound[i], 1.0) : 0.0;
    face_mass[i] -= rate * (area_x + area_by_dx * grid.dx[i]) * (jump(i) - mean);
  }
}

}  // namespace

int materials_around(const Fluid& fluid, int j, int k) {
  const std::ptrdiff_t width = fluid.grid.ny + 3;
  const unsigned char* row = fluid.row_materials.data() + j + width * k;
  int held = 0;
  for (const std::ptrdiff_t layer : {-width, std::ptrdiff_t{0}, width}) held |= row[layer - 1] | row[layer] | row[layer + 1];
  const auto& boundary = fluid.setup.boundary;
  if (encloses(boundary, 0) && encloses(boundary, 1) && encloses(boundary, 2)) return held;
  const Ambient* outside = fluid.ambient.data() + k;
  return held | bits(outside[-1]) | bits(outside[0]) | bits(outside[1]);
}

void smooth_faces(const Fluid& fluid, double dt, int axis, int j, int k, double* mass) {
  const Grid& grid = fluid.grid;
  if (j > grid.ny || k > grid.nz || (axis == 1 && j == 1) || (axis == 2 && k == 1)) return;
  if (materials_beside(fluid, j, k) != 1 || materials_beside(fluid, j - (axis == 1), k - (axis == 2)) != 1) return;
  smooth_row(fluid, dt, axis, j, k, mass);
}

void remap_cells(Fluid& fluid, double dt) {
  mirror_pressure(fluid);
  SharedCells shared;
  const Grid& grid = fluid.grid;
  const std::array<int, 3> cells{grid.nx, grid.ny, grid.nz};
  for (int turn = 0; turn < 3; ++turn) {
    const int axis = fluid.steps % 2 == 0 ? turn : 2 - turn;
    if (cells[axis] == 1 && encloses(fluid.setup.boundary, axis)) continue;  // nothing moves
    find_shared_cells(fluid, shared);
    sweep(fluid, axis, dt, shared);
  }
  forget_shared_cells(fluid);
}

}  // namespace polynya::fluid
