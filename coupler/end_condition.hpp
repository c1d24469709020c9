#pragma once
#include <string>

#include "core/scene/scene.hpp"

namespace polynya::coupler {

/// Why a run ends, or an empty string while it goes on. `nose` is the z position of the vehicle's nose (m), `speed` its
/// centre-of-mass speed (m/s).
///   "time"        latest end of the scene
///   "ice_passed"  the cylinder's first section is one diameter above the ice's upper face, or the vehicle stopped
///   "exited"      the tail is above the ice's upper face, or the vehicle stopped; without ice: the tail is above the
///                 waterline
/// A vehicle without ice and water ends by time alone.
std::string end_reason(const scene::Scene& scene, double time, double nose, double speed);

/// Time (s) until that can change for another reason than "time" when nothing but weight acts on the vehicle.
double time_to_event(const scene::Scene& scene, double nose, double speed);

}  // namespace polynya::coupler
