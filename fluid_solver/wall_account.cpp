// What the fluid gave to the bodies in a step, and what the change of volume was made of: the walls' motion, debris, and
// the rest, which the mean areas and velocities cannot express (second order in the step; the clamping of slivers).
#include "fluid_solver/phases.hpp"

namespace polynya::fluid {

void book_walls(Fluid& fluid, double dt, const std::vector<StepWall>& walls) {
  Account& account = fluid.account;
  const Grid& grid = fluid.grid;
  for (const StepWall& wall : walls) {
    const double p = fluid.predicted_pressure[wall.cell];
    double defect = fluid.after.volume[wall.cell] - fluid.before.volume[wall.cell] + wall.debris_change;
    for (int body = 0; body < 2; ++body) {
      double swept = 0;
      for (int axis = 0; axis < 3; ++axis) {
        account.body_impulse[body][axis] += dt * p * wall.area[body][axis];
        swept += dt * wall.area[body][axis] * wall.velocity[body][axis];
      }
      account.wall_work[body] += p * swept;
      defect -= swept;
    }
    account.debris_work -= p * wall.debris_change;
    account.swept_defect += p * defect;
  }
  if (fluid.setup.gravity == 0) return;
  // Weight as the faces carry it: gravity times half the density of each side over the open area.
  account.gravity_impulse += dt * fluid.setup.gravity * row_sum(grid, 1, [&](int j, int k) {
    double sum = 0;
    if (j > grid.ny) return sum;
    for (int i = 1; i <= grid.nx; ++i) {
      const std::ptrdiff_t f = grid.at(i, j, k);
      const double open = 0.5 * (fluid.before.open[2][f] + fluid.after.open[2][f]) * grid.dx[i] * grid.dy[j];
      sum += open * 0.5 * (grid.dz[k - 1] * fluid.density[f - grid.sz] + grid.dz[k] * fluid.density[f]);
    }
    return sum;
  });
}

}  // namespace polynya::fluid
