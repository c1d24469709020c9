#pragma once
#include <spdlog/spdlog.h>

#include "core/results/checkpoint_file.hpp"
#include "core/results/checkpoint_folder.hpp"
#include "fluid_solver/output.hpp"

namespace polynya::fluid {

/// What goes on from step to step; `Series` lists what after_step() keeps.
template <class Series>
struct CourseAlone {
  Fluid& fluid;
  int frame = 0;  ///< the next one
  Series& series;
  Output& output;

  POLYNYA_STATE(fluid, frame, series, output)
};

/// Takes a fluid to the end of the run by advance(dt), which steps it, with a frame at every frame interval, hit
/// exactly; after_step() is called at the start and after every step, and keeps what `series` lists.
template <class Series, class Advance, class After>
void run_alone(const scene::Scene& scene, Fluid& fluid, Output& output, const results::Checkpoints& checkpoints,
               Series& series, Advance&& advance, After&& after_step) {
  const double end = scene.run.end_time, interval = scene.run.frame_interval;
  CourseAlone<Series> course{fluid, 1, series, output};
  if (checkpoints.resuming()) {
    if (const std::string remark = checkpoints.load(course); !remark.empty()) spdlog::warn("{}", remark);
    output.go_on(fluid);
    spdlog::info("goes on at t = {:.6e} s, step {}", fluid.time, fluid.steps);
  } else {
    output.start(fluid);
    output.write_frame(fluid, 0);
    after_step();
  }
  results::CheckpointSchedule schedule(scene.checkpoint.interval, scene.checkpoint.wall_interval, fluid.time);
  while (fluid.time < end * (1 - 1e-12)) {
    const double next_frame = std::min(end, course.frame * interval);
    const double largest = scene.run.fluid_step_factor * stable_step(fluid), left = next_frame - fluid.time;
    const double dt = left <= largest ? left : left < 2 * largest ? 0.5 * left : largest;
    advance(dt);
    output.record(fluid, dt);
    after_step();
    if (fluid.time >= next_frame * (1 - 1e-12)) output.write_frame(fluid, course.frame++);
    // The last two steps are fitted to the end: a run that ends later takes others.
    if (!schedule.due(fluid.time) || !checkpoints.active() || end - fluid.time < 1.5 * dt) continue;
    const auto lap = fluid.watch.lap("checkpoints");
    schedule.taken(fluid.time);
    check_state(fluid);  // nobody could go on from a state without meaning
    checkpoints.save(results::checkpoint_folder(fluid.steps), fluid.steps, fluid.time, course);
    results::commit_checkpoint(output.folder(), fluid.steps, fluid.time, {checkpoints.file()});
  }
}

/// The same for a fluid that meets no solid.
template <class Series, class After>
void run_alone(const scene::Scene& scene, Fluid& fluid, Output& output, const results::Checkpoints& checkpoints,
               Series& series, After&& after_step) {
  run_alone(
      scene, fluid, output, checkpoints, series, [&](double dt) { step(fluid, dt, {}); }, after_step);
}

}  // namespace polynya::fluid
