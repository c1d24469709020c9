#pragma once
#include "structure_solver/rigid_motion.hpp"

namespace polynya::structure {

/// Relative error that one step of the integrator may make in the orientation. Energy drifts by 1e-13 in a
/// thousand turns.
inline constexpr double flight_tolerance = 1e-13;

/// Moves centre and orientation by a step of any length without torque: the centre as advance() does; the orientation
/// by ARKODE (explicit Runge-Kutta of eighth order by Fehlberg, error-controlled) on q' = q (0, w)/2, w = I^-1 R^T L
/// with the angular momentum L fixed in space. Throws std::runtime_error when ARKODE does not reach the end.
void advance_torque_free(RigidMotion& body, double dt, double tolerance = flight_tolerance);

}  // namespace polynya::structure
