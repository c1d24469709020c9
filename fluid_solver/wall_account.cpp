// What the fluid gave to the bodies in a step, and what the change of volume was made of: the walls' motion, and
// the rest that the volume correction could not balance among neighbours.
#include <algorithm>

#include "fluid_solver/phases.hpp"
#include "fluid_solver/row_geometry.hpp"

namespace polynya::fluid {

void book_walls(Fluid& fluid, double dt, const std::vector<StepWall>& walls, const VolumeCorrection& correction) {
  Account& account = fluid.account;
  const Grid& grid = fluid.grid;
  for (const StepWall& wall : walls) {
    const double p = fluid.predicted_pressure[wall.cell];
    for (int body = 0; body < 2; ++body) {
      for (int axis = 0; axis < 3; ++axis) {
        account.body_impulse[body][axis] += dt * wall_pressure(fluid, wall.cell) * wall.area[body][axis];
      }
      account.wall_work[body] += dt * p * wall.sweep[body];
      account.swept_volume[body] += dt * wall.sweep[body];
    }
    account.swept_defect += p * unexplained_change(wall, fluid.before, fluid.after, dt);
  }
  for (std::size_t c = 0; c < correction.cells.size(); ++c) {
    account.swept_defect += fluid.predicted_pressure[correction.cells[c]] * correction.outflow[c];
  }
  if (fluid.setup.gravity == 0) return;
  // Weight as the faces carry it: gravity times half the density of each side over the open area.
  account.gravity_impulse += dt * fluid.setup.gravity * fluid.sleeping.at_rest.weight;
  account.gravity_impulse +=
      dt * fluid.setup.gravity * row_sum(grid, 1, [&](int j, int k) {
        const Span faces = touched_nodes(fluid, j, k);
        double sum = 0;
        if (j > grid.ny || faces.empty()) return sum;
        const std::ptrdiff_t row = grid.at(0, j, k), sz = grid.sz;
        const double *rho = fluid.density.data() + row, low = 0.5 * grid.dz[k - 1], high = 0.5 * grid.dz[k];
        with_row(fluid, j, k, [&](auto at) {
    // The coefficient is the open area over the sum of the four nodes' fractions.
#pragma omp simd reduction(+ : sum)
          for (int i = faces.first; i <= std::min(faces.last, grid.nx); ++i) {
            const double nodes = (at.node(i) + at.node(i + 1)) + (at.node(i + grid.sy) + at.node(i + grid.sy + 1));
            sum += at.z(i) * nodes * (low * rho[i - sz] + high * rho[i]);
          }
        });
        return sum;
      });
}

}  // namespace polynya::fluid
