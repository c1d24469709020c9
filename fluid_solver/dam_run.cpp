#include "fluid_solver/dam_run.hpp"

#include <cmath>

#include "core/results/time_series.hpp"
#include "fluid_solver/alone.hpp"
#include "fluid_solver/dam_break.hpp"

namespace polynya::fluid {

namespace {

struct Series {
  results::TimeSeries file;
  double interval;  ///< s between rows, from the end that the run began with
  double next = 0;  ///< s, when the next row is due

  POLYNYA_STATE(file, interval, next)
};

}  // namespace

void run_dam(const scene::Scene& scene, Fluid& fluid, Output& output, const results::Checkpoints& checkpoints) {
  constexpr double rows = 1000;
  const double length = scene.fluid->dam->length, unit = std::sqrt(0.5 * length / fluid.setup.gravity);
  const std::vector<results::Column> columns{{"time", "s"},       {"front", "m"},       {"height", "m"},
                                             {"time_scaled", ""}, {"front_scaled", ""}, {"height_scaled", ""}};
  Series series{{output.folder() + "/series/dam.csv", columns,
                 checkpoints.resuming() ? results::Opening::continued : results::Opening::fresh},
                scene.run.end_time / rows};
  run_alone(scene, fluid, output, checkpoints, series, [&] {
    if (fluid.time < series.next) return;
    while (series.next <= fluid.time) series.next += series.interval;
    const double front = front_of(fluid), height = height_at_wall(fluid);
    series.file.append(std::vector{fluid.time, front, height, fluid.time / unit, front / length, height / length});
  });
}

}  // namespace polynya::fluid
