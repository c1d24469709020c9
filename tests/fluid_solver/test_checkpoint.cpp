// A fluid that was saved and loaded goes on with the same bits: interfaces, cut cells, gravity, open boundaries.
#include <gtest/gtest.h>
#include <omp.h>

#include <limits>

#include "fluid_solver/dam_break.hpp"
#include "fluid_solver/fluid.hpp"
#include "tests/core/results/state_bits.hpp"
#include "tests/fluid_solver/analytic_overlap.hpp"

using namespace polynya::fluid;
using namespace polynya::fluid::test;
using polynya::testing::carry_over;
using polynya::testing::state_difference;

namespace {

constexpr double side = 0.02;
const Vector velocity{3, -2, 40};

Setup setup_of(Boundary boundary) {
  Setup setup;
  setup.boundary.fill(boundary);
  setup.gravity = 9.81;
  return setup;
}

/// A box rises out of water into air, its walls cutting cells anyhow.
struct Rising {
  Boundary boundary;
  Fluid fluid;
  double dt = 0;

  explicit Rising(Boundary side_boundary) : boundary(side_boundary), fluid(make()) {}
  Fluid make() const {
    const auto line = even_line(0, side, 10);
    return {Grid(line, line, line), setup_of(boundary)};
  }
  Overlap overlap(double t) const {
    const Vector low{0.00612 + velocity[0] * t, 0.0071 + velocity[1] * t, 0.0058 + velocity[2] * t};
    return overlap_of(fluid.grid, Box{low, {low[0] + 0.0073, low[1] + 0.0061, low[2] + 0.0067}}, velocity);
  }
  void begin() {
    fill_hydrostatic(fluid, overlap(0), 0.0117);
    start_potential_flow(fluid);
    dt = 0.7 * stable_step(fluid);
  }
  void advance(int steps) {
    for (int n = 0; n < steps; ++n) step(fluid, dt, overlap(fluid.time + dt));
  }
};

void spoil(std::vector<double>& values) {
  std::fill(values.begin(), values.end(), std::numeric_limits<double>::quiet_NaN());
}

/// What the list of the state leaves out: nobody may read it before a step has written it.
void spoil_working_space(Fluid& fluid) {
  for (auto* arrays : {&fluid.face_rate, &fluid.next_velocity})
    for (auto& array : *arrays) spoil(array);
}

void expect_same_course(Boundary boundary, int before, int after) {
  Rising whole(boundary);
  whole.begin();
  whole.advance(before);
  Rising resumed(boundary);
  resumed.dt = whole.dt;
  carry_over(whole.fluid, resumed.fluid);
  ASSERT_EQ(state_difference(whole.fluid, resumed.fluid), "");
  spoil_working_space(resumed.fluid);
  whole.advance(after);
  omp_set_num_threads(omp_get_max_threads() == 1 ? 2 : 1);
  resumed.advance(after);
  EXPECT_EQ(state_difference(whole.fluid, resumed.fluid), "");
  EXPECT_GT(whole.fluid.groups.count(), 0u);
}

}  // namespace

// The order of the sweeps goes by the number of the step: both parities, and the first step, which fits the start.
TEST(Checkpoint, FluidGoesOnWithTheSameBitsInATankAfterAnEvenNumberOfSteps) {
  expect_same_course(Boundary::wall, 40, 37);
}
TEST(Checkpoint, FluidGoesOnWithTheSameBitsBetweenOpenBoundariesAfterAnOddNumberOfSteps) {
  expect_same_course(Boundary::non_reflecting, 41, 36);
}
TEST(Checkpoint, FluidGoesOnWithTheSameBitsAfterItsFirstStep) {
  expect_same_course(Boundary::non_reflecting, 1, 10);
}

TEST(Checkpoint, DamBreakGoesOnWithTheSameBits) {
  const auto make = [] {
    return Fluid(Grid(even_line(0, 0.1, 20), even_line(0, 0.005, 1), even_line(0, 0.06, 12)), setup_of(Boundary::wall));
  };
  const auto advance = [](Fluid& fluid, int steps) {
    for (int n = 0; n < steps; ++n) step(fluid, stable_step(fluid), {});
  };
  Fluid whole = make(), resumed = make();
  fill_column(whole, 0.03, 0.04);
  advance(whole, 61);
  carry_over(whole, resumed);
  spoil_working_space(resumed);
  advance(whole, 60);
  advance(resumed, 60);
  EXPECT_EQ(state_difference(whole, resumed), "");
}

TEST(Checkpoint, FluidRefusesTheStateOfAnotherGrid) {
  Rising rising(Boundary::wall);
  rising.begin();
  const auto line = even_line(0, side, 11);
  Fluid other(Grid(line, line, line), setup_of(Boundary::wall));
  try {
    carry_over(rising.fluid, other);
    FAIL() << "no error";
  } catch (const polynya::results::CheckpointError& error) {
    EXPECT_NE(std::string(error.what()).find("are needed"), std::string::npos) << error.what();
  }
}
