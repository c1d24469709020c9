// Bodies that move through the grid: nothing is created, nothing lost, and uniform motion is no motion.
#include <gtest/gtest.h>
#include <omp.h>

#include "fluid_solver/fluid.hpp"
#include "tests/fluid_solver/analytic_overlap.hpp"

using namespace polynya::fluid;
using namespace polynya::fluid::test;

namespace {

constexpr double side = 0.02;

Fluid cube(int cells, Boundary boundary, Vector ambient = {}, double gravity = 0) {
  Setup setup;
  setup.boundary.fill(boundary);
  setup.ambient_velocity = ambient;
  setup.gravity = gravity;
  const auto line = even_line(0, side, cells);
  return {Grid(line, line, line), setup};
}

double largest_pressure_change(const Fluid& fluid) {
  double most = 0;
  for (std::size_t c = 0; c < fluid.density.size(); ++c) {
    if (fluid.density[c] > 0) most = std::max(most, std::abs(fluid.predicted_pressure[c] - 101325));
  }
  return most;
}

Box moving_box(double t, Vector v) {
  const Vector low{0.00612 + v[0] * t, 0.0071 + v[1] * t, 0.0058 + v[2] * t};
  return {low, {low[0] + 0.0073, low[1] + 0.0061, low[2] + 0.0067}};
}

struct Books {
  double energy;
  std::array<double, 3> momentum;
  std::array<double, 2> mass;
};

Books books(const Account& a) {
  Books b{a.energy_sum(), {}, {a.mass[0] + a.boundary_mass[0], a.mass[1] + a.boundary_mass[1]}};
  for (int d = 0; d < 3; ++d) {
    b.momentum[d] =
        a.momentum[d] + a.body_impulse[0][d] + a.body_impulse[1][d] + a.boundary_impulse[d] + a.node_fix_impulse[d];
  }
  b.momentum[2] += a.gravity_impulse;
  return b;
}

}  // namespace

TEST(Motion, BodyAndFluidMovingTogetherFeelNothing) {
  const Vector v{23, 17, 40};
  Fluid fluid = cube(12, Boundary::non_reflecting, v);
  fill_hydrostatic(fluid, overlap_of(fluid.grid, moving_box(0, v), v), 1.0, v);
  const double dt = stable_step(fluid);
  double worst = 0;
  for (int n = 0; n < 150; ++n) {
    step(fluid, dt, overlap_of(fluid.grid, moving_box(fluid.time + dt, v), v));
    worst = std::max(worst, largest_pressure_change(fluid));
  }
  const double scale = 1000 * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  std::printf("largest pressure error: %.1e rho V^2\n", worst / scale);
  EXPECT_LT(worst / scale, 1e-7);
  EXPECT_GT(v[2] * fluid.time, 1.2 * side / 12);  // it has crossed planes of the grid
}

TEST(Motion, BooksCloseInEveryStep) {
  // A box rising out of water into air, its walls cutting cells anyhow; walls on all sides of the domain.
  const Vector v{3, -2, 40};
  Fluid fluid = cube(10, Boundary::wall, {}, 9.81);
  fill_hydrostatic(fluid, overlap_of(fluid.grid, moving_box(0, v), v), 0.0117);
  start_potential_flow(fluid);
  const double dt = 0.7 * stable_step(fluid);
  const Books start = books(fluid.account);
  Books last = start;
  const double scale = 1000 * side * side * side * 40;
  for (int n = 0; n < 200; ++n) {
    step(fluid, dt, overlap_of(fluid.grid, moving_box(fluid.time + dt, v), v));
    const Books now = books(fluid.account);
    EXPECT_NEAR(now.energy, last.energy, 1e-12 * scale * 40) << n;
    for (int d = 0; d < 3; ++d) EXPECT_NEAR(now.momentum[d], last.momentum[d], 1e-12 * scale) << n << " axis " << d;
    for (int m = 0; m < 2; ++m) EXPECT_NEAR(now.mass[m], last.mass[m], 1e-12 * start.mass[0]) << n;
    last = now;
    if (HasFailure()) return;
  }
  EXPECT_GT(fluid.account.kinetic, 0);
}

TEST(Motion, LightFlatWallIsNotSwungUpByTheWaterItCarries) {
  // What nodes before a flat wall give to it reaches it a step later. Here it alone moves the wall, which is lighter
  // than the half cell of water it carries: followed at once, the pair would swing up in turns.
  Fluid fluid = cube(12, Boundary::non_reflecting);
  const double cell = side / 12, low = 3.95 * cell, wall_mass = 0.2 * 1000 * cell * std::pow(6 * cell, 2);
  const Box box{{3 * cell, 3 * cell, low}, {9 * cell, 9 * cell, 9.5 * cell}};
  fill_hydrostatic(fluid, overlap_of(fluid.grid, box, {}), 1.0);
  constexpr double pushed = 1e-3;  // m/s
  double speed = pushed, largest = 0;
  for (int n = 0; n < 60; ++n) {
    step(fluid, 1e-7, overlap_of(fluid.grid, box, {0, 0, speed}));
    for (const auto& impulse : fluid.wall_impulse) speed += impulse[0][2] / wall_mass;
    largest = std::max(largest, std::abs(speed));
  }
  EXPECT_LE(largest, pushed);
  EXPECT_LT(std::abs(speed), 0.9 * pushed);  // the water takes part
}

TEST(Motion, OpenBoundariesCloseTheBooksToo) {
  const Vector v{0, 0, 30};
  Fluid fluid = cube(10, Boundary::non_reflecting);
  fill_hydrostatic(fluid, overlap_of(fluid.grid, moving_box(0, v), v, 1), 1.0);
  const double dt = 0.7 * stable_step(fluid);
  const Books start = books(fluid.account);
  for (int n = 0; n < 100; ++n) step(fluid, dt, overlap_of(fluid.grid, moving_box(fluid.time + dt, v), v, 1));
  const Books end = books(fluid.account);
  const double scale = 1000 * side * side * side * 40;
  EXPECT_NEAR(end.energy, start.energy, 1e-11 * scale * 40);
  for (int d = 0; d < 3; ++d) EXPECT_NEAR(end.momentum[d], start.momentum[d], 1e-11 * scale);
  for (int m = 0; m < 2; ++m) EXPECT_NEAR(end.mass[m], start.mass[m], 1e-12 * start.mass[0]);
}

TEST(Motion, NumberOfThreadsChangesNoBit) {
  // More rows and layers than a thread takes at once, and planes between water and air in many of them.
  const auto run = [](int threads) {
    omp_set_num_threads(threads);
    const Vector v{3, -2, 40};
    polynya::fluid::Setup setup;
    setup.boundary.fill(Boundary::non_reflecting);
    setup.gravity = 9.81;
    Fluid fluid(Grid(even_line(0, side, 9), even_line(0, side, 40), even_line(0, side, 24)), setup);
    fill_hydrostatic(fluid, overlap_of(fluid.grid, moving_box(0, v), v), 0.0117);
    start_potential_flow(fluid);
    for (int n = 0; n < 20; ++n) step(fluid, 1e-7, overlap_of(fluid.grid, moving_box(fluid.time + 1e-7, v), v));
    return fluid;
  };
  const int threads = omp_get_max_threads();
  const Fluid one = run(1);
  for (const int more : {2, 3}) {
    const Fluid several = run(more);
    for (int d = 0; d < 3; ++d)
      EXPECT_TRUE(one.velocity[d] == several.velocity[d]) << more << " threads, component " << d;
    for (int m = 0; m < 2; ++m) {
      EXPECT_TRUE(one.material[m].mass == several.material[m].mass) << more << " threads, material " << m;
      EXPECT_TRUE(one.material[m].energy == several.material[m].energy) << more << " threads, material " << m;
    }
    EXPECT_TRUE(one.predicted_pressure == several.predicted_pressure) << more << " threads";
    EXPECT_EQ(account_values(one.account), account_values(several.account)) << more << " threads";
  }
  omp_set_num_threads(threads);
}

TEST(Motion, DebrisPressesWaterAsideAndIsBooked) {
  Fluid fluid = cube(8, Boundary::non_reflecting);
  const auto debris = [&](double volume) {
    Overlap overlap;
    overlap.cell = {3 + 8 * (3 + 8 * 3)};
    overlap.solid_volume = {0};
    overlap.debris_volume = {volume};
    overlap.wall_area.assign(6, 0);
    overlap.wall_velocity.assign(6, 0);
    return overlap;
  };
  const double cell = side * side * side / 512;
  fill_hydrostatic(fluid, debris(0.3 * cell), 1.0);
  const Books start = books(fluid.account);
  const double mass = fluid.account.mass[water];
  // Slowly, so that the water pushed out does not keep flowing; past half full the cell joins a neighbour.
  for (int n = 1; n <= 1000; ++n) step(fluid, 3e-7, debris((0.3 + 0.0004 * n) * cell));
  for (int n = 0; n < 200; ++n) step(fluid, 3e-7, debris(0.7 * cell));
  EXPECT_NEAR(books(fluid.account).energy, start.energy, 1e-12);
  EXPECT_NEAR(mass - fluid.account.mass[water], 1000 * 0.4 * cell,
              0.05 * 1000 * 0.4 * cell);  // left through the boundary
  EXPECT_NE(fluid.account.swept_defect, 0);
}

TEST(Motion, SolidThatSwellsWithinACellDoesTheWorkOfItsSides) {
  // Its sides move apart, so its area and its mean velocity are none; the closed box feels what they sweep.
  Fluid fluid = cube(8, Boundary::wall);
  const double cell = side * side * side / 512, rate = 500 * cell;  // m^3/s
  const auto swelling = [&](double time) {
    Overlap overlap;
    overlap.cell = {3 + 8 * (3 + 8 * 3)};
    overlap.solid_volume = {0.1 * cell + rate * time};
    overlap.debris_volume = {0};
    overlap.wall_area.assign(6, 0);
    overlap.wall_velocity.assign(6, 0);
    overlap.wall_sweep = {0, -rate};
    return overlap;
  };
  fill_hydrostatic(fluid, swelling(0), 1.0);
  const Account start = fluid.account;
  const double dt = 3e-7, free = side * side * side - 0.1 * cell;
  const double stiffness = fluid.bulk_modulus[fluid.grid.at(2, 2, 2)];
  while (fluid.time < 0.0006) step(fluid, dt, swelling(fluid.time + dt));
  const double swept = rate * fluid.time, rise = stiffness * swept / free;
  EXPECT_NEAR(fluid.account.swept_volume[1], -swept, 1e-9 * swept);
  // What one cell pushes out costs more than the compression alone: the flow away from it, and its viscosity.
  const double compression = (101325 + rise / 2) * swept;
  EXPECT_GT(-fluid.account.wall_work[1], compression);
  EXPECT_LT(-fluid.account.wall_work[1], 1.1 * compression);
  EXPECT_NEAR(fluid.account.swept_defect, 0, 1e-6 * compression);
  EXPECT_NEAR(fluid.account.energy_sum(), start.energy_sum(), 1e-9 * compression);
}

TEST(Motion, IceThatBecomesDebrisSendsOutNoShock) {
  // A submerged block of solid cells turns into as much debris, most of it in its own cells, some beside it.
  Fluid fluid = cube(10, Boundary::non_reflecting);
  const double h = side / 10, cell = h * h * h;
  const Box block{{3 * h, 3 * h, 3 * h}, {6 * h, 6 * h, 6 * h}};
  const Overlap solid = overlap_of(fluid.grid, block, {}, 1);
  Overlap debris;
  double left = 27 * cell;
  for (int k = 2; k <= 6; ++k) {
    for (int j = 2; j <= 6; ++j) {
      for (int i = 2; i <= 6; ++i) {
        const bool inside = i >= 3 && i < 6 && j >= 3 && j < 6 && k >= 3 && k < 6;
        debris.cell.push_back(i + 10 * (j + 10 * k));
        debris.solid_volume.push_back(0);
        debris.debris_volume.push_back(inside ? 0.8 * cell : 0.0);
        left -= inside ? 0.8 * cell : 0.0;
      }
    }
  }
  for (std::size_t m = 0; m < debris.cell.size(); ++m) {
    if (debris.debris_volume[m] == 0) debris.debris_volume[m] = left / (125 - 27);
  }
  debris.wall_area.assign(6 * debris.cell.size(), 0);
  debris.wall_velocity.assign(6 * debris.cell.size(), 0);
  fill_hydrostatic(fluid, solid, 1.0);
  const Books start = books(fluid.account);
  for (int n = 0; n < 10; ++n) step(fluid, 3e-7, solid);
  double worst = 0;
  for (int n = 0; n < 50; ++n) {
    step(fluid, 3e-7, debris);
    worst = std::max(worst, largest_pressure_change(fluid));
  }
  EXPECT_LT(worst, 1000.0);  // Pa; the water's stiffness times the moved part of a cell would be 1e8
  EXPECT_NEAR(books(fluid.account).energy, start.energy, 1e-12);
  EXPECT_NEAR(books(fluid.account).mass[water], start.mass[water], 1e-12 * start.mass[water]);
}

TEST(Motion, RoomIsHandedOnAlongALongWallWithoutAPulse) {
  // Debris goes from one end of a column of cells to the other in one step: all the water between makes way.
  constexpr int length = 260;
  const double h = 0.002;
  polynya::fluid::Setup setup;
  setup.boundary.fill(Boundary::wall);
  Fluid fluid(Grid(even_line(0, 3 * h, 3), even_line(0, 3 * h, 3), even_line(0, length * h, length)), setup);
  const auto debris = [&](double lower, double upper, double between) {
    Overlap overlap;
    for (int k = 0; k < length; ++k) {
      overlap.cell.push_back(1 + 3 * (1 + 3 * k));
      overlap.debris_volume.push_back((k == 0 ? lower : k == length - 1 ? upper : between) * h * h * h);
    }
    overlap.solid_volume.assign(length, 0);
    overlap.wall_area.assign(6 * length, 0);
    overlap.wall_velocity.assign(6 * length, 0);
    return overlap;
  };
  fill_hydrostatic(fluid, debris(0.04, 0.08, 0.05), 1.0);
  const Books start = books(fluid.account);
  step(fluid, 3e-7, debris(0.08, 0.04, 0.05 + 1e-9));
  step(fluid, 3e-7, debris(0.08, 0.04, 0.05 + 1e-9));
  EXPECT_LT(largest_pressure_change(fluid), 100.0);  // Pa; 1e-7 of the room times the water's stiffness is as much
  EXPECT_NEAR(books(fluid.account).energy, start.energy, 1e-12);
}

TEST(Motion, SealedPocketKeepsItsMass) {
  // A plate closes on the wall of the domain and leaves no way out for the last water before it.
  Fluid fluid = cube(8, Boundary::wall);
  const Vector v{0, 0, 20};
  const auto plate = [&](double t) { return Box{{-1, -1, 0.0101 + 20 * t}, {0.0151, 1, 0.0161 + 20 * t}}; };
  fill_hydrostatic(fluid, overlap_of(fluid.grid, plate(0), v), 1.0);
  const double mass = fluid.account.mass[water], dt = 4e-7;
  while (fluid.time < 1.95e-4) step(fluid, dt, overlap_of(fluid.grid, plate(fluid.time + dt), v));
  EXPECT_NEAR(fluid.account.mass[water], mass, 1e-12 * mass);
}
