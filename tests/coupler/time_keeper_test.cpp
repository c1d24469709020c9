#include "coupler/time_keeper.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace polynya::coupler;

TEST(TimeKeeper, SpanIsWholeWindowsWithinEveryLimit) {
  StepLimits limits{.solid_stable = 1e-7,
                    .solid_factor = 0.9,
                    .fluid_stable = 6e-7,
                    .fluid_factor = 0.5,
                    .lag_limit = 2.5e-7,
                    .longest_span = 1};
  const SpanPlan plan = plan_span(limits);
  EXPECT_EQ(plan.windows, 3);
  EXPECT_LE(plan.step, 0.9e-7);
  EXPECT_NEAR(plan.step * plan.windows, 2.5e-7, 1e-20);
  limits.lag_limit = 1;
  EXPECT_NEAR(plan_span(limits).step * plan_span(limits).windows, 3e-7, 1e-20);
}

TEST(TimeKeeper, FluidFasterThanTheSolidsShortensTheWindow) {
  const StepLimits limits{.solid_stable = 1e-6,
                          .solid_factor = 0.9,
                          .fluid_stable = 1e-7,
                          .fluid_factor = 1,
                          .lag_limit = 1,
                          .longest_span = 1};
  const SpanPlan plan = plan_span(limits);
  EXPECT_EQ(plan.windows, 1);
  EXPECT_DOUBLE_EQ(plan.step, 1e-7);
}

TEST(TimeKeeper, SpansOfAFluidStartShortAndGrowByATenth) {
  StepLimits limits{.solid_stable = 1e-8,
                    .solid_factor = 1,
                    .fluid_stable = 4e-7,
                    .fluid_factor = 1,
                    .lag_limit = 1,
                    .longest_span = 0};
  limit_growth(limits, nullptr);
  SpanPlan plan = plan_span(limits);
  EXPECT_NEAR(plan.step * plan.windows, 1e-7, 1e-20);
  for (int span = 1; span < 14; ++span) {
    limit_growth(limits, &plan);
    plan = plan_span(limits);
    EXPECT_NEAR(plan.step * plan.windows, 1e-7 * std::pow(1.1, span), 1e-19);
  }
  for (int span = 14; span < 20; ++span) {
    limit_growth(limits, &plan);
    plan = plan_span(limits);
  }
  EXPECT_NEAR(plan.step * plan.windows, 4e-7, 1e-20);
}

TEST(TimeKeeper, WindowFallsAtOnceAndGrowsSlowly) {
  StepLimits limits{.solid_stable = 1e-7,
                    .solid_factor = 1,
                    .fluid_stable = 0,
                    .fluid_factor = 1,
                    .lag_limit = 0,
                    .longest_span = 1e-6};
  EXPECT_DOUBLE_EQ(next_step(limits, 1e-7, 1e-8), 1.1e-8);
  limits.solid_stable = 2e-9;
  EXPECT_DOUBLE_EQ(next_step(limits, 1e-7, 1e-8), 2e-9);
}
