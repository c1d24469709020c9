#include <algorithm>
#include <cmath>

#include "structure_solver/free_flight.hpp"

namespace polynya::structure {
namespace {

constexpr int least_steps = 1000;  // of a rigid body, which has no stable step of its own

}  // namespace

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
    {
      const auto lap = output.watch().lap("positions");
      body.advance_positions(dt);
    }
    {
      const auto lap = output.watch().lap("internal_forces");
      body.internal_forces(dt);
    }
    {
      const auto lap = output.watch().lap("velocities");
      body.finish_step({}, dt, dt);
    }
    const double time = run.end_time * static_cast<double>(n) / static_cast<double>(steps);
    {
      const auto lap = output.watch().lap("account");
      output.record(time, dt, body.account());
    }
    if (time >= next_frame * (1 - 1e-12) || n == steps) {
      output.write_frame(frame++, time);
      next_frame += run.frame_interval;
    }
  }
}

}  // namespace polynya::structure
