#pragma once
#include <cstdint>
#include <vector>

#include "ice_solver/ice_body.hpp"

namespace polynya::ice {

/// Four-point bending: lines of nodes across the beam, supports on the lower face held vertically, loading lines on the
/// upper face moved down at a prescribed speed.
struct BendingRig {
  double support_span = 0, load_span = 0;  ///< m, of the node lines found
  double speed = 0, ramp_time = 0;         ///< m/s downward; s to reach it
  double multiplicity = 1;                 ///< beams per model: 2 for a half, 4 for a quarter
  std::vector<std::int32_t> supports, loads;
  double deflection = 0;  ///< m, travel of the loading lines

  POLYNYA_STATE_WITHOUT((support_span, load_span, speed, ramp_time, multiplicity, supports, loads), support_span,
                        load_span, speed, ramp_time, multiplicity, supports, loads, deflection)
};

/// Finds the node lines nearest to the spans wanted and holds their vertical component. Throws std::invalid_argument
/// if a span does not fit the beam.
BendingRig make_bending_rig(IceBody& beam, double support_span, double load_span, double speed, double ramp_time);

/// Sets the loading lines' velocity for the step that begins at `time` and lasts `dt`, and counts the travel.
void move_rollers(BendingRig& rig, IceBody& beam, double time, double dt);

/// Force of the loading lines on the whole beam, N, positive downward, at the last internal_forces.
double roller_load(const BendingRig& rig, const IceBody& beam);
/// Force of the supports, N, positive upward: the same but for inertia.
double support_reaction(const BendingRig& rig, const IceBody& beam);

/// Smooth start: 0 at 0, 1 from ramp_time on, without a jump in acceleration.
double smooth_ramp(double time, double ramp_time);

}  // namespace polynya::ice
