#include "coupler/time_keeper.hpp"

#include <cmath>

namespace polynya::coupler {
namespace {
constexpr double largest_growth = 1.1;  // of consecutive steps: keeps the leapfrog near its second order
constexpr double first_span_share = 0.25;
}  // namespace

void limit_growth(StepLimits& limits, const SpanPlan* before) {
  if (limits.fluid_stable <= 0) return;
  limits.longest_span = before ? largest_growth * before->step * static_cast<double>(before->windows)
                               : first_span_share * limits.fluid_factor * limits.fluid_stable;
}

SpanPlan plan_span(const StepLimits& limits) {
  const double solid = limits.solid_factor * limits.solid_stable;
  double span = limits.longest_span;
  if (limits.fluid_stable > 0) span = std::min({span, limits.fluid_factor * limits.fluid_stable, limits.lag_limit});
  const double windows = std::max(1.0, std::ceil(span / solid));
  return {span / windows, static_cast<long>(windows)};
}

double next_step(const StepLimits& limits, double planned, double step_before) {
  return std::min({planned, limits.solid_factor * limits.solid_stable, largest_growth * step_before});
}

}  // namespace polynya::coupler
