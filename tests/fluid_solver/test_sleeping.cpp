// What nothing has disturbed sleeps; where something comes it wakes in time, so that a run is that of a fluid awake.
#include <gtest/gtest.h>
#include <omp.h>

#include <cstdio>

#include "fluid_solver/fluid.hpp"
#include "tests/fluid_solver/analytic_overlap.hpp"

using namespace polynya::fluid;
using namespace polynya::fluid::test;

namespace {

constexpr double threshold = 1e-7;
constexpr int long_enough_to_sleep = 4 * static_cast<int>(Sleeping::steps_between_looks);

/// Water under air between walls, open above, at rest under gravity: cells of 1 mm, the waterline at 0.3 mm.
Fluid tank(double sleeping_threshold, int across = 40, int below = 32, int above = 16) {
  Setup setup;
  setup.gravity = 9.81;
  setup.sleeping_threshold = sleeping_threshold;
  setup.boundary[5] = Boundary::non_reflecting;
  const auto side = even_line(0, 0.001 * across, across);
  Fluid fluid{Grid(side, side, even_line(-0.001 * below, 0.001 * above, below + above)), setup};
  fill_hydrostatic(fluid, {}, 0.0003);
  return fluid;
}

/// Compresses (or thins) what is within 3 mm of a place and wakes that place.
void disturb(Fluid& fluid, std::array<double, 3> place, double compression) {
  const Grid& grid = fluid.grid;
  for (int k = 1; k <= grid.nz; ++k) {
    for (int j = 1; j <= grid.ny; ++j) {
      for (int i = 1; i <= grid.nx; ++i) {
        const double x = grid.centre_x(i) - place[0], y = grid.centre_y(j) - place[1], z = grid.centre_z(k) - place[2];
        const double part = std::max(0.0, 1.0 - (x * x + y * y + z * z) / 9e-6);
        for (Material& own : fluid.material) own.mass[grid.at(i, j, k)] *= 1.0 + compression * part * part;
      }
    }
  }
  wake(fluid, grid.at(1 + static_cast<int>(place[0] / 0.001), 1 + static_cast<int>(place[1] / 0.001),
                      1 + static_cast<int>((place[2] - grid.z[0]) / 0.001)));
  update_account(fluid);
}

/// Lets the tank fall asleep.
void settle_down(Fluid& fluid) {
  const double dt = 0.7 * stable_step(fluid);
  for (int n = 0; n < long_enough_to_sleep; ++n) step(fluid, dt, {});
  fluid.sleeping.cells_stepped = fluid.sleeping.cells_in_all = 0;
}

/// Largest differences of pressure over the bulk modulus of water (gas: of its own) and of velocity over sound speed.
struct Difference {
  double pressure = 0, velocity = 0;
};
Difference between(const Fluid& one, const Fluid& other) {
  Difference largest;
  for (int k = 1; k <= one.grid.nz; ++k) {
    for (int j = 1; j <= one.grid.ny; ++j) {
      for (int i = 1; i <= one.grid.nx; ++i) {
        const std::ptrdiff_t c = one.grid.at(i, j, k);
        const double stiffness = one.density[c] * one.sound_speed[c] * one.sound_speed[c];
        largest.pressure =
            std::max(largest.pressure,
                     std::abs(one.predicted_pressure[c] - other.predicted_pressure[c]) / std::max(stiffness, 1e5));
        for (int d = 0; d < 3; ++d)
          largest.velocity = std::max(largest.velocity, std::abs(one.velocity[d][c] - other.velocity[d][c]) / 340.0);
      }
    }
  }
  return largest;
}

/// Steps both together; returns the largest differences met and writes the share of cells that was awake.
Difference largest_difference(Fluid& asleep, Fluid& awake, int steps, const char* what) {
  const double dt = 0.7 * stable_step(awake);
  Difference largest;
  for (int n = 0; n < steps; ++n) {
    step(asleep, dt, {});
    step(awake, dt, {});
    const Difference now = between(awake, asleep);
    largest = {std::max(largest.pressure, now.pressure), std::max(largest.velocity, now.velocity)};
  }
  std::printf("%s: differences %.1e of the stiffness, %.1e of the sound speed of air; %.0f %% awake\n", what,
              largest.pressure, largest.velocity, 100 * asleep.sleeping.share_awake());
  return largest;
}

double mass_of(const Fluid& fluid, int material) {
  return fluid.account.mass[material] + fluid.account.boundary_mass[material];
}

/// What the momentum of the fluid and all that it gave away add up to, along an axis: a constant.
double momentum_sum(const Fluid& fluid, int axis) {
  const Account& a = fluid.account;
  return a.momentum[axis] + a.boundary_impulse[axis] + a.node_fix_impulse[axis] + a.rest_impulse[axis] +
         (axis == 2 ? a.gravity_impulse : 0.0);
}

/// A gas of ten times the pressure and density of the other, 60 of 200 cells along y.
constexpr int length = 200;
Fluid tube(double sleeping_threshold) {
  polynya::fluid::Setup setup;
  setup.law = {IdealGas{1.4}, IdealGas{1.4}};
  setup.pressure_floor = {0, 0};
  setup.sleeping_threshold = sleeping_threshold;
  Fluid fluid{Grid(even_line(0, 0.004, 4), even_line(0, 0.001 * length, length), even_line(0, 0.001, 1)), setup};
  fill(fluid, {}, [&](int, int j, int) {
    CellState state;
    const int m = j <= 60 ? 0 : 1;
    state.fraction[m] = 1;
    state.density[m] = m == 0 ? 10 : 1;
    state.specific_energy[m] = energy_at(setup.law[m], state.density[m], m == 0 ? 1e6 : 1e5);
    return state;
  });
  return fluid;
}

}  // namespace

TEST(Sleeping, TankAtRestTakesStepsWithoutACellAwakeAndKeepsItsWeightOnTheFloor) {
  Fluid fluid = tank(threshold, 17, 20, 9);
  const double dt = 0.7 * stable_step(fluid), mass = fluid.account.mass[water], sum = fluid.account.energy_sum();
  for (int n = 0; n < long_enough_to_sleep; ++n) step(fluid, dt, {});
  EXPECT_EQ(fluid.sleeping.cells_awake, 0u);
  const double stepped = fluid.sleeping.cells_stepped, pushed = fluid.account.boundary_impulse[2];
  for (int n = 0; n < 10000; ++n) step(fluid, dt, {});
  EXPECT_EQ(fluid.sleeping.cells_stepped, stepped);
  EXPECT_NEAR(fluid.time, (10000 + long_enough_to_sleep) * dt, 1e-9 * fluid.time);
  EXPECT_NEAR(fluid.account.mass[water], mass, 1e-15 * mass);
  EXPECT_NEAR(fluid.account.energy_sum(), sum, 1e-14 * sum);
  const double weight = 9.81 * (fluid.account.mass[water] + fluid.account.mass[air]);
  // The pressure of the lowest layer is that at its centre: of that layer half weighs on it.
  const double half_layer = 0.5 * 9.81 * 1000 * 0.017 * 0.017 * 0.001;
  EXPECT_NEAR((fluid.account.boundary_impulse[2] - pushed) / (10000 * dt), half_layer - weight, 1e-4 * weight);
  // Pressures balance the weight to their rounding.
  EXPECT_NEAR(fluid.account.rest_impulse[2], 0, 1e-11 * 101325 * 0.017 * 0.017 * fluid.time);
}

TEST(Sleeping, PulseUnderTheWaterlineRunsAsInAFluidAwakeWithinTheThreshold) {
  Fluid asleep = tank(threshold), awake = tank(0);
  for (Fluid* fluid : {&asleep, &awake}) settle_down(*fluid);
  ASSERT_EQ(asleep.sleeping.cells_awake, 0u);
  for (Fluid* fluid : {&asleep, &awake}) disturb(*fluid, {0.006, 0.007, -0.012}, 1e-4);
  const double mass = mass_of(asleep, water), gas = mass_of(asleep, air), sum = asleep.account.energy_sum(),
               kept = awake.account.energy_sum();
  const Difference difference = largest_difference(asleep, awake, 64, "pulse");
  EXPECT_LT(difference.pressure, threshold);
  EXPECT_LT(difference.velocity, threshold);
  EXPECT_LT(asleep.sleeping.share_awake(), 0.8);
  EXPECT_NEAR(mass_of(asleep, water), mass, 1e-13 * mass);
  EXPECT_NEAR(mass_of(asleep, air), gas, 1e-13 * gas);
  // The account closes as well as that of the fluid awake.
  EXPECT_NEAR(asleep.account.energy_sum() - sum, awake.account.energy_sum() - kept, 1e-12 * std::abs(sum));
}

TEST(Sleeping, CavityOpensAsInAFluidAwake) {
  Fluid asleep = tank(threshold), awake = tank(0);
  // Thinned by 1e-3: 2 MPa of tension if the water bore it.
  for (Fluid* fluid : {&asleep, &awake}) settle_down(*fluid);
  ASSERT_EQ(asleep.sleeping.cells_awake, 0u);
  for (Fluid* fluid : {&asleep, &awake}) disturb(*fluid, {0.006, 0.007, -0.012}, -1e-3);
  largest_difference(asleep, awake, 1, "first step of the cavity");
  EXPECT_EQ(asleep.bulk_modulus[asleep.grid.at(7, 8, 21)], 0);
  const Difference difference = largest_difference(asleep, awake, 63, "cavity");
  EXPECT_LT(difference.pressure, threshold);
  EXPECT_LT(difference.velocity, threshold);
  EXPECT_LT(asleep.sleeping.share_awake(), 0.9);
}

// Forces on nodes held at the border, what flows into them, motion that falls asleep, the pull of a part that sleeps
// out of balance: each is taken where it is dropped, so the sums are as constant as their rounding.
TEST(Sleeping, MomentumAndEnergyCloseWhilePartsWakeUpAndFallAsleep) {
  Fluid fluid = tank(1e-5, 32, 24, 8);
  settle_down(fluid);
  ASSERT_EQ(fluid.sleeping.cells_awake, 0u);
  disturb(fluid, {0.006, 0.007, -0.012}, 1e-4);
  const double dt = 0.7 * stable_step(fluid), energy = fluid.account.energy_sum(), pressed = 101325 * 0.032 * 0.032;
  const std::array<double, 3> first{momentum_sum(fluid, 0), momentum_sum(fluid, 1), momentum_sum(fluid, 2)};
  const double before = fluid.account.put_to_rest;
  double open = 0, dropped = 0, held = 0;
  bool fell_asleep = false;
  for (int n = 1; n <= 160; ++n) {
    const std::vector<unsigned char> awake = fluid.sleeping.awake;
    step(fluid, dt, {});
    for (std::size_t b = 0; b < awake.size(); ++b) fell_asleep |= awake[b] > fluid.sleeping.awake[b];
    if (!fell_asleep) held = fluid.account.put_to_rest - before;
    for (int d = 0; d < 3; ++d) {
      open = std::max(open, std::abs(momentum_sum(fluid, d) - first[d]) / (n * dt * pressed));
      dropped = std::max(dropped, std::abs(fluid.account.rest_impulse[d]) / (n * dt * pressed));
    }
    ASSERT_NEAR(fluid.account.energy_sum(), energy, 1e-14 * energy);
  }
  std::printf("momentum closes within %.1e of the atmosphere's on the tank, %.1e was dropped\n", open, dropped);
  EXPECT_LT(open, 1e-13);
  EXPECT_GT(dropped, 1e-3);
  EXPECT_GT(held, 1e3 * before);  // motion that flowed into nodes at the border, before any had fallen asleep
  EXPECT_TRUE(fell_asleep);
  EXPECT_GT(fluid.account.put_to_rest, 0.01 * fluid.account.kinetic);
}

TEST(Sleeping, MomentumClosesWhileAllSleepsOutOfBalance) {
  Fluid fluid = tank(1e-3, 17, 20, 9);
  disturb(fluid, {0.006, 0.007, -0.012}, 2e-4);
  const double dt = 0.7 * stable_step(fluid), pressed = 101325 * 0.017 * 0.017;
  for (int n = 0; n < 400 && fluid.sleeping.cells_awake > 0; ++n) step(fluid, dt, {});
  ASSERT_EQ(fluid.sleeping.cells_awake, 0u);
  std::array<double, 3> first{}, before{};
  for (int d = 0; d < 3; ++d) {
    first[d] = momentum_sum(fluid, d);
    before[d] = fluid.account.rest_impulse[d];
  }
  for (int n = 0; n < 1000; ++n) step(fluid, dt, {});
  double dropped = 0;
  for (int d = 0; d < 3; ++d) {
    EXPECT_NEAR(momentum_sum(fluid, d), first[d], 1e-13 * 1000 * dt * pressed);
    dropped = std::max(dropped, std::abs(fluid.account.rest_impulse[d] - before[d]));
  }
  EXPECT_GT(dropped, 1e-4 * 1000 * dt * pressed);
}

TEST(Sleeping, IsRefusedWhereEveryCellIsSwept) {
  polynya::fluid::Setup setup;
  setup.sleeping_threshold = threshold;
  setup.sweeps = Sweeps::all_orders;
  const auto line = even_line(0, 0.01, 4);
  EXPECT_THROW(Fluid(Grid(line, line, line), setup), std::invalid_argument);
}

TEST(Sleeping, EndsAStepOfAGridThatMoves) {
  Fluid fluid = tank(threshold, 17, 20, 9);
  settle_down(fluid);
  ASSERT_FALSE(fluid.sleeping.all_awake);
  fluid.motion.prescribed[2].speed = {1, 1};  // past prescribe_motion, which refuses it
  EXPECT_THROW(step(fluid, 0.7 * stable_step(fluid), {}), std::logic_error);
}

TEST(Sleeping, InterfaceCrossesWhereTheFluidSlept) {
  Fluid asleep = tube(threshold), awake = tube(0);
  const double dt = 0.35 * stable_step(awake);
  const auto reached = [&](int j) { return asleep.material[0].mass[asleep.grid.at(2, j, 1)] > 0; };
  const auto sleeps = [&](int j) { return asleep.sleeping.cells[static_cast<std::size_t>(j + (length + 3))].empty(); };
  bool slept = false;
  double largest = 0;
  for (int n = 0; n < 420; ++n) {
    step(asleep, dt, {});
    step(awake, dt, {});
    slept = slept || sleeps(112);
    ASSERT_FALSE(sleeps(112) && reached(110));
    for (int j = 1; j <= length; ++j) {
      const std::ptrdiff_t c = asleep.grid.at(2, j, 1);
      largest = std::max(largest, std::abs(asleep.predicted_pressure[c] - awake.predicted_pressure[c]) / 1e5);
      EXPECT_NEAR(asleep.material[0].volume[c], awake.material[0].volume[c], 1e-5 * asleep.grid.cell_volume[c]);
    }
  }
  std::printf("interface: difference %.1e of the lower pressure, %.0f %% awake\n", largest,
              100 * asleep.sleeping.share_awake());
  EXPECT_TRUE(slept);
  EXPECT_TRUE(reached(112));
  EXPECT_LT(largest, threshold);
}

TEST(Sleeping, BodyThatComesWakesTheWaterBeforeItsWallsReachIt) {
  Fluid fluid = tank(threshold);
  const double dt = 0.7 * stable_step(fluid);
  for (int n = 0; n < long_enough_to_sleep; ++n) step(fluid, dt, {});
  ASSERT_EQ(fluid.sleeping.cells_awake, 0u);
  const Overlap ball = overlap_of(fluid.grid, Box{{0.010, 0.010, -0.020}, {0.014, 0.014, -0.016}}, {});
  step(fluid, dt, ball);
  for (const WallPiece& wall : fluid.after.walls) {
    int i, j, k;
    fluid.grid.position(wall.cell, i, j, k);
    for (const int y : {j - 8, j, j + 8}) {
      for (const int z : {k - 8, k, k + 8}) {
        const Span row = fluid.sleeping.cells[static_cast<std::size_t>(y + (fluid.grid.ny + 3) * z)];
        EXPECT_TRUE(row.holds(i - 8) && row.holds(i + 8));
      }
    }
  }
  EXPECT_GT(fluid.sleeping.cells_awake, 0u);
  EXPECT_LT(fluid.sleeping.cells_awake, fluid.grid.cells());
}

TEST(Sleeping, NumberOfThreadsChangesNoBit) {
  const auto run = [](int threads) {
    const int before = omp_get_max_threads();
    omp_set_num_threads(threads);
    Fluid fluid = tank(threshold, 24, 24, 12);
    settle_down(fluid);
    disturb(fluid, {0.004, 0.004, -0.006}, 1e-4);
    const double dt = 0.7 * stable_step(fluid);
    for (int n = 0; n < 48; ++n) step(fluid, dt, {});
    omp_set_num_threads(before);
    return fluid;
  };
  const Fluid one = run(1);
  EXPECT_LT(one.sleeping.share_awake(), 0.95);
  for (const int threads : {2, 3}) {
    const Fluid more = run(threads);
    EXPECT_EQ(one.sleeping.awake, more.sleeping.awake);
    for (int d = 0; d < 3; ++d) EXPECT_EQ(one.velocity[d], more.velocity[d]);
    for (int m = 0; m < 2; ++m) {
      EXPECT_EQ(one.material[m].mass, more.material[m].mass);
      EXPECT_EQ(one.material[m].energy, more.material[m].energy);
    }
    EXPECT_EQ(one.account.energy_sum(), more.account.energy_sum());
  }
}
