// The start as a potential flow: the kinetic energy of a sphere's added mass.
#include <gtest/gtest.h>

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
  setup.boundary = {Boundary::wall, Boundary::non_reflecting, Boundary::wall,
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

TEST(PotentialFlow, FirstStepsStayBelowStagnationPressure) {
  Fluid fluid = quarter(8);
  const auto at = [&](double t) {
    return overlap_of(fluid.grid, sphere({0, 0, 0.00037 + speed * t}, radius), {0, 0, speed}, radius);
  };
  const double dt = 2.5e-7;
  fill_hydrostatic(fluid, at(0), 1.0);
  start_potential_flow(fluid);
  adapt_potential_flow(fluid, at(0), at(dt), 1.0);
  std::vector<double> value, gradient;
  double worst = 0;
  for (int n = 1; n <= 10; ++n) {
    const Overlap overlap = at(n * dt);
    step(fluid, dt, overlap);
    overlap_pressure(fluid, overlap, value, gradient);
    for (const double p : value) worst = std::max(worst, p);
  }
  // An impulsive start would give 59 MPa, 74 times the stagnation pressure.
  EXPECT_LT(worst, 2.5 * 0.5 * 1000 * speed * speed);
}
