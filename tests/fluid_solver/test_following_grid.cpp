// A grid that goes along with a body that cuts it: its motion alone does nothing to fluid and body.
#include <gtest/gtest.h>

#include "fluid_solver/fluid.hpp"
#include "tests/fluid_solver/analytic_overlap.hpp"

using namespace polynya::fluid;
using namespace polynya::fluid::test;

namespace {

constexpr double side = 0.02;
constexpr int cells = 12;

polynya::fluid::Setup open_setup(Vector ambient, double gravity = 0, double pressure = 101325) {
  polynya::fluid::Setup setup;
  setup.atmospheric_pressure = pressure;
  setup.boundary.fill(Boundary::non_reflecting);
  setup.ambient_velocity = ambient;
  setup.gravity = gravity;
  return setup;
}

/// The grid where its planes across z stand after this way.
Grid grid_at(double way, double height = side) {
  const int layers = static_cast<int>(std::lround(cells * height / side));
  return {even_line(0, side, cells), even_line(0, side, cells), even_line(way, height + way, layers)};
}

Box moved(Box box, double t, Vector v) {
  for (int d = 0; d < 3; ++d) {
    box.low[d] += v[d] * t;
    box.high[d] += v[d] * t;
  }
  return box;
}
constexpr Box body{{0.00612, 0.0071, 0.0058}, {0.01342, 0.0132, 0.0125}};

double largest_pressure_change(const Fluid& fluid) {
  double most = 0;
  for (std::size_t c = 0; c < fluid.density.size(); ++c)
    if (fluid.density[c] > 0) most = std::max(most, std::abs(fluid.predicted_pressure[c] - 101325));
  return most;
}

}  // namespace

TEST(FollowingGrid, BodyAndStreamMovingTogetherFeelNothingOfAGridOfAnySpeed) {
  const Vector v{23, 17, 40};
  for (const double speed : {40.0, 15.0, -20.0}) {
    Fluid fluid(grid_at(0), open_setup(v));
    fill_hydrostatic(fluid, overlap_of(fluid.grid, body, v), 1.0, v);
    let_grid_follow(fluid);
    EXPECT_NEAR(follow_vehicle(fluid), 40, 1e-9);
    const double dt = 0.7 * stable_step(fluid);
    double worst = 0;
    for (int n = 0; n < 200; ++n) {
      const double next = fluid.time + dt;
      follow_to(fluid, speed * next);
      step(fluid, dt, overlap_of(grid_at(speed * next), moved(body, next, v), v));
      worst = std::max(worst, largest_pressure_change(fluid));
    }
    const double scale = 1000 * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    std::printf("grid at %g m/s: largest pressure error %.1e rho V^2\n", speed, worst / scale);
    EXPECT_LT(worst / scale, 1e-7) << speed;
    EXPECT_NEAR(fluid.grid.z[0], speed * fluid.time, 1e-12);
  }
}

TEST(FollowingGrid, BodyAtRestUnderWaterKeepsItsBuoyancyWhileTheGridPasses) {
  const double gravity = 9.81, speed = 40;
  Fluid fluid(grid_at(0), open_setup({}, gravity));
  fill_hydrostatic(fluid, overlap_of(fluid.grid, body, {}), 1.0);
  let_grid_follow(fluid);
  const double dt = 0.7 * stable_step(fluid);
  const Account start = fluid.account;
  double fastest = 0;
  for (int n = 0; n < 200; ++n) {
    const double way = speed * (fluid.time + dt);
    follow_to(fluid, way);
    step(fluid, dt, overlap_of(grid_at(way), body, {}));
  }
  for (std::size_t n = 0; n < fluid.density.size(); ++n)
    if (fluid.node_mass[n] > 0)
      fastest = std::max(fastest, std::hypot(fluid.velocity[0][n], fluid.velocity[1][n], fluid.velocity[2][n]));
  double volume = 1;
  for (int d = 0; d < 3; ++d) volume *= body.high[d] - body.low[d];
  const double lift = (fluid.account.body_impulse[0][2] - start.body_impulse[0][2]) / fluid.time;
  std::printf("fastest %.1e m/s, lift over buoyancy %.4f, grid %.1f cells on\n", fastest,
              lift / (1000 * gravity * volume), speed * fluid.time / (side / cells));
  EXPECT_GT(speed * fluid.time, 1.5 * side / cells);
  EXPECT_LT(fastest, 1e-6);
  EXPECT_NEAR(lift, 1000 * gravity * volume, 0.001 * 1000 * gravity * volume);
}

TEST(FollowingGrid, BooksCloseInEveryStep) {
  const Vector v{3, -2, 40};
  Fluid fluid(grid_at(0), open_setup({}, 9.81));
  fill_hydrostatic(fluid, overlap_of(fluid.grid, body, v), 0.0151);
  start_potential_flow(fluid);
  let_grid_follow(fluid);
  const double dt = 0.7 * stable_step(fluid), scale = 1000 * side * side * side * 40;
  const auto momentum = [](const Account& a, int d) {
    return a.momentum[d] + a.body_impulse[0][d] + a.body_impulse[1][d] + a.boundary_impulse[d] + a.node_fix_impulse[d] +
           (d == 2 ? a.gravity_impulse : 0.0);
  };
  double way = 0;
  Account last = fluid.account;
  const Account first = last;
  for (int n = 0; n < 200; ++n) {
    way += dt * follow_vehicle(fluid);
    follow_to(fluid, way);
    step(fluid, dt, overlap_of(grid_at(way), moved(body, fluid.time + dt, v), v));
    const Account& now = fluid.account;
    EXPECT_NEAR(now.energy_sum(), last.energy_sum(), 1e-11 * scale * 40) << n;
    for (int d = 0; d < 3; ++d) EXPECT_NEAR(momentum(now, d), momentum(last, d), 1e-11 * scale) << n << " axis " << d;
    for (int m = 0; m < 2; ++m)
      EXPECT_NEAR(now.mass[m] + now.boundary_mass[m], last.mass[m] + last.boundary_mass[m], 1e-12 * first.mass[0]) << n;
    last = now;
    if (HasFailure()) return;
  }
  EXPECT_NEAR(way, 40 * fluid.time, 1e-9);
}

TEST(FollowingGrid, SphereAndGridThatMoveTogetherFeelWhatASphereInAStreamDoes) {
  // The same flow seen by two observers: what differs are the walls' and the grid's speeds, not that of one past the
  // other.
  const double speed = 40, radius = 0.0047;
  const Vector centre{0.5 * side, 0.5 * side, 0.5 * side};
  const auto ball = [&](double way) { return solid(sphere({centre[0], centre[1], centre[2] + way}, radius), 24); };
  const auto cut = [&](const Grid& grid, double way, Vector v) {
    return overlap_of(grid, ball(way), v, {centre[0] - radius, centre[1] - radius, centre[2] - radius + way},
                      {centre[0] + radius, centre[1] + radius, centre[2] + radius + way});
  };
  constexpr double pressure = 5e6;  // so much that nothing cavitates: whether a cell does would hang on rounding
  Fluid still(grid_at(0), open_setup({0, 0, -speed}, 0, pressure)), moving(grid_at(0), open_setup({}, 0, pressure));
  fill_hydrostatic(still, cut(still.grid, 0, {}), 1.0, {0, 0, -speed});
  fill_hydrostatic(moving, cut(moving.grid, 0, {0, 0, speed}), 1.0);
  let_grid_follow(moving);
  follow_vehicle(moving);  // the start's damping goes by the stable step, and that by the speed past the planes
  std::printf("potential flow: %d and %d iterations\n", start_potential_flow(still), start_potential_flow(moving));
  const double dt = 0.6 * stable_step(still);
  double worst = 0;
  for (int n = 0; n < 100; ++n) {
    step(still, dt, cut(still.grid, 0, {}));
    const double way = speed * (moving.time + dt);
    follow_to(moving, way);
    step(moving, dt, cut(grid_at(way), way, {0, 0, speed}));
    for (std::size_t c = 0; c < still.density.size(); ++c)
      if (still.density[c] > 0)
        worst = std::max(worst, std::abs(still.predicted_pressure[c] - moving.predicted_pressure[c]));
  }
  std::printf("largest difference of pressure: %.1e rho V^2 / 2\n", worst / (500 * speed * speed));
  EXPECT_LT(worst, 1e-8 * 500 * speed * speed);
}

TEST(FollowingGrid, WhatCannotFollowIsRefused) {
  const auto refused = [](polynya::fluid::Setup setup, const std::string& words) {
    Fluid fluid(grid_at(0), setup);
    try {
      let_grid_follow(fluid);
      FAIL() << words;
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  };
  polynya::fluid::Setup setup = open_setup({});
  setup.boundary[5] = Boundary::wall;
  refused(setup, "open at its ends along z");
  setup = open_setup({});
  setup.sweeps = Sweeps::all_orders;
  refused(setup, "alternating orders");
  setup = open_setup({});
  setup.sleeping_threshold = 1e-7;
  refused(setup, "nothing sleeps");
  Fluid fluid(grid_at(0), open_setup({}));
  fill_hydrostatic(fluid, {}, 1.0);
  let_grid_follow(fluid);
  EXPECT_EQ(follow_vehicle(fluid), 0);  // there is no wall
  follow_to(fluid, 0.6 * side / cells);
  EXPECT_THROW(step(fluid, 1e-7, {}), FluidError);
}
