#include "coupler/end_condition.hpp"

#include <algorithm>
#include <limits>

namespace polynya::coupler {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Whether a vehicle that stopped ends the run: below ice it comes no further.
bool stopping_ends(const scene::Scene& scene) {
  return scene.run.end != "time" && scene.vehicle && scene.ice;
}

/// z of the nose (m) at which the run ends.
double last_nose_position(const scene::Scene& scene) {
  if (!scene.vehicle || !(scene.ice || scene.fluid)) return infinity;
  const double surface = scene.ice ? scene.ice->lower_face + scene.ice->thickness : scene.fluid->waterline;
  const scene::Vehicle& vehicle = *scene.vehicle;
  if (scene.run.end == "ice_passed") return surface + vehicle.diameter + vehicle.head_length;
  if (scene.run.end == "exited") return surface + vehicle.length;
  return infinity;
}

}  // namespace

std::string end_reason(const scene::Scene& scene, double time, double nose, double speed) {
  // Half a nanosecond: far below any step, far above the rounding of a sum of steps.
  if (time >= scene.run.end_time - 5e-10) return "time";
  if (stopping_ends(scene) && speed <= 0) return "vehicle_stopped";
  return nose >= last_nose_position(scene) ? scene.run.end : std::string{};
}

double time_to_event(const scene::Scene& scene, double nose, double speed) {
  double left = infinity;
  if (stopping_ends(scene) && scene.run.gravity > 0) left = std::min(left, std::max(0.0, speed) / scene.run.gravity);
  if (speed > 0) left = std::min(left, (last_nose_position(scene) - nose) / speed);
  return std::max(0.0, left);
}

}  // namespace polynya::coupler
