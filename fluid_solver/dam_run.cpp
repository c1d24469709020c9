#include "fluid_solver/dam_run.hpp"

#include <cmath>

#include "core/results/time_series.hpp"
#include "fluid_solver/alone.hpp"
#include "fluid_solver/dam_break.hpp"

namespace polynya::fluid {

void run_dam(const scene::Scene& scene, Fluid& fluid, Output& output) {
  constexpr double rows = 1000;
  const double length = scene.fluid->dam->length, unit = std::sqrt(0.5 * length / fluid.setup.gravity);
  const double interval = scene.run.end_time / rows;
  results::TimeSeries series(output.folder() + "/series/dam.csv", {{"time", "s"},
                                                                   {"front", "m"},
                                                                   {"height", "m"},
                                                                   {"time_scaled", ""},
                                                                   {"front_scaled", ""},
                                                                   {"height_scaled", ""}});
  double next = 0;
  run_alone(scene, fluid, output, [&] {
    if (fluid.time < next) return;
    while (next <= fluid.time) next += interval;
    const double front = front_of(fluid), height = height_at_wall(fluid);
    series.append(std::vector{fluid.time, front, height, fluid.time / unit, front / length, height / length});
  });
}

}  // namespace polynya::fluid
