#include <algorithm>
#include <cmath>

#include "structure_solver/free_flight.hpp"

namespace polynya::structure {
namespace {

constexpr int least_steps = 1000;  // of a rigid body, which has no stable step of its own

}  // namespace

void step_freely(VehicleBody& body, double step, double next, double time, Output& output) {
  compute::Stopwatch& watch = output.watch();
  {
    const auto lap = watch.lap("positions");
    body.advance_positions(step);
  }
  {
    const auto lap = watch.lap("internal_forces");
    body.internal_forces(step);
  }
  {
    const auto lap = watch.lap("velocities");
    body.finish_step({}, step, next);
  }
  const auto lap = watch.lap("account");
  output.record(time, step, body.account());
}

void run_free_flight(BuiltVehicle& vehicle, const scene::Run& run, Output& output) {
  VehicleBody& body = *vehicle.body;
  const double largest = std::min(run.step_factor * body.stable_step(), run.end_time / least_steps);
  // Steps of equal length that end on the end time.
  const long steps = std::max(1L, static_cast<long>(std::ceil(run.end_time / largest)));
  const double dt = run.end_time / static_cast<double>(steps);
  int frame = 0;
  double next_frame = run.frame_interval;
  output.write_frame(frame++, 0);
  body.internal_forces(0);
  body.finish_step({}, 0, dt);
  for (long n = 1; n <= steps; ++n) {
    const double time = run.end_time * static_cast<double>(n) / static_cast<double>(steps);
    step_freely(body, dt, dt, time, output);
    if (time >= next_frame * (1 - 1e-12) || n == steps) {
      output.write_frame(frame++, time);
      next_frame += run.frame_interval;
    }
  }
}

}  // namespace polynya::structure
