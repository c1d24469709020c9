// A sphere at rest, under water and across the waterline: ten thousand steps stir nothing, and it is carried by the
// weight of the water that it displaces.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fluid_solver/fluid.hpp"
#include "tests/fluid_solver/analytic_overlap.hpp"

using namespace polynya::fluid;
using namespace polynya::fluid::test;

namespace {

constexpr double radius = 0.005, gravity = 9.81;

struct Rest {
  double speed;     ///< largest of a node, m/s
  double buoyancy;  ///< of the whole sphere, mean over the last fifth of the steps, N
};

Rest rest(int across, double depth, int steps) {
  Setup setup;
  setup.gravity = gravity;
  setup.boundary = {Boundary::wall,           Boundary::non_reflecting, Boundary::wall,
                    Boundary::non_reflecting, Boundary::non_reflecting, Boundary::non_reflecting};
  const double h = 2 * radius / across;
  const int n = across;
  Fluid fluid{Grid(even_line(0, n * h, n), even_line(0, n * h, n), even_line(-2.5 * n * h, 1.5 * n * h, 4 * n)), setup};
  const Overlap overlap = overlap_of(fluid.grid, sphere({0, 0, -depth}, radius), {}, radius);
  fill_hydrostatic(fluid, overlap, 0.0);
  const double dt = 0.8 * stable_step(fluid);
  double given = 0, time = 0;
  for (int s = 0; s < steps; ++s) {
    if (s == steps - steps / 5)
      given = fluid.account.body_impulse[0][2] + fluid.account.node_fix_impulse[2], time = fluid.time;
    step(fluid, dt, overlap);
  }
  double fastest = 0;
  for (const auto& component : fluid.velocity)
    for (const double u : component) fastest = std::max(fastest, std::abs(u));
  const double pressed = fluid.account.body_impulse[0][2] + fluid.account.node_fix_impulse[2] - given;
  // Pressures act at centres of cells here; their gradient over each wall is what `overlap_pressure` gives beside them.
  std::vector<double> value, gradient;
  overlap_pressure(fluid, overlap.cell, value, gradient);
  double moment = 0;
  for (std::size_t m = 0; m < overlap.cell.size(); ++m) {
    int i, j, k;
    fluid.grid.position(fluid.grid.from_message(overlap.cell[m]), i, j, k);
    const double low = fluid.grid.z[static_cast<std::size_t>(k) - 1], high = fluid.grid.z[static_cast<std::size_t>(k)];
    // Integral of (z - centre) over the wall's vertical area by Gauss: free volume less what columns on both sides
    // hold.
    const std::ptrdiff_t c = fluid.grid.at(i, j, k);
    const double area = fluid.grid.dx[i] * fluid.grid.dy[j], middle = 0.5 * (low + high);
    const double solid = overlap.solid_volume[m];
    const double top = (1 - fluid.after.open[2][c + fluid.grid.sz]) * area,
                 bottom = (1 - fluid.after.open[2][c]) * area;
    const double first_moment = solid - (top * (high - middle) - bottom * (low - middle));
    moment += gradient[m] * first_moment;
  }
  return {fastest, 4 * (pressed / (fluid.time - time) + moment)};
}

/// Weight of the water and of the air that the sphere displaces.
double exact_buoyancy(double depth) {
  const double cap = radius + std::min(radius, depth);  // height of the part under water
  const double under = std::numbers::pi * cap * cap * (3 * radius - cap) / 3,
               whole = 4 * std::numbers::pi * std::pow(radius, 3) / 3;
  return gravity * (1000.05 * under + 1.2 * (whole - under));
}

void expect_carried(const char* where, double depth, int steps) {
  const Rest coarse = rest(8, depth, steps), fine = rest(16, depth, steps / 10);
  const double exact = exact_buoyancy(depth);
  std::printf("%s: %.1e m/s after %d steps; buoyancy %+.3f %% at 8, %+.3f %% at 16 cells per diameter\n", where,
              coarse.speed, steps, 100 * (coarse.buoyancy / exact - 1), 100 * (fine.buoyancy / exact - 1));
  EXPECT_LT(coarse.speed, 1e-5 * 340);  // of the slower sound, that of air
  EXPECT_LT(std::abs(coarse.buoyancy / exact - 1), 0.005);
  EXPECT_LT(std::abs(fine.buoyancy / exact - 1), std::max(1e-4, 0.7 * std::abs(coarse.buoyancy / exact - 1)));
}

}  // namespace

TEST(Buoyancy, SubmergedSphereIsCarriedAndStirsNothing) {
  expect_carried("submerged", 0.0081, 10000);
}

TEST(Buoyancy, FloatingSphereIsCarriedAndStirsNothing) {
  expect_carried("floating", 0.0013, 10000);
}
