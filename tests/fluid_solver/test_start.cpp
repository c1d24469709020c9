// The start as a potential flow: the kinetic energy of a sphere's added mass.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "fluid_solver/fluid.hpp"
#include "tests/fluid_solver/analytic_overlap.hpp"

using namespace polynya::fluid;
using namespace polynya::fluid::test;

namespace {

constexpr double radius = 0.005, speed = 40;

/// A quarter of a sphere in a domain of twelve radii.
Fluid quarter(int cells_per_diameter) {
  Setup setup;
  setup.boundary = {Boundary::wall,           Boundary::non_reflecting, Boundary::wall,
                    Boundary::non_reflecting, Boundary::non_reflecting, Boundary::non_reflecting};
  setup.pressure_floor = {-1e300, 0};  // no cavitation: the formula knows none
  const double h = 2 * radius / cells_per_diameter;
  const int n = 3 * cells_per_diameter;
  return {Grid(even_line(0, n * h, n), even_line(0, n * h, n), even_line(-n * h, n * h, 2 * n)), setup};
}

}  // namespace

TEST(PotentialFlow, SphereHasHalfItsDisplacedMass) {
  Fluid fluid = quarter(8);
  // Not symmetric to the grid: the centre is off the planes.
  fill_hydrostatic(fluid, overlap_of(fluid.grid, sphere({0, 0, 0.00037}, radius), {0, 0, speed}, radius), 1.0);
  start_potential_flow(fluid);
  const double displaced = 1000 * 4.0 / 3 * std::numbers::pi * std::pow(radius, 3);
  const double exact = 0.5 * 0.5 * displaced * speed * speed;
  EXPECT_NEAR(4 * fluid.account.kinetic, exact, 0.08 * exact);
}

namespace {

constexpr double stagnation_pressure = 0.5 * 1000 * speed * speed;

/// The sphere started and moved on at constant speed; after every step visit(step, overlap).
template <class Visit>
Fluid move_on(int cells_per_diameter, int steps, Visit&& visit) {
  Fluid fluid = quarter(cells_per_diameter);
  const double dt = 2e-6 / cells_per_diameter;
  const auto at = [&](double t) {
    return overlap_of(fluid.grid, sphere({0, 0, 0.00037 + speed * t}, radius), {0, 0, speed}, radius);
  };
  fill_hydrostatic(fluid, at(0), 1.0);
  start_potential_flow(fluid);
  adapt_potential_flow(fluid, at(0), at(dt), 1.0);
  for (int n = 1; n <= steps; ++n) {
    const Overlap overlap = at(n * dt);
    step(fluid, dt, overlap);
    visit(fluid, n, overlap);
  }
  return fluid;
}

/// Largest error, over 12 bands of equal height, of the pressure averaged over the band's area and over the time in
/// which the sphere crosses a cell; in stagnation pressures. Potential flow: p = rho V^2/2 (1 - 9/4 sin^2).
double band_error(int cells_per_diameter) {
  std::array<double, 12> area{}, force{};
  const int steps = 25 * cells_per_diameter;
  move_on(cells_per_diameter, steps, [&](const Fluid& fluid, int n, const Overlap& overlap) {
    if (n <= steps / 2) return;
    std::vector<double> value, gradient;
    overlap_pressure(fluid, overlap.cell, value, gradient);
    for (std::size_t m = 0; m < value.size(); ++m) {
      const double* a = overlap.wall_area.data() + 6 * m;
      const double size = std::hypot(a[0], a[1], a[2]);
      if (size == 0) continue;
      const std::size_t band = std::min<std::size_t>(11, static_cast<std::size_t>(6 * (1 + a[2] / size)));
      area[band] += size;
      force[band] += size * value[m] / stagnation_pressure;
    }
  });
  double worst = 0;
  for (int band = 0; band < 12; ++band) {
    const double cosine = 1 - (band + 0.5) / 6;
    worst = std::max(worst, std::abs(force[band] / area[band] - (1 - 2.25 * (1 - cosine * cosine))));
  }
  return worst;
}

}  // namespace

TEST(PotentialFlow, FirstStepsStayBelowStagnationPressure) {
  double worst = 0;
  move_on(8, 10, [&](const Fluid& fluid, int, const Overlap& overlap) {
    std::vector<double> value, gradient;
    overlap_pressure(fluid, overlap.cell, value, gradient);
    for (const double p : value) worst = std::max(worst, p);
  });
  // An impulsive start would give 59 MPa, 74 times the stagnation pressure.
  EXPECT_LT(worst, 1.2 * stagnation_pressure);
}

TEST(PotentialFlow, PressureAroundASphereFallsTowardsTheory) {
  const double coarse = band_error(6), fine = band_error(12);
  RecordProperty("error_6", std::to_string(coarse));
  RecordProperty("error_12", std::to_string(fine));
  EXPECT_LT(coarse, 0.6);
  EXPECT_LT(fine, 0.5 * coarse);
}

TEST(PotentialFlow, WaterFlowsThroughTheFarFieldWithoutResistance) {
  // The sphere's flow goes on beyond the boundary. A boundary that answered it with rho c would pull 0.2 MPa and more.
  double initial = 0;
  const Fluid fluid = move_on(8, 80, [&](const Fluid& now, int n, const Overlap&) {
    if (n > 1) return;
    for (int i = 1; i <= now.grid.nx; ++i) initial = std::max(initial, std::abs(now.velocity[2][now.grid.at(i, 1, 1)]));
  });
  double worst = 0;
  for (int j = 1; j <= fluid.grid.ny; ++j) {
    for (int i = 1; i <= fluid.grid.nx; ++i)
      worst = std::max(worst, std::abs(fluid.predicted_pressure[fluid.grid.at(i, j, 1)] - 101325));
  }
  EXPECT_GT(1000 * 1480 * initial, 2e5);
  EXPECT_LT(worst, 0.15 * 1000 * 1480 * initial);
}
