// Room that breaking solids leave at once. What debris takes up elsewhere, the volume correction hands on; only the net
// gain becomes an empty room, which the water fills in its own time and without work done on it.
#include "fluid_solver/phases.hpp"

namespace polynya::fluid {

double release_room(const Grid& grid, CutGeometry& before, const CutGeometry& after, const std::vector<StepWall>& walls,
                    double dt) {
  // Walls that move leave a miss of the order of the distance they move over the size of a cell, a percent or so.
  constexpr double least_fraction = 0.05;
  const auto jump = [&](const StepWall& wall) {
    const double room = unexplained_change(wall, before, after, dt);
    return room < least_fraction * grid.cell_volume[wall.cell] ? 0.0 : room;
  };
  double net = 0, gained = 0;
  for (const StepWall& wall : walls) {
    net += unexplained_change(wall, before, after, dt);
    gained += jump(wall);
  }
  if (!(gained > 0) || !(net > 1e-9 * gained)) return 0;
  // What falls short of a jump in other cells belongs to it too: none of the net gain is left to be felt as pressure.
  const double share = net / gained;
  double released = 0;
  for (const StepWall& wall : walls) {
    const double room = share * jump(wall);
    before.volume[wall.cell] += room;
    released += room;
  }
  return released;
}

}  // namespace polynya::fluid
