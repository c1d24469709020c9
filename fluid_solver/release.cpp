// Room that breaking solids leave at once.
#include "fluid_solver/phases.hpp"

namespace polynya::fluid {

double release_room(const Grid& grid, CutGeometry& before, const CutGeometry& after, const std::vector<StepWall>& walls, double dt) {
  // Walls that move leave a miss of the order of the distance they move over the size of a cell, a percent or so.
  constexpr double least_fraction = 0.05;
  double released = 0;
  for (const StepWall& wall : walls) {
    const double room = unexplained_change(wall, before, after, dt);
    if (room < least_fraction * full_volume(grid, wall.cell)) continue;
    before.volume[wall.cell] += room;
    released += room;
  }
  return released;
}

}  // namespace polynya::fluid
