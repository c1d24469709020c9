// Bodies that cross the grid through still water at constant speed, where potential flow knows no force: what is left
// is the noise of cells that open and close.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fluid_solver/fluid.hpp"
#include "tests/fluid_solver/analytic_overlap.hpp"

using namespace polynya::fluid;
using namespace polynya::fluid::test;

namespace {

constexpr double radius = 0.005, speed = 40;
constexpr int across = 8;  ///< cells per diameter
constexpr double h = 2 * radius / across;

/// Force coefficient along the way, step by step, once the start has died away.
struct Record {
  std::vector<double> coefficient;
  int steps_per_cell = 0;
};

double given(const Fluid& fluid, int axis) {
  return fluid.account.body_impulse[0][axis] + fluid.account.node_fix_impulse[axis];
}

template <class OverlapAt>
Record cross(Fluid& fluid, int axis, double area, OverlapAt&& at) {
  Record record;
  record.steps_per_cell = 128;
  const double dt = h / speed / record.steps_per_cell;
  fill_hydrostatic(fluid, at(0), 1.0);
  start_potential_flow(fluid);
  adapt_potential_flow(fluid, at(0), at(dt), 1.0);
  for (int n = 1; n <= 5 * record.steps_per_cell; ++n) {
    const double before = given(fluid, axis);
    step(fluid, dt, at(n * dt));
    if (n > 2 * record.steps_per_cell)
      record.coefficient.push_back((given(fluid, axis) - before) / (dt * 0.5 * 1000 * speed * speed * area));
  }
  return record;
}

/// Rms about the mean of averages over `window` steps.
double noise(const Record& record, int window) {
  const std::vector<double>& c = record.coefficient;
  std::vector<double> means;
  for (std::size_t n = 0; n + static_cast<std::size_t>(window) <= c.size(); ++n) {
    double sum = 0;
    for (int w = 0; w < window; ++w) sum += c[n + static_cast<std::size_t>(w)];
    means.push_back(sum / window);
  }
  double mean = 0, square = 0;
  for (const double one : means) mean += one / static_cast<double>(means.size());
  for (const double one : means) square += (one - mean) * (one - mean) / static_cast<double>(means.size());
  return std::sqrt(square);
}

void expect_quiet(const char* body, const Record& record) {
  const double step = noise(record, 1), quarter = noise(record, record.steps_per_cell / 4),
               cell = noise(record, record.steps_per_cell);
  double mean = 0;
  for (const double one : record.coefficient) mean += one / static_cast<double>(record.coefficient.size());
  std::printf("%s: noise of the force coefficient %.3f per step, %.4f over h/(4 V), %.4f over h/V; mean %.3f\n", body,
              step, quarter, cell, mean);
  // One period per cell, which averages over a cell hardly see; shorter ones do (docs/limits.md).
  EXPECT_LE(quarter, 0.1);
  EXPECT_LE(cell, 0.01);
}

}  // namespace

TEST(Crossing, CylinderFeelsLittleOfTheCells) {
  // Axis along z, one layer of cells; y = 0 is a plane of symmetry.
  polynya::fluid::Setup setup;
  setup.boundary = {Boundary::non_reflecting, Boundary::non_reflecting, Boundary::wall,
                    Boundary::non_reflecting, Boundary::wall,           Boundary::wall};
  setup.pressure_floor = {-1e300, 0};
  const int n = 40;
  Fluid fluid{Grid(even_line(-n * h, n * h, 2 * n), even_line(0, n * h, n), even_line(0, h, 1)), setup};
  const auto at = [&](double t) {
    const Revolution rod{-2 * h + 0.00037 + speed * t, 0, -h, 2 * h, [](double) { return radius; }};
    return overlap_of(fluid.grid, rod, {speed, 0, 0}, radius);
  };
  expect_quiet("cylinder", cross(fluid, 0, radius * h, at));
}

TEST(Crossing, SphereFeelsLittleOfTheCells) {
  polynya::fluid::Setup setup;
  setup.boundary = {Boundary::wall,           Boundary::non_reflecting, Boundary::wall,
                    Boundary::non_reflecting, Boundary::non_reflecting, Boundary::non_reflecting};
  setup.pressure_floor = {-1e300, 0};
  const int n = 16;
  Fluid fluid{Grid(even_line(0, n * h, n), even_line(0, n * h, n), even_line(-n * h, n * h, 2 * n)), setup};
  const auto at = [&](double t) {
    return overlap_of(fluid.grid, sphere({0, 0, -2 * h + 0.00037 + speed * t}, radius), {0, 0, speed}, radius);
  };
  expect_quiet("sphere", cross(fluid, 2, std::numbers::pi * radius * radius / 4, at));
}
