// Pressures that alternate from cell to cell push no node, so nothing in the Lagrange phase would ever even them out. A
// little water moves, at constant volume, from the high to the low of that pattern only: the difference across a face
// less its (1,2,1)x(1,2,1) mean. Fields that vary along one axis alone, hydrostatic pressure and plane waves too, do
// not feel it. Faces whose surroundings are cut are left out, and those of cells that cavitate, whose pressure says
// nothing of what they hold: a void would give more than it has. (After Rhie & Chow 1983.)
#include <algorithm>

#include "fluid_solver/row_geometry.hpp"
#include "fluid_solver/sweep.hpp"

namespace polynya::fluid {
namespace {

constexpr double smoothing = 0.05;  ///< of alternating pressures, in units of sound speed times density

/// Materials in a row of cells and the four rows beside it.
int materials_beside(const Fluid& fluid, int j, int k) {
  const std::ptrdiff_t width = fluid.grid.ny + 3;
  const unsigned char* held = fluid.row_materials.data() + j + width * k;
  return held[0] | held[-1] | held[1] | held[-width] | held[width];
}

}  // namespace

/// Mean of the pressure by 1, 2, 1 across an axis, for a row of cells.
const double* FaceSmoothing::mean_across(const Fluid& fluid, int axis, int j, int k) {
  const Grid& grid = fluid.grid;
  const std::ptrdiff_t row = grid.at(0, j, k), t1 = grid.stride((axis + 1) % 3), t2 = grid.stride((axis + 2) % 3);
  const std::size_t place = static_cast<std::size_t>(axis == 2 ? k % 2 : j % 2);
  std::vector<double>& mean = mean_[place];
  if (row_[place] == row) return mean.data();
  row_[place] = row;
  mean.resize(static_cast<std::size_t>(grid.nx) + 3);
  const double* p = fluid.pressure.data() + row;
  const Span cells = near_cells(fluid, j, k);
  for (std::ptrdiff_t i = cells.first; i <= cells.last; ++i) {
    const auto band = [p, t1](std::ptrdiff_t c) { return 0.25 * (p[c - t1] + p[c + t1]) + 0.5 * p[c]; };
    mean[static_cast<std::size_t>(i)] = 0.25 * (band(i - t2) + band(i + t2)) + 0.5 * band(i);
  }
  return mean.data();
}

void FaceSmoothing::faces(const Fluid& fluid, double dt, int axis, int j, int k, double* __restrict mass) {
  const Grid& grid = fluid.grid;
  if (j > grid.ny || k > grid.nz || (axis == 1 && j == 1) || (axis == 2 && k == 1)) return;
  const int below_j = j - (axis == 1), below_k = k - (axis == 2);
  if (awake_cells(fluid, j, k).empty() || awake_cells(fluid, below_j, below_k).empty()) return;
  if (materials_beside(fluid, j, k) != 1 || materials_beside(fluid, below_j, below_k) != 1) return;
  const std::ptrdiff_t row = grid.at(0, j, k), s = grid.stride(axis);
  const std::ptrdiff_t t1 = grid.stride((axis + 1) % 3), t2 = grid.stride((axis + 2) % 3);
  const double *p = fluid.pressure.data() + row, *sound = fluid.sound_speed.data() + row,
               *bulk = fluid.bulk_modulus.data() + row, *b = fluid.node_fraction.data() + row;
  const double *mean = mean_across(fluid, axis, j, k),
               *before = axis == 0 ? mean - 1 : mean_across(fluid, axis, below_j, below_k);
  const double area_by_dx = axis == 0   ? 0
                            : axis == 1 ? grid.dz[k]
                                        : grid.dy[j],
               area_x = axis == 0 ? grid.dy[j] * grid.dz[k] : 0.0;
  const double* dx = grid.dx.data();
  const auto smooth = [=](std::ptrdiff_t i) {
    const double rate = std::min(bulk[i], bulk[i - s]) > 0 ? smoothing * dt / std::max(sound[i], 1.0) : 0.0;
    return rate * (area_x + area_by_dx * dx[i]) * ((p[i] - p[i - s]) - (mean[i] - before[i]));
  };
  // Both cells of a face are awake: nothing enters those that sleep.
  const Span own = awake_cells(fluid, j, k), other = awake_cells(fluid, below_j, below_k);
  const std::ptrdiff_t first = std::max(own.first, other.first) + (axis == 0), last = std::min(own.last, other.last);
  if (untouched(fluid, j, k)) {
    for (std::ptrdiff_t i = first; i <= last; ++i) mass[i] -= smooth(i);
    return;
  }
  for (std::ptrdiff_t i = first; i <= last; ++i) {
    const double whole = std::min(std::min(b[i], b[i + t1]), std::min(b[i + t2], b[i + t1 + t2]));
    mass[i] -= whole >= 1.0 ? smooth(i) : 0.0;
  }
}

}  // namespace polynya::fluid
