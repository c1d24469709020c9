#include "coupler/end_condition.hpp"

namespace polynya::coupler {

std::string end_reason(const scene::Scene& scene, double time, double nose, double speed) {
  // Half a nanosecond: far below any step, far above the rounding of a sum of steps.
  if (time >= scene.run.end_time - 5e-10) return "time";
  if (scene.run.end == "time" || !scene.vehicle || !scene.ice) return {};
  if (speed <= 0) return "vehicle_stopped";
  const double upper_face = scene.ice->lower_face + scene.ice->thickness;
  const scene::Vehicle& vehicle = *scene.vehicle;
  if (scene.run.end == "ice_passed" && nose - vehicle.head_length >= upper_face + vehicle.diameter) return "ice_passed";
  if (scene.run.end == "exited" && nose - vehicle.length >= upper_face) return "exited";
  return {};
}

}  // namespace polynya::coupler
