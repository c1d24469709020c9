#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "fluid_solver/fluid.hpp"

namespace polynya::fluid {

/// What the fluid expects to do to the walls in its next step, by cell that holds wall.
struct WallForecast {
  std::vector<double> pressure;   ///< Pa, gauge, if walls and fluid go on as they moved in the step that ended
  std::vector<double> impedance;  ///< kg/(m^2 s): how much more if the walls of the cell and of its group move faster
                                  ///< into the fluid; 0 where it cavitates
};

/// After a step of length `dt` (s), for a next one as long: the step's own formulas for the pressure that acts in it
/// (predicted_pressure.cpp, group_state.cpp), linear in the motion of the walls. `cells` (numbers of the messages,
/// ascending) are those that hold wall at the end of the step.
WallForecast forecast_walls(Fluid& fluid, std::span<const std::int64_t> cells, double dt);

}  // namespace polynya::fluid
