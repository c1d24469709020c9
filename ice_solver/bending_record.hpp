#pragma once
#include <nlohmann/json.hpp>

#include "ice_solver/bending.hpp"

namespace polynya::ice {

/// What a bending test leaves: its load until the first element is fractured (afterwards waves of the break knock on
/// the rollers), and its sag while it is intact.
struct BendingRecord {
  double peak_load = 0;                ///< N
  double load_time = 0, duration = 0;  ///< N s and s, until broken
  bool broken = false;
  double sag_load = 0, load_load = 0;  ///< m N and N^2, sums over samples of the intact beam

  POLYNYA_STATE(peak_load, load_time, duration, broken, sag_load, load_load)
};

void record(BendingRecord& record, const BendingRig& rig, const IceBody& beam, double dt);

/// peak_load, mean_load (until broken), sag_ratio (sag of the intact beam over Timoshenko's, each sample weighted by
/// its load squared), bending_strength (outer fibre's stress at the peak), tensile_strength of the law under uniaxial
/// tension, strength_ratio of the two, sampling_bound n / (n - 1) that elements with stresses at their centres, n
/// through the height, reach above 1, cracks.
nlohmann::json findings(const BendingRecord& record, const BendingRig& rig, const IceBody& beam);

}  // namespace polynya::ice
