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
  double width = 0, height = 0;            ///< m, of the whole beam's section
  std::vector<std::int32_t> supports, loads;
  std::vector<std::int32_t> support_axis, middle_axis;  ///< nodes at half height, over the supports and at x = 0
  double deflection = 0;                                ///< m, travel of the loading lines

  double arm() const { return 0.5 * (support_span - load_span); }

  POLYNYA_STATE_WITHOUT((support_span, load_span, speed, ramp_time, multiplicity, width, height, supports, loads,
                         support_axis, middle_axis),
                        support_span, load_span, speed, ramp_time, multiplicity, width, height, supports, loads,
                        support_axis, middle_axis, deflection)
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

/// How far the beam's axis has sunk in the middle below where it is over the supports, m: what rollers press into the
/// faces is not in it.
double sag(const BendingRig& rig, const IceBody& beam);
/// Sag per load, m/N, of Timoshenko's beam with Cowper's (1966) shear coefficient of a rectangle:
/// a (3 L^2 - 4 a^2) / (48 E I) + a / (2 kappa G A).
double timoshenko_flexibility(const BendingRig& rig, const continuum::Elastic& law);
/// Stress of the outer fibre between the loads by beam theory, Pa: 3 F a / (b h^2).
double outer_fibre_stress(const BendingRig& rig, double load);
/// Vertical cracks, each with its mirror image: neighbouring sections of which at least half is fractured (damage above
/// 0.9). `between_loads` counts those between the loading lines.
struct Cracks {
  int all = 0, between_loads = 0;
};
Cracks count_cracks(const BendingRig& rig, const IceBody& beam);

/// Smooth start: 0 at 0, 1 from ramp_time on, without a jump in acceleration.
double smooth_ramp(double time, double ramp_time);

}  // namespace polynya::ice
