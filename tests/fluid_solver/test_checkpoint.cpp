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

/// What the list of the state leaves out: whatever was there before loading, nobody may read it.
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
  spoil_working_space(resumed.fluid);
  carry_over(whole.fluid, resumed.fluid);
  ASSERT_EQ(state_difference(whole.fluid, resumed.fluid), "");
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
  spoil_working_space(resumed);
  carry_over(whole, resumed);
  advance(whole, 60);
  advance(resumed, 60);
  EXPECT_EQ(state_difference(whole, resumed), "");
}

namespace {

/// Water under air at rest, but for a little too much water in cells near a corner.
Fluid pond() {
  Setup setup = setup_of(Boundary::wall);
  setup.boundary[5] = Boundary::non_reflecting;
  setup.sleeping_threshold = 1e-7;
  return {Grid(even_line(0, 0.024, 24), even_line(0, 0.032, 32), even_line(-0.02, 0.012, 32)), setup};
}
void disturb(Fluid& fluid) {
  fill_hydrostatic(fluid, {}, 0.0003);
  for (int n = 0; n < 32; ++n) step(fluid, 0.7 * stable_step(fluid), {});
  const std::ptrdiff_t cell = fluid.grid.at(4, 5, 8);
  fluid.material[water].mass[cell] *= 1.0001;
  wake(fluid, cell);
}
void advance(Fluid& fluid, int steps) {
  for (int n = 0; n < steps; ++n) step(fluid, 0.7 * stable_step(fluid), {});
}

/// Has another past: all of it sleeps, so that nothing is right by chance.
Fluid slept_pond() {
  Fluid fluid = pond();
  fill_hydrostatic(fluid, {}, 0.0003);
  advance(fluid, 40);
  EXPECT_EQ(fluid.sleeping.cells_awake, 0u);
  return fluid;
}

void expect_same_from_here(Fluid& whole, Fluid& resumed, int steps) {
  spoil_working_space(resumed);
  carry_over(whole, resumed);
  advance(whole, steps);
  omp_set_num_threads(omp_get_max_threads() == 1 ? 2 : 1);
  advance(resumed, steps);
  EXPECT_EQ(state_difference(whole, resumed), "");
  EXPECT_EQ(account_values(whole.account), account_values(resumed.account));
}

}  // namespace

// What sleeps is at the border of what moves, wakes up, and falls asleep again.
TEST(Checkpoint, FluidPartAsleepGoesOnWithTheSameBits) {
  for (const int before : {3, 12}) {  // the look at disturbances comes every eight steps
    Fluid whole = pond(), resumed = slept_pond();
    disturb(whole);
    advance(whole, before);
    ASSERT_GT(whole.sleeping.cells_awake, 0u);
    ASSERT_FALSE(whole.sleeping.all_awake);
    const std::size_t awake = whole.sleeping.cells_awake;
    expect_same_from_here(whole, resumed, 30);
    EXPECT_GT(whole.sleeping.cells_awake, awake);
    EXPECT_EQ(whole.sleeping.share_awake(), resumed.sleeping.share_awake());
  }
}

TEST(Checkpoint, FluidThatIsAboutToFallAsleepDoesSoInTheSameStep) {
  Fluid whole = pond(), resumed = pond();
  fill_hydrostatic(whole, {}, 0.0003);
  advance(whole, 18);
  ASSERT_TRUE(whole.sleeping.all_awake);
  expect_same_from_here(whole, resumed, 8);
  EXPECT_EQ(whole.sleeping.cells_awake, 0u);
}

TEST(Checkpoint, FluidAllAsleepGoesOnWithTheSameBitsAndWakesAlike) {
  Fluid asleep = slept_pond(), resumed = pond();
  spoil_working_space(resumed);
  carry_over(asleep, resumed);
  for (Fluid* fluid : {&asleep, &resumed}) {
    advance(*fluid, 5);
    fluid->material[water].mass[fluid->grid.at(4, 5, 8)] *= 1.0001;
    wake(*fluid, fluid->grid.at(4, 5, 8));
    advance(*fluid, 20);
  }
  EXPECT_EQ(state_difference(asleep, resumed), "");
  EXPECT_EQ(account_values(asleep.account), account_values(resumed.account));
}

namespace {

/// Lumps of water and air on a grid that climbs and stretches along z, with a table of its own along x.
Fluid moving_box() {
  const auto line = even_line(0, side, 10);
  Fluid fluid{Grid(line, line, line), setup_of(Boundary::non_reflecting)};
  std::array<EndMotion, 3> motion;
  motion[2].speed = {30, 40};
  motion[0].time = {0, 2e-5, 4e-5, 9e-5};
  motion[0].displacement = {std::vector<double>{0, 1e-4, -2e-4, 1e-4}, std::vector<double>{0, 2e-4, 4e-4, -1e-4}};
  prescribe_motion(fluid, motion);
  return fluid;
}

}  // namespace

TEST(Checkpoint, FluidOnAGridThatClimbsAndStretchesGoesOnWithTheSameBits) {
  for (const int before : {1, 24}) {
    Fluid whole = moving_box(), resumed = moving_box();
    fill_hydrostatic(whole, {}, 0.0117, {20, -10, 5});
    advance(whole, before);
    expect_same_from_here(whole, resumed, 25);
    EXPECT_NE(whole.grid.z.front(), 0);
    EXPECT_NE(whole.grid.dx[1], side / 10);
  }
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
