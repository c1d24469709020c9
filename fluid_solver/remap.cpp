// Remap of cells: what flowed through each face during the Lagrange phase is moved axis by axis, in turns xyz and zyx,
// so that the error of splitting cancels over two steps.
#include <algorithm>

#include "fluid_solver/phases.hpp"
#include "fluid_solver/sweep.hpp"

namespace polynya::fluid {
namespace {

int bits(const Ambient& layer) {
  return (layer.density[0] > 0 ? 1 : 0) | (layer.density[1] > 0 ? 2 : 0);
}

bool encloses(const std::array<Boundary, 6>& boundary, int axis) {
  return boundary[2 * axis] == Boundary::wall && boundary[2 * axis + 1] == Boundary::wall;
}

}  // namespace

int materials_around(const Fluid& fluid, int j, int k) {
  const std::ptrdiff_t width = fluid.grid.ny + 3;
  const unsigned char* row = fluid.row_materials.data() + j + width * k;
  int held = 0;
  for (const std::ptrdiff_t layer : {-width, std::ptrdiff_t{0}, width})
    held |= row[layer - 1] | row[layer] | row[layer + 1];
  const auto& boundary = fluid.setup.boundary;
  if (encloses(boundary, 0) && encloses(boundary, 1) && encloses(boundary, 2)) return held;
  const Ambient* outside = fluid.ambient.data() + k;
  return held | bits(outside[-1]) | bits(outside[0]) | bits(outside[1]);
}

void remap_cells(Fluid& fluid, double dt) {
  mirror_pressure(fluid);
  SharedCells shared;
  const Grid& grid = fluid.grid;
  const std::array<int, 3> cells{grid.nx, grid.ny, grid.nz};
  const auto moves = [&](int axis) { return cells[axis] > 1 || !encloses(fluid.setup.boundary, axis); };
  for (int turn = 0; turn < 3; ++turn) {
    const int axis = fluid.steps % 2 == 0 ? turn : 2 - turn, next = fluid.steps % 2 == 0 ? turn + 1 : 1 - turn;
    if (axis < 2 && next >= 0 && next < 2 && moves(axis) && moves(next)) {
      sweep_layers(fluid, axis, next, dt, shared);
      ++turn;
    } else if (moves(axis)) {
      sweep(fluid, axis, dt, shared);
    }
  }
  forget_shared_cells(fluid);
}

}  // namespace polynya::fluid
