// The kinetic energy of the flow that a body starts with, against the added mass of potential flow.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fluid_solver/fluid.hpp"
#include "tests/fluid_solver/analytic_overlap.hpp"

using namespace polynya::fluid;
using namespace polynya::fluid::test;

namespace {

constexpr double radius = 0.005, speed = 1;

Setup open_on(std::array<Boundary, 6> boundary) {
  Setup setup;
  setup.boundary = boundary;
  setup.pressure_floor = {-1e300, 0};
  return setup;
}
constexpr Boundary wall = Boundary::wall, open = Boundary::non_reflecting;

/// Of a sphere over the displaced mass; the domain ends at `reach` radii.
double sphere_coefficient(int across, double reach) {
  const double h = 2 * radius / across;
  const int n = static_cast<int>(std::lround(reach * across / 2));
  Fluid fluid{Grid(even_line(0, n * h, n), even_line(0, n * h, n), even_line(-n * h, n * h, 2 * n)),
              open_on({wall, open, wall, open, open, open})};
  fill_hydrostatic(fluid, overlap_of(fluid.grid, sphere({0, 0, 0.296 * h}, radius), {0, 0, speed}, radius), 1.0);
  start_potential_flow(fluid);
  const double displaced = 1000.05 * 4.0 / 3 * std::numbers::pi * std::pow(radius, 3);
  return 4 * fluid.account.kinetic / (0.5 * displaced * speed * speed);
}

/// Of a cylinder across its axis.
double cylinder_coefficient(int across, double reach) {
  const double h = 2 * radius / across;
  const int n = static_cast<int>(std::lround(reach * across / 2));
  Fluid fluid{Grid(even_line(-n * h, n * h, 2 * n), even_line(0, n * h, n), even_line(0, h, 1)),
              open_on({open, open, wall, open, wall, wall})};
  const Revolution rod{0.296 * h, 0, -h, 2 * h, [](double) { return radius; }};
  fill_hydrostatic(fluid, overlap_of(fluid.grid, rod, {speed, 0, 0}, radius), 1.0);
  start_potential_flow(fluid);
  const double displaced = 1000.05 * std::numbers::pi * radius * radius * h;
  return 2 * fluid.account.kinetic / (0.5 * displaced * speed * speed);
}

/// Potential flow around a body in the middle of a round domain of this many radii on whose side the pressure is kept:
/// the dipole and its image.
double confined_sphere(double reach) {
  const double q = std::pow(reach, -3);
  return 0.5 * (1 - q) / (1 + 0.5 * q);
}
double confined_cylinder(double reach) {
  const double q = std::pow(reach, -2);
  return (1 - q) / (1 + q);
}

}  // namespace

TEST(AddedMass, OfASphereIsHalfTheDisplacedMass) {
  const double exact = confined_sphere(5);
  const double coarse = sphere_coefficient(8, 5) / exact - 1, fine = sphere_coefficient(16, 5) / exact - 1;
  std::printf("added mass of a sphere: %+.2f %% at 8, %+.2f %% at 16 cells per diameter\n", 100 * coarse, 100 * fine);
  RecordProperty("coarse", std::to_string(coarse));
  RecordProperty("fine", std::to_string(fine));
  EXPECT_LT(std::abs(coarse), 0.07);
  EXPECT_LT(std::abs(fine), 0.03);
}

TEST(AddedMass, OfACylinderIsTheDisplacedMass) {
  const double exact = confined_cylinder(12);
  const double coarse = cylinder_coefficient(8, 12) / exact - 1, fine = cylinder_coefficient(16, 12) / exact - 1;
  std::printf("added mass of a cylinder: %+.2f %% at 8, %+.2f %% at 16 cells per diameter\n", 100 * coarse, 100 * fine);
  RecordProperty("coarse", std::to_string(coarse));
  RecordProperty("fine", std::to_string(fine));
  EXPECT_LT(std::abs(coarse), 0.07);
  EXPECT_LT(std::abs(fine), 0.03);
}
