#pragma once
#include <algorithm>
#include <limits>

namespace polynya::coupler {

/// Steps of the solids (windows) and of the fluid (spans of whole windows), chosen from the stable steps that the
/// participants report, never from wall time.
struct StepLimits {
  double solid_stable = 0;    ///< s, smallest of the solids now
  double solid_factor = 0.9;  ///< fraction of it that is used
  double fluid_stable = 0;    ///< s; 0 when there is no fluid
  double fluid_factor = 1;
  double lag_limit = std::numeric_limits<double>::infinity();  ///< s, bound of the span from the lag of loads that no
                                                               ///< forecast precedes
  double longest_span = 0;                                     ///< s, bound of a span without fluid
};

/// Time of the coupled run.
struct TimeKeeper {
  double time = 0;            ///< s, end of the last window
  double step = 0;            ///< s, of the current window; of a free one: step of the next one that is not
  double length = 0;          ///< s, of the current window: `step`, or longer when it is free
  double span_start = 0;      ///< s
  long window = 0, span = 0;  ///< completed
  long windows_left = 0;      ///< in the current span
  long free_windows = 0;      ///< completed, in which nothing acted between the solids

  bool free() const { return length > step; }

  /// Time over which the force at the end of the current window acts: half this window and half the next one.
  double acting_time(double next_step) const { return 0.5 * (step + next_step); }
};

/// Length of the span and number of windows in it, from the limits. The span is the fluid's stable step, bounded by
/// the lag of its loads if it does not forecast them; windows divide it evenly and never exceed the solids' stable
/// step. While windows still grow towards that length (next_step) the span is shorter.
struct SpanPlan {
  double step = 0;
  long windows = 1;
};
SpanPlan plan_span(const StepLimits& limits);

/// Bounds the next span of a run with fluid: a quarter of the fluid's stable step at first, so that the flow of the
/// start fits the walls it has met after its first step, and a tenth more than the span before from then on.
void limit_growth(StepLimits& limits, const SpanPlan* before);

/// Next window inside a span: the planned step, shortened if the solids' stable step fell, growing by at most a tenth.
double next_step(const StepLimits& limits, double planned, double step_before);

}  // namespace polynya::coupler
