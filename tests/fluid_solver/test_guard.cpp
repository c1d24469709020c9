// States and steps without meaning end in one sentence that names fault, cell, place, materials and time.
#include <gtest/gtest.h>

#include <limits>

#include "fluid_solver/equation_range.hpp"
#include "fluid_solver/phases.hpp"
#include "tests/fluid_solver/analytic_overlap.hpp"

using namespace polynya::fluid;
using namespace polynya::fluid::test;

namespace {

/// Water below air in a closed box of 6 x 6 x 12 cells of 1 mm; z = 0 in the middle.
Fluid tank() {
  Setup setup;
  setup.gravity = 9.81;
  setup.boundary.fill(Boundary::wall);
  Fluid fluid(Grid(even_line(0, 0.006, 6), even_line(0, 0.006, 6), even_line(-0.006, 0.006, 12)), setup);
  fill_hydrostatic(fluid, {}, 0);
  return fluid;
}

std::string error_of(Fluid& fluid, double dt) {
  try {
    step(fluid, dt, {});
  } catch (const FluidError& error) {
    return error.what();
  }
  return "no error";
}

void expect_parts(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) EXPECT_NE(text.find(part), std::string::npos) << part << " is not in: " << text;
}

constexpr int wet = 3, dry = 9;
// Cell (3, 4, 3) of 6 x 6 x 12 in the messages' count: 2 + 6 (3 + 6 2).
const std::string wet_place = "in cell 92 at (0.0025, 0.0035, -0.0035) m, time 0 s";
const std::string dry_place = "in cell 308 at (0.0025, 0.0035, 0.0025) m, time 0 s";

}  // namespace

TEST(Guard, NegativeDensityIsNamed) {
  Fluid fluid = tank();
  fluid.material[water].mass[fluid.grid.at(3, 4, wet)] *= -1;
  expect_parts(error_of(fluid, 1e-8), {"negative density of water", "in cell 92", "; water -", "; air 0 kg", "J, "});
}

TEST(Guard, NegativeEnergyOfAirIsNamed) {
  Fluid fluid = tank();
  fluid.material[air].energy[fluid.grid.at(3, 4, dry)] *= -1;
  expect_parts(error_of(fluid, 1e-8), {"negative internal energy of air", "in cell 308 at (0.0025, 0.0035, 0.0025) m",
                                       "time 1e-08 s", "; water 0 kg", "; air "});
}

TEST(Guard, NegativeEnergyOfAirInASharedCellIsNamedBeforeItsPressureIsMadeTheWaters) {
  Fluid fluid = tank();
  fill_hydrostatic(fluid, {}, 0.0025);
  const std::ptrdiff_t c = fluid.grid.at(3, 4, dry);
  ASSERT_GT(fluid.material[water].mass[c], 0);
  EXPECT_TRUE(update_account(fluid));
  fluid.material[air].energy[c] *= -1;
  EXPECT_FALSE(update_account(fluid));
  try {
    check_state(fluid);
    FAIL() << "no error";
  } catch (const FluidError& error) {
    expect_parts(error.what(), {"negative internal energy of air", dry_place});
  }
}

TEST(Guard, WaterBeyondItsShockHugoniotIsNamed) {
  Fluid fluid = tank();
  fluid.setup.gravity = 0;
  fluid.material[water].mass[fluid.grid.at(3, 4, wet)] *= 5;
  expect_parts(error_of(fluid, 1e-12), {"equation of state of water is out of its range: density 5000", wet_place,
                                        "its Mie-Grueneisen law holds up to "});
}

TEST(Guard, TensionBeyondTheSoundSpeedOfWaterIsNamedWhereItDoesNotCavitate) {
  Fluid fluid = tank();
  fluid.setup.pressure_floor[water] = -1e300;
  fluid.material[water].mass[fluid.grid.at(3, 4, wet)] *= 0.4;
  expect_parts(error_of(fluid, 1e-9), {"no real sound speed", wet_place});
}

TEST(Guard, CellThatTheClosingOfItsSidesEmptiesIsNamedAlsoIfItsVolumeGrows) {
  Fluid fluid = tank();
  const std::ptrdiff_t c = fluid.grid.at(3, 4, wet), sz = fluid.grid.sz;
  const double volume = fluid.grid.cell_volume[c];
  fluid.face_rate[0][c] = 0.5 * volume;
  fluid.face_rate[2][c] = -0.9 * volume;
  fluid.face_rate[2][c + sz] = 0.9 * volume;
  fluid.face_rate[1][c] = 0.49 * volume;
  EXPECT_NO_THROW(check_lagrange_volumes(fluid, 1));
  fluid.face_rate[1][c] = 0.51 * volume;
  try {
    check_lagrange_volumes(fluid, 1);
    FAIL() << "no error";
  } catch (const FluidError& error) {
    expect_parts(error.what(), {"the grid folds: a step of 1 s leaves -0.01 of", wet_place, "; water 1", "; air 0"});
  }
}

TEST(Guard, StepFarBeyondTheStableOneFoldsTheGrid) {
  Fluid fluid = tank();
  for (int k = 1; k <= 13; ++k) {
    for (int j = 1; j <= 7; ++j) fluid.velocity[0][fluid.grid.at(4, j, k)] = 1000;
  }
  Fluid other = fluid;
  EXPECT_EQ(error_of(fluid, 0.9 * stable_step(fluid)), "no error");
  expect_parts(error_of(other, 10 * stable_step(other)), {"the grid folds", "in cell ", "time 0 s", "; water "});
}

TEST(Guard, CavitatingWaterAndSteepExpansionsAreNoFaults) {
  Fluid fluid = tank();
  const std::ptrdiff_t c = fluid.grid.at(3, 4, wet);
  fluid.material[water].mass[c] *= 0.4;
  EXPECT_EQ(error_of(fluid, 1e-9), "no error");
  EXPECT_NO_THROW(check_state(fluid));
}

TEST(Guard, RangesOfTheLawsAreThoseOfTheirFormulas) {
  const double endless = std::numeric_limits<double>::infinity();
  const Bounds none{-1e300, endless}, zero{0, endless};
  // 1 - (S1 - 1) mu has its zero at mu = 1 / 0.979.
  EXPECT_NEAR(largest_density(MieGrueneisen{1000, 1484, 1.979, 0, 0, 0.11, 0}), 1000 * (1 + 1 / 0.979), 1e-6);
  EXPECT_EQ(largest_density(IdealGas{}), endless);
  // P + P_inf = (gamma - 1) (rho e - P_inf) is 0 where rho e is the stiffness.
  const StiffenedGas stiff{4.4, 6e8};
  EXPECT_EQ(range_fault(stiff, none, 1000, 6.001e5), "");
  EXPECT_NE(range_fault(stiff, none, 1000, 5.999e5), "");
  EXPECT_EQ(range_fault(IdealGas{}, zero, 1, 0), "");
  EXPECT_NE(range_fault(IdealGas{}, zero, 1, -1e-3), "");
  EXPECT_EQ(range_fault(LinearPolynomial{}, zero, 1, 1), "");
  EXPECT_NE(range_fault(LinearPolynomial{}, zero, 1, -1), "");
  EXPECT_EQ(range_fault(Tait{}, none, 1, 0), "");
  EXPECT_NE(range_fault(Tait{}, none, 0, 0), "");
}
