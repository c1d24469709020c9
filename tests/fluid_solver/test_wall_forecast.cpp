// What the fluid expects to do to walls in its next step is what that step does.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fluid_solver/wall_forecast.hpp"
#include "tests/fluid_solver/analytic_overlap.hpp"

using namespace polynya::fluid;
using namespace polynya::fluid::test;

namespace {

constexpr double side = 0.02, cell = side / 12;

std::vector<std::int64_t> walled(const Overlap& overlap) {
  std::vector<std::int64_t> cells;
  for (std::size_t m = 0; m < overlap.cell.size(); ++m) {
    const auto area = overlap.wall_area.begin() + static_cast<std::ptrdiff_t>(6 * m);
    if (std::any_of(area, area + 6, [](double a) { return a != 0; })) cells.push_back(overlap.cell[m]);
  }
  return cells;
}

/// A box in water whose walls swing along z with 0.02 m/s, too slowly to cavitate; its upper wall is at `top` of
/// the cells' height.
struct SwingingBox {
  Fluid fluid;
  double top, dt, rise = 0, speed = 0;

  explicit SwingingBox(double top_of_cell) : fluid(water()), top(top_of_cell) {
    fill_hydrostatic(fluid, overlap(0, 0), 1.0);
    dt = stable_step(fluid);
  }
  static Fluid water() {
    Setup setup;
    setup.boundary.fill(Boundary::non_reflecting);
    const auto line = even_line(0, side, 12);
    return {Grid(line, line, line), setup};
  }
  Overlap overlap(double height, double velocity) const {
    const Box box{{3.3 * cell, 3.6 * cell, 3.7 * cell + height}, {8.4 * cell, 8.1 * cell, (8 + top) * cell + height}};
    return overlap_of(fluid.grid, box, {0, 0, velocity});
  }
  double speed_at(int n) const { return 0.02 * std::sin(std::numbers::pi * n / 20); }
  /// One step with a given speed of the walls. Returns the pressure at the walls and the cells that hold them.
  std::pair<std::vector<double>, std::vector<std::int64_t>> go(double with) {
    speed = with;
    rise += dt * with;
    const Overlap next = overlap(rise, with);
    step(fluid, dt, next);
    std::vector<double> value, gradient;
    overlap_pressure(fluid, walled(next), value, gradient);
    return {value, walled(next)};
  }
  /// Cells of the upper wall, away from its edges.
  bool on_top(std::int64_t number) const {
    const int i = static_cast<int>(number % 12), j = static_cast<int>(number / 12 % 12),
              k = static_cast<int>(number / 144);
    return k == 8 && i >= 4 && i <= 7 && j >= 4 && j <= 7;
  }
};

double largest(const std::vector<double>& values) {
  double most = 0;
  for (const double v : values) most = std::max(most, std::abs(v));
  return most;
}

}  // namespace

class ForecastOfWalls : public testing::TestWithParam<double> {};

TEST_P(ForecastOfWalls, IsThePressureOfTheNextStepIfNothingChanges) {
  SwingingBox box(GetParam());
  for (int n = 0; n < 12; ++n) box.go(box.speed_at(n));
  double worst = 0, scale = 0;
  for (int n = 12; n < 30; ++n) {
    const auto cells = walled(box.overlap(box.rise, 0));
    const auto expected = forecast_walls(box.fluid, cells, box.dt);
    SwingingBox same = box;
    const auto [found, there] = same.go(box.speed);
    ASSERT_EQ(cells, there);
    for (std::size_t w = 0; w < cells.size(); ++w) worst = std::max(worst, std::abs(found[w] - expected.pressure[w]));
    scale = std::max(scale, largest(found));
    box.go(box.speed_at(n));
  }
  std::printf("upper wall at %.2f of a cell: error %.0f Pa of %.0f Pa\n", GetParam(), worst, scale);
  EXPECT_LT(worst, 0.15 * scale);
}

TEST_P(ForecastOfWalls, ImpedanceIsWhatFasterWallsAddAndNotLess) {
  SwingingBox box(GetParam());
  for (int n = 0; n < 12; ++n) box.go(box.speed_at(n));
  const auto cells = walled(box.overlap(box.rise, 0));
  const auto expected = forecast_walls(box.fluid, cells, box.dt);
  SwingingBox same = box, faster = box;
  constexpr double more = 0.001;  // m/s
  const auto slow = same.go(box.speed).first, fast = faster.go(box.speed + more).first;
  double added = 0, due = 0;
  int count = 0;
  for (std::size_t w = 0; w < cells.size(); ++w) {
    EXPECT_LT(std::abs(fast[w] - slow[w]), 1.02 * more * expected.impedance[w]) << w;
    if (!box.on_top(cells[w])) continue;
    added += fast[w] - slow[w];
    due += more * expected.impedance[w];
    ++count;
  }
  std::printf("upper wall at %.2f of a cell: %.3f of the impedance, itself %.2f density x sound speed\n", GetParam(),
              added / due, due / (count * more * 1000 * 1480));
  EXPECT_EQ(count, 16);
  EXPECT_GT(added, 0.8 * due);
}

INSTANTIATE_TEST_SUITE_P(AnywhereInACell, ForecastOfWalls, testing::Values(0.1, 0.45, 0.55, 0.9));

namespace {

Fluid tank() {
  Setup setup;
  setup.gravity = 9.81;
  setup.boundary.fill(Boundary::wall);
  setup.boundary[5] = Boundary::non_reflecting;
  return {Grid(even_line(0, 0.02, 2), even_line(0, 0.02, 2), even_line(-0.1, 0.05, 15)), setup};
}

}  // namespace

TEST(ThinFilm, PressesAsTheFluidInFrontOfIt) {
  // The lower face of a plate lies in a plane of the grid, but for less than a cell can hold fluid: on either side.
  std::array<double, 3> force{}, expected{};
  for (int n = 0; n < 3; ++n) {
    Fluid fluid = tank();
    const double face = (n - 1) * 1e-12;
    const Overlap overlap = overlap_of(fluid.grid, Box{{-1, -1, face}, {1, 1, 0.02}}, {});
    fill_hydrostatic(fluid, overlap, 0.018);
    for (int s = 0; s < 3; ++s) step(fluid, 0.5 * stable_step(fluid), overlap);
    const auto cells = walled(overlap);
    std::vector<double> value, gradient;
    overlap_pressure(fluid, cells, value, gradient);
    const WallForecast forecast = forecast_walls(fluid, cells, stable_step(fluid));
    for (std::size_t m = 0; m < overlap.cell.size(); ++m) {
      const auto at = std::find(cells.begin(), cells.end(), overlap.cell[m]);
      if (at == cells.end()) continue;
      const std::size_t w = static_cast<std::size_t>(at - cells.begin());
      const double area = overlap.wall_area[6 * m + 2];  // upward into the plate below it
      const double height =
          fluid.grid.centre_z(static_cast<int>(fluid.grid.from_message(overlap.cell[m]) / fluid.grid.sz));
      if (area <= 0) continue;
      force[n] += area * (value[w] + gradient[w] * (height - face));
      expected[n] += area * (forecast.pressure[w] + gradient[w] * (height - face));
    }
  }
  std::printf("force of water on the plate %.6f N, %.6f, %.6f\n", force[0], force[1], force[2]);
  EXPECT_GT(force[0], 0.02 * 0.02 * 1000 * 9.81 * 0.013);
  for (const double f : {force[1], force[2], expected[0], expected[1], expected[2]})
    EXPECT_NEAR(f, force[0], 1e-4 * force[0]);
}
