#pragma once
#include "fluid_solver/output.hpp"

namespace polynya::fluid {

/// Steps a fluid that meets no solid to the end of the run, with a frame at every frame interval, hit exactly;
/// after_step() is called at the start and after every step.
template <class After>
void run_alone(const scene::Scene& scene, Fluid& fluid, Output& output, After&& after_step) {
  const double end = scene.run.end_time, interval = scene.run.frame_interval > 0 ? scene.run.frame_interval : end;
  output.start(fluid);
  output.write_frame(fluid, 0);
  after_step();
  int frame = 1;
  while (fluid.time < end * (1 - 1e-12)) {
    const double next_frame = std::min(end, frame * interval);
    const double largest = scene.run.fluid_step_factor * stable_step(fluid), left = next_frame - fluid.time;
    const double dt = left <= largest ? left : left < 2 * largest ? 0.5 * left : largest;
    step(fluid, dt, {});
    output.record(fluid, dt);
    after_step();
    if (fluid.time >= next_frame * (1 - 1e-12)) output.write_frame(fluid, frame++);
  }
}

}  // namespace polynya::fluid
