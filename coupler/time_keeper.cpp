#include "coupler/time_keeper.hpp"

#include <cmath>

namespace polynya::coupler {
namespace {
constexpr double largest_growth = 1.1;  // of consecutive steps: keeps the leapfrog near its second order
}

SpanPlan plan_span(const StepLimits& limits) {
  const double solid = limits.solid_factor * limits.solid_stable;
  double span = limits.longest_span;
  if (limits.fluid_stable > 0) span = std::min(limits.fluid_factor * limits.fluid_stable, limits.lag_limit);
  const double windows = std::max(1.0, std::ceil(span / solid));
  return {span / windows, static_cast<long>(windows)};
}

double next_step(const StepLimits& limits, double planned, double step_before) {
  return std::min({planned, limits.solid_factor * limits.solid_stable, largest_growth * step_before});
}

}  // namespace polynya::coupler
