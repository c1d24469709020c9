// What the fluid gave to the bodies in a step, and what the change of volume was made of: the walls' motion, and
// the rest that the volume correction could not balance among neighbours.
#include "fluid_solver/phases.hpp"

namespace polynya::fluid {

void book_walls(Fluid& fluid, double dt, const std::vector<StepWall>& walls, const VolumeCorrection& correction) {
  Account& account = fluid.account;
  const Grid& grid = fluid.grid;
  for (const StepWall& wall : walls) {
    const double p = fluid.predicted_pressure[wall.cell];
    for (int body = 0; body < 2; ++body) {
      for (int axis = 0; axis < 3; ++axis) {
        account.body_impulse[body][axis] += dt * wall_pressure(fluid, wall.cell) * wall.area[body][axis];
        account.wall_work[body] += dt * p * wall.area[body][axis] * wall.velocity[body][axis];
        account.swept_volume[body] += dt * wall.area[body][axis] * wall.velocity[body][axis];
      }
    }
    account.swept_defect += p * unexplained_change(wall, fluid.before, fluid.after, dt);
  }
  for (std::size_t c = 0; c < correction.cells.size(); ++c) {
    account.swept_defect += fluid.predicted_pressure[correction.cells[c]] * correction.outflow[c];
  }
  if (fluid.setup.gravity == 0) return;
  // Weight as the faces carry it: gravity times half the density of each side over the open area.
  account.gravity_impulse +=
      dt * fluid.setup.gravity * row_sum(grid, 1, [&](int j, int k) {
        double sum = 0;
        if (j > grid.ny) return sum;
#pragma omp simd reduction(+ : sum)
        for (int i = 1; i <= grid.nx; ++i) {
          const std::ptrdiff_t f = grid.at(i, j, k);
          const double open = 0.5 * (fluid.before.open[2][f] + fluid.after.open[2][f]) * grid.dx[i] * grid.dy[j];
          sum += open * 0.5 * (grid.dz[k - 1] * fluid.density[f - grid.sz] + grid.dz[k] * fluid.density[f]);
        }
        return sum;
      });
}

}  // namespace polynya::fluid
