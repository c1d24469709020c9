// Ice that breaks leaves its room at once: the water flows in, as fast as pressure can make it and no faster.
#include <gtest/gtest.h>

#include "fluid_solver/fluid.hpp"
#include "fluid_solver/wall_forecast.hpp"
#include "tests/fluid_solver/analytic_overlap.hpp"

using namespace polynya::fluid;
using namespace polynya::fluid::test;

namespace {

constexpr int cells = 12;
constexpr double cell = 1e-3;
constexpr double pressure = 5e6;  ///< of the water, Pa
constexpr int ice = 1;
constexpr double full_scale = pressure * (cells * cell) * (cells * cell) * (cells * cell);  ///< of energies, J

Fluid water_under_pressure() {
  Setup setup;
  setup.boundary.fill(Boundary::wall);
  setup.atmospheric_pressure = pressure;
  const auto line = even_line(0, cells * cell, cells);
  return {Grid(line, line, line), setup};
}

/// A block whose faces leave films of `film` cells before planes of the grid, up to `top` cells.
Box block(double film, int top) {
  return {{(3 + film) * cell, (3 + film) * cell, (3 + film) * cell},
          {(9 - film) * cell, (9 - film) * cell, (top - film) * cell}};
}

double fastest(const Fluid& fluid) {
  double most = 0;
  for (std::size_t n = 0; n < fluid.density.size(); ++n)
    most = std::max(most, std::hypot(fluid.velocity[0][n], fluid.velocity[1][n], fluid.velocity[2][n]));
  return most;
}

/// Of the fluid and all that it gave away.
double momentum(const Account& a, int d) {
  return a.momentum[d] + a.body_impulse[0][d] + a.body_impulse[1][d] + a.boundary_impulse[d] + a.node_fix_impulse[d];
}

}  // namespace

TEST(Release, WaterFlowsIntoTheRoomOfBrokenIceAtTheSpeedThatItsPressureGives) {
  for (const double film : {1e-3, 1e-5, 1e-7}) {
    Fluid fluid = water_under_pressure();
    fill_hydrostatic(fluid, overlap_of(fluid.grid, block(film, 9), {}, ice), 1.0);
    const double dt = 0.7 * stable_step(fluid);
    step(fluid, dt, overlap_of(fluid.grid, block(film, 9), {}, ice));
    EXPECT_TRUE(fluid.held_faces.empty()) << film;
    const Account start = fluid.account;
    std::size_t held = 0;
    for (int n = 0; n < 40; ++n) {
      const Overlap left = overlap_of(fluid.grid, block(film, 6), {}, ice);
      step(fluid, dt, left);
      held += fluid.held_faces.size();
      // Water beside a void starts with p / (rho c) and ends, in incompressible flow, with sqrt(2 p / rho).
      EXPECT_LT(fastest(fluid), 1.5 * std::sqrt(2 * pressure / 1000)) << film << " step " << n;
      const WallForecast next = forecast_walls(fluid, left.walled, dt);
      for (const double p : next.pressure) EXPECT_LT(p, 3 * pressure) << film << " step " << n;
      const Account& now = fluid.account;
      EXPECT_NEAR(now.energy_sum(), start.energy_sum(), 1e-12 * full_scale) << film << " step " << n;
      EXPECT_NEAR(now.mass[0], start.mass[0], 1e-12 * start.mass[0]) << film << " step " << n;
      for (int d = 0; d < 3; ++d)
        EXPECT_NEAR(momentum(now, d), momentum(start, d), 1e-12 * pressure * cell * cell * dt * 1e6) << film;
      if (HasFailure()) return;
    }
    std::printf("films of %g cells: fastest %.1f m/s, %zu faces held in 40 steps\n", film, fastest(fluid), held);
    EXPECT_GT(fastest(fluid), 0.5 * pressure / (1000 * 1480)) << film;
  }
}

TEST(Release, AirFlowsIntoTheRoomNoFasterThanIntoAVacuum) {
  for (const double film : {1e-3, 1e-5, 1e-7}) {
    Fluid fluid = water_under_pressure();
    fill_hydrostatic(fluid, overlap_of(fluid.grid, block(film, 9), {}, ice), -1.0);
    const double sound =
        std::sqrt(1.4 * fluid.pressure[fluid.grid.at(1, 1, 1)] / fluid.density[fluid.grid.at(1, 1, 1)]);
    const double dt = 0.7 * stable_step(fluid);
    step(fluid, dt, overlap_of(fluid.grid, block(film, 9), {}, ice));
    const Account start = fluid.account;
    std::size_t held = 0;
    double most = 0;
    for (int n = 0; n < 40; ++n) {
      const Overlap left = overlap_of(fluid.grid, block(film, 6), {}, ice);
      step(fluid, dt, left);
      held += fluid.held_faces.size();
      most = std::max(most, fastest(fluid));
      // A gas of this law leaves into a vacuum with 2 / (1.4 - 1) times its speed of sound.
      EXPECT_LT(fastest(fluid), 5 * sound) << film << " step " << n;
      const WallForecast next = forecast_walls(fluid, left.walled, dt);
      for (const double p : next.pressure) EXPECT_LT(p, 3 * pressure) << film << " step " << n;
      EXPECT_NEAR(fluid.account.energy_sum(), start.energy_sum(), 1e-12 * full_scale) << film << " step " << n;
      for (int d = 0; d < 3; ++d)
        EXPECT_NEAR(momentum(fluid.account, d), momentum(start, d), 1e-12 * pressure * cell * cell * dt * 1e6) << film;
      if (HasFailure()) return;
    }
    std::printf("air, films of %g cells: fastest %.0f m/s, sound %.0f m/s, %zu faces held in 40 steps\n", film, most,
                sound, held);
    if (film < 1e-4) {
      EXPECT_GT(held, 0u) << film;
    }
  }
}

TEST(Release, WallsThatMoveHoldNoFace) {
  const Vector v{7, -11, 40};
  Fluid fluid = water_under_pressure();
  const auto at = [&](double t, double film) {
    Box box = block(film, 9);
    for (int d = 0; d < 3; ++d) {
      box.low[d] += v[d] * t;
      box.high[d] += v[d] * t;
    }
    return box;
  };
  for (const double film : {0.0, 1e-6, 1e-3, 0.4}) {
    fill_hydrostatic(fluid, overlap_of(fluid.grid, at(0, film), v), 1.0);
    start_potential_flow(fluid);
    const double dt = 0.7 * stable_step(fluid), start = fluid.time;
    for (int n = 0; n < 120; ++n) {
      step(fluid, dt, overlap_of(fluid.grid, at(fluid.time + dt - start, film), v));
      ASSERT_TRUE(fluid.held_faces.empty()) << film << " step " << n;
    }
    EXPECT_GT(v[2] * (fluid.time - start), cell);  // planes of the grid have been crossed
  }
}
