// What is at rest stays at rest, with and without a body that cuts cells anyhow.
#include <gtest/gtest.h>

#include "fluid_solver/fluid.hpp"
#include "tests/fluid_solver/analytic_overlap.hpp"

using namespace polynya::fluid;
using namespace polynya::fluid::test;

namespace {

Fluid basin(int across = 8) {
  Setup setup;
  setup.gravity = 9.81;
  setup.boundary = {Boundary::wall,           Boundary::non_reflecting, Boundary::wall,
                    Boundary::non_reflecting, Boundary::non_reflecting, Boundary::non_reflecting};
  const auto side = even_line(0, 0.002 * across, across);
  return {Grid(side, side, even_line(-0.04, 0.02, 24)), setup};
}

double fastest(const Fluid& fluid) {
  double most = 0;
  for (const auto& component : fluid.velocity) {
    for (const double u : component) most = std::max(most, std::abs(u));
  }
  return most;
}

}  // namespace

TEST(Rest, WaterBelowAirStaysAtRestForTenThousandSteps) {
  Fluid fluid = basin(3);
  fill_hydrostatic(fluid, {}, 0.0007);
  const double dt = 0.8 * stable_step(fluid), energy = fluid.account.energy_sum();
  for (int n = 0; n < 10000; ++n) step(fluid, dt, {});
  std::printf("at rest: %.1e m/s after 10,000 steps\n", fastest(fluid));
  EXPECT_LT(fastest(fluid), 1e-10 * 340);  // of the smaller sound speed, that of air
  EXPECT_NEAR(fluid.account.energy_sum(), energy, 1e-12 * energy);
}

TEST(Rest, ColumnCarriesItsWeight) {
  Fluid fluid = basin();
  fill_hydrostatic(fluid, {}, 0.0);
  const double depth = 0.04 - 0.5 * fluid.grid.dz[1];
  // Gauge pressure at the lowest cell centre: water above it; the air above adds 1.2 kg/m^3 of one half layer.
  EXPECT_NEAR(fluid.pressure[fluid.grid.at(1, 1, 1)] - 101325, 1000.05 * 9.81 * depth, 0.05);
}

TEST(Rest, CutBodyAcrossTheWaterlineStaysAtRest) {
  Fluid fluid = basin();
  const Box box{{-0.001, -0.001, -0.0233}, {0.0073, 0.0091, 0.0057}};
  const Overlap overlap = overlap_of(fluid.grid, box, {});
  fill_hydrostatic(fluid, overlap, 0.0007);
  const double dt = 0.8 * stable_step(fluid), energy = fluid.account.energy_sum();
  for (int n = 0; n < 1000; ++n) step(fluid, dt, overlap);
  EXPECT_LT(fastest(fluid), 1e-10 * 1480);
  EXPECT_NEAR(fluid.account.energy_sum(), energy, 1e-12 * energy);
  // Buoyancy: water to the lower face's depth. Forces of gauge pressure on the bottom minus the top (in air).
  std::vector<double> value, gradient;
  overlap_pressure(fluid, overlap.cell, value, gradient);
  double lift = 0;
  for (std::size_t m = 0; m < overlap.cell.size(); ++m) {
    int i, j, k;
    fluid.grid.position(fluid.grid.from_message(overlap.cell[m]), i, j, k);
    const double area = overlap.wall_area[6 * m + 2];
    const double face = area > 0 ? box.low[2] : box.high[2];
    lift += area * (value[m] - gradient[m] * (face - fluid.grid.centre_z(k)));
  }
  const double exact = 1000.05 * 9.81 * (0.0007 + 0.0233) * 0.0073 * 0.0091;
  EXPECT_NEAR(lift, exact, 0.02 * exact);
}

TEST(Rest, CellsThatShareAStateAboveEachOtherHaveThePressureOfTheirOwnDepth) {
  Fluid fluid = basin();
  // Leaves a fifth of a layer of cells free below the body, and a twentieth above it.
  const Box box{{-0.001, -0.001, -0.0245}, {0.0073, 0.0091, -0.010125}};
  const Overlap overlap = overlap_of(fluid.grid, box, {});
  fill_hydrostatic(fluid, overlap, 0.0);
  const double dt = 0.8 * stable_step(fluid);
  for (const int steps : {0, 300}) {
    for (int n = 0; n < steps; ++n) step(fluid, dt, overlap);
    std::vector<double> value, gradient;
    overlap_pressure(fluid, overlap.cell, value, gradient);
    for (std::size_t m = 0; m < overlap.cell.size(); ++m) {
      if (overlap.wall_area[6 * m + 2] == 0) continue;
      int i, j, k;
      fluid.grid.position(fluid.grid.from_message(overlap.cell[m]), i, j, k);
      EXPECT_NEAR(value[m], -1000.05 * 9.81 * fluid.grid.centre_z(k), 0.1) << "after " << steps << " steps";
    }
  }
}

TEST(Rest, MassAtTheStartIsDensityTimesFreeVolume) {
  Fluid fluid = basin();
  fluid.setup.gravity = 0;
  const Box box{{0.0011, 0.0023, -0.0233}, {0.0073, 0.0091, -0.0057}};
  fill_hydrostatic(fluid, overlap_of(fluid.grid, box, {}), 0.02);
  const double rho = density_at(fluid.setup.law[water], 101325, 0, 1000);
  const double volume = 0.016 * 0.016 * 0.06 - 0.0062 * 0.0068 * 0.0176;
  EXPECT_NEAR(fluid.account.mass[water], rho * volume, 1e-10 * rho * volume);
}

TEST(Rest, StateWithoutMeaningNamesItsCell) {
  Fluid fluid = basin();
  fill_hydrostatic(fluid, {}, 0.0);
  fluid.velocity[2][fluid.grid.at(4, 4, 7)] = std::nan("");
  try {
    step(fluid, 0.5 * stable_step(basin()) + 1e-7, {});
    FAIL() << "no error";
  } catch (const FluidError& error) {
    EXPECT_NE(std::string(error.what()).find("cell "), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("time "), std::string::npos);
  }
}
