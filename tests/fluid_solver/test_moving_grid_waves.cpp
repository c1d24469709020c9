// What a grid that moves and stretches computes, against grids at rest and exact solutions.
#include <gtest/gtest.h>

#include <cmath>

#include "fluid_solver/exact_riemann.hpp"
#include "fluid_solver/fluid.hpp"
#include "tests/fluid_solver/analytic_overlap.hpp"

using namespace polynya::fluid;
using namespace polynya::fluid::test;

namespace {

const double pi = std::acos(-1.0);

void advance(Fluid& fluid, double until) {
  while (fluid.time < until * (1 - 1e-12)) {
    const double left = until - fluid.time, most = 0.8 * stable_step(fluid);
    step(fluid, left <= most ? left : left < 2 * most ? 0.5 * left : most, {});
  }
  update_cell_states(fluid);
}

struct Tube {
  EquationOfState left_law, right_law;
  RiemannState left, right;
  double time;
};

const Tube air_tube{IdealGas{1.4}, IdealGas{1.4}, {1, 0, 1e5, 1.4, 0}, {0.125, 0, 1e4, 1.4, 0}, 5e-4};
const Tube water_tube{IdealGas{1.4}, StiffenedGas{4.4, 6e8}, {50, 0, 1e5, 1.4, 0}, {1000, 0, 1e9, 4.4, 6e8}, 1.5e-4};

/// The tube about x = 0.5, its states undisturbed beyond both ends.
Fluid run(const Tube& tube, int cells, const EndMotion& along) {
  polynya::fluid::Setup setup;
  setup.law = {tube.left_law, tube.right_law};
  setup.pressure_floor = {-1e300, -1e300};
  setup.boundary.fill(Boundary::wall);
  setup.boundary[0] = setup.boundary[1] = Boundary::non_reflecting;
  const double h = 1.0 / cells;
  Fluid fluid(Grid(even_line(0, 1, cells), even_line(0, h, 1), even_line(0, h, 1)), setup);
  std::array<EndMotion, 3> motion;
  motion[0] = along;
  prescribe_motion(fluid, motion);
  const auto side = [&](int m) {
    const RiemannState& s = m == 0 ? tube.left : tube.right;
    CellState state;
    state.fraction[m] = 1;
    state.density[m] = s.density;
    state.specific_energy[m] = energy_at(setup.law[m], s.density, s.pressure);
    return state;
  };
  fill(fluid, {}, [&](int i, int, int) { return side((i - 0.5) * h < 0.5 ? 0 : 1); });
  for (int m = 0; m < 2; ++m)
    fluid.beyond[m] = Beyond{ambient_of(setup, side(m)), m == 0 ? tube.left.velocity : tube.right.velocity};
  apply_ambient(fluid);
  for (int k = 1; k <= 2; ++k)
    for (int j = 1; j <= 2; ++j)
      for (int i = 1; i <= cells + 1; ++i)
        fluid.velocity[0][fluid.grid.at(i, j, k)] =
            fluid.grid.x[i - 1] < 0.5 ? tube.left.velocity : tube.right.velocity;
  advance(fluid, tube.time);
  return fluid;
}

/// Density, velocity and pressure of a tube at a place, linear between cell centres.
std::array<double, 3> at_point(const Fluid& fluid, double x) {
  const Grid& grid = fluid.grid;
  int i = 1;
  while (i < grid.nx - 1 && grid.centre_x(i + 1) < x) ++i;
  const auto cell = [&](int n) {
    const std::ptrdiff_t c = grid.at(n, 1, 1);
    return std::array<double, 3>{(fluid.material[0].mass[c] + fluid.material[1].mass[c]) / grid.cell_volume[c],
                                 0.5 * (fluid.velocity[0][c] + fluid.velocity[0][c + 1]), fluid.pressure[c]};
  };
  const double part = (x - grid.centre_x(i)) / (grid.centre_x(i + 1) - grid.centre_x(i));
  const auto low = cell(i), high = cell(i + 1);
  return {low[0] + part * (high[0] - low[0]), low[1] + part * (high[1] - low[1]), low[2] + part * (high[2] - low[2])};
}

std::array<double, 3> scales(const Tube& tube) {
  return {std::max(tube.left.density, tube.right.density),
          std::abs(ExactRiemann(tube.left, tube.right).star_velocity()),
          std::max(tube.left.pressure, tube.right.pressure)};
}

/// Mean differences over 2,000 points of the middle eight tenths.
template <class Other>
std::array<double, 3> mean_difference(const Tube& tube, const Fluid& fluid, Other&& other) {
  std::array<double, 3> sum{};
  const std::array<double, 3> scale = scales(tube);
  for (int n = 0; n < 2000; ++n) {
    const double x = 0.1 + 0.8 * (n + 0.5) / 2000;
    const auto one = at_point(fluid, x), two = other(x);
    for (int q = 0; q < 3; ++q) sum[q] += std::abs(one[q] - two[q]) / scale[q] / 2000;
  }
  return sum;
}

std::array<double, 3> mean_error(const Tube& tube, const Fluid& fluid) {
  const ExactRiemann exact(tube.left, tube.right);
  return mean_difference(tube, fluid, [&](double x) {
    const auto s = exact.sample((x - 0.5) / tube.time);
    return std::array<double, 3>{s.density, s.velocity, s.pressure};
  });
}

}  // namespace

TEST(MovingGridWaves, TubesOnAGridAt40MetresPerSecondGiveTheFixedGridsResultWithinOnePercent) {
  for (const Tube& tube : {air_tube, water_tube}) {
    const Fluid rest = run(tube, 400, {});
    const std::array<double, 3> own = mean_error(tube, rest);
    for (const double speed : {40.0, -40.0}) {
      const Fluid moving = run(tube, 400, {{speed, speed}, {}, {}});
      const auto mean = mean_difference(tube, moving, [&](double x) { return at_point(rest, x); });
      const auto error = mean_error(tube, moving);
      // At points between the waves; across a wave the cells lie elsewhere.
      const ExactRiemann exact(tube.left, tube.right);
      double worst = 0;
      for (int n = 1; n < 80; ++n) {
        const double x = 0.1 + 0.01 * n, away = 0.012;
        const auto before = exact.sample((x - away - 0.5) / tube.time),
                   after = exact.sample((x + away - 0.5) / tube.time);
        const auto scale = scales(tube);
        if (std::abs(after.density - before.density) > 0.02 * scale[0]) continue;
        const auto one = at_point(moving, x), two = at_point(rest, x);
        for (int q = 0; q < 3; ++q) worst = std::max(worst, std::abs(one[q] - two[q]) / scale[q]);
      }
      std::printf(
          "tube at %+.0f m/s: differs by %.1e, %.1e, %.1e (mean), %.1e at most between the waves; errors %.1e, "
          "%.1e, %.1e, fixed %.1e, %.1e, %.1e\n",
          speed, mean[0], mean[1], mean[2], worst, error[0], error[1], error[2], own[0], own[1], own[2]);
      for (int q = 0; q < 3; ++q) EXPECT_LT(mean[q], 0.01) << q;
      EXPECT_LT(worst, 0.01);
    }
  }
}

TEST(MovingGridWaves, ShockOnAStretchingGridConvergesToTheExactSolution) {
  // The left end runs away, the right one comes along with the shock: the grid grows by a fifth.
  const EndMotion stretch{{-300, 100}, {}, {}};
  for (const Tube& tube : {air_tube, water_tube}) {
    const Fluid coarse = run(tube, 100, stretch), fine = run(tube, 400, stretch);
    const auto rough = mean_error(tube, coarse), own = mean_error(tube, fine),
               rest = mean_error(tube, run(tube, 400, {}));
    for (int q = 0; q < 3; ++q) {
      const double order = 0.5 * std::log2(rough[q] / own[q]);
      std::printf("stretched by %.2f, %s: error %.2e at 400 cells (fixed %.2e), order %.2f\n",
                  fine.grid.x.back() - fine.grid.x.front(),
                  q == 0   ? "density"
                  : q == 1 ? "velocity"
                           : "pressure",
                  own[q], rest[q], order);
      EXPECT_GT(order, 0.75) << q;
      EXPECT_LT(own[q], 1.5 * rest[q]) << q;
    }
  }
}

namespace {

/// A simple wave of an ideal gas (gamma 1.4, density and pressure 1 ahead) along x, or along the diagonal of x and y;
/// mean error of the pressure relative to the wave's.
double simple_wave_error(int cells, bool diagonal, const std::array<EndMotion, 3>& motion) {
  const double g = 1.4, c = std::sqrt(g), amplitude = 0.02, along = diagonal ? std::sqrt(0.5) : 1.0;
  const auto speed = [&](double s) {
    const double z = diagonal ? (s - 0.28) / 0.2 : (s - 0.4) / 0.22;
    return std::abs(z) < 1 ? amplitude * std::pow(std::cos(0.5 * pi * z), 4) : 0.0;
  };
  const auto place = [&](double x, double y) { return diagonal ? along * (x + y) - 0.25 : x; };
  const auto density = [&](double u) { return std::pow(1 + 0.5 * (g - 1) * u / c, 2 / (g - 1)); };
  const auto cell_mean = [&](const Grid& grid, int i, int j, auto&& f) {  // by Gauss points
    const double node[3] = {-std::sqrt(0.6), 0, std::sqrt(0.6)}, weight[3] = {5. / 18, 8. / 18, 5. / 18};
    double sum = 0;
    for (int a = 0; a < 3; ++a) {
      for (int b = 0; b < 3; ++b)
        sum += weight[a] * weight[b] *
               f(place(grid.centre_x(i) + 0.5 * grid.dx[i] * node[a], grid.centre_y(j) + 0.5 * grid.dy[j] * node[b]));
    }
    return sum;
  };
  polynya::fluid::Setup setup;
  setup.law = {IdealGas{g}, IdealGas{g}};
  setup.pressure_floor = {-1e300, -1e300};
  setup.boundary.fill(Boundary::non_reflecting);
  for (int side = diagonal ? 4 : 2; side < 6; ++side) setup.boundary[side] = Boundary::wall;
  const auto line = even_line(0, 1, cells), thin = even_line(0, 1.0 / cells, 1);
  Fluid fluid(Grid(line, diagonal ? line : thin, thin), setup);
  const Grid& grid = fluid.grid;
  fill(fluid, {}, [&](int i, int j, int) {
    CellState state;
    state.fraction[0] = 1;
    state.density[0] = cell_mean(grid, i, j, [&](double s) { return density(speed(s)); });
    const double pressure = cell_mean(grid, i, j, [&](double s) { return std::pow(density(speed(s)), g); });
    state.specific_energy[0] = pressure / (g - 1) / state.density[0];
    return state;
  });
  set_ambient(fluid, 1, CellState{{1, 0}, {1, 0}, {1 / (g - 1), 0}});
  apply_ambient(fluid);
  for (int k = 1; k <= 2; ++k) {
    for (int j = 1; j <= grid.ny + 1; ++j) {
      for (int i = 1; i <= cells + 1; ++i) {
        const double u = along * speed(place(grid.x[i - 1], diagonal ? grid.y[j - 1] : 0.0));
        fluid.velocity[0][grid.at(i, j, k)] = u;
        fluid.velocity[1][grid.at(i, j, k)] = diagonal ? u : 0;
      }
    }
  }
  prescribe_motion(fluid, motion);
  const double time = (diagonal ? 0.2 : 0.25) / c;
  const int steps = static_cast<int>(std::ceil(time / (0.35 / cells / (1.05 * c))));
  for (int n = 0; n < steps; ++n) step(fluid, time / steps, {});
  update_cell_states(fluid);
  const auto exact = [&](double s) {  // u is constant along x0 + (c + (g + 1)/2 u) t
    double from = s - c * time;
    for (int iteration = 0; iteration < 50; ++iteration) from = s - (c + 0.5 * (g + 1) * speed(from)) * time;
    return std::pow(density(speed(from)), g);
  };
  double error = 0, area = 0;
  for (int j = 1; j <= grid.ny; ++j) {
    for (int i = 1; i <= cells; ++i) {
      const double x = grid.centre_x(i), y = grid.centre_y(j), own = grid.dx[i] * grid.dy[j];
      if (diagonal && (std::abs(x - y) > 0.12 || std::abs(x + y - 0.9) > 0.6))
        continue;  // elsewhere waves from the sides
      error += own * std::abs(fluid.pressure[grid.at(i, j, 1)] - cell_mean(grid, i, j, exact)) / (g * amplitude / c);
      area += own;
    }
  }
  return error / area;
}

}  // namespace

TEST(MovingGridWaves, SmoothWavesConvergeAtSecondOrderOnAGridThatMovesAndStretches) {
  std::array<EndMotion, 3> motion;
  motion[0].speed = {0.4, 0.1};  // the sound runs at 1.18
  const double coarse = simple_wave_error(50, false, motion), fine = simple_wave_error(400, false, motion);
  std::printf("smooth wave along x, grid moving and shrinking: %.2e at 50, %.2e at 400 cells, order %.2f; fixed %.2e\n",
              coarse, fine, std::log2(coarse / fine) / 3, simple_wave_error(400, false, {}));
  EXPECT_GE(std::log2(coarse / fine) / 3, 1.8);
  motion[0].speed = {-0.2, 0.3};
  motion[1].speed = {0.3, 0.1};
  const double rough = simple_wave_error(32, true, motion), smooth = simple_wave_error(128, true, motion);
  std::printf(
      "smooth wave along a diagonal, grid moving and stretching: %.2e at 32, %.2e at 128 cells, order %.2f; fixed "
      "%.2e\n",
      rough, smooth, 0.5 * std::log2(rough / smooth), simple_wave_error(128, true, {}));
  EXPECT_GE(0.5 * std::log2(rough / smooth), 1.8);
}

namespace {

/// A ball of air at ten times the pressure around it, in a box of air, octants all there.
Fluid blast(int cells, double speed, double time) {
  polynya::fluid::Setup setup;
  setup.law = {IdealGas{1.4}, IdealGas{1.4}};
  setup.pressure_floor = {0, 0};
  setup.boundary.fill(Boundary::non_reflecting);
  const auto line = even_line(-0.5, 0.5, cells);
  Fluid fluid(Grid(line, line, line), setup);
  std::array<EndMotion, 3> motion;
  for (EndMotion& axis : motion) axis.speed = {speed / std::sqrt(3.0), speed / std::sqrt(3.0)};
  prescribe_motion(fluid, motion);
  const Grid& grid = fluid.grid;
  fill(fluid, {}, [&](int i, int j, int k) {
    const double r = std::hypot(grid.centre_x(i), grid.centre_y(j), grid.centre_z(k));
    const double pressure = 1e5 * (1 + 4.5 * (1 - std::tanh((r - 0.2) / 0.04)));
    return CellState{{1, 0}, {1.2, 0}, {pressure / 0.4 / 1.2, 0}};
  });
  advance(fluid, time);
  return fluid;
}

/// Pressure at a point, trilinear between cell centres of equal cells.
double pressure_at(const Fluid& fluid, const std::array<double, 3>& point) {
  const Grid& grid = fluid.grid;
  const std::array<const std::vector<double>*, 3> line{&grid.x, &grid.y, &grid.z};
  std::array<int, 3> cell{};
  std::array<double, 3> part{};
  for (int d = 0; d < 3; ++d) {
    const double h = (*line[d])[1] - (*line[d])[0], s = (point[d] - (*line[d])[0]) / h + 0.5;
    cell[d] = static_cast<int>(std::floor(s));
    part[d] = s - cell[d];
  }
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    double weight = 1;
    for (int d = 0; d < 3; ++d) weight *= corner >> d & 1 ? part[d] : 1 - part[d];
    sum +=
        weight * fluid.pressure[grid.at(cell[0] + (corner & 1), cell[1] + (corner >> 1 & 1), cell[2] + (corner >> 2))];
  }
  return sum;
}

}  // namespace

TEST(MovingGridWaves, BlastOnAGridAt40MetresPerSecondGivesTheFixedGridsResultWithinOnePercent) {
  const double time = 4e-4;
  const Fluid rest = blast(48, 0, time), moving = blast(48, 40, time);
  // Points within three cells of the shock see where it lies in its cell, on any grid: they count in the mean.
  const double shock = 0.44, cell = 1.0 / 48;
  double worst = 0, sum = 0, most = 0;
  long number = 0;
  for (double x = -0.35; x <= 0.35; x += 0.05) {
    for (double y = -0.35; y <= 0.35; y += 0.05) {
      for (double z = -0.35; z <= 0.35; z += 0.05) {
        const double one = pressure_at(rest, {x, y, z}), two = pressure_at(moving, {x, y, z});
        if (std::abs(std::hypot(x, y, z) - shock) > 3 * cell) worst = std::max(worst, std::abs(one - two));
        sum += std::abs(one - two);
        most = std::max(most, one);
        ++number;
      }
    }
  }
  std::printf(
      "blast on a grid at 40 m/s along the diagonal: pressure differs by %.1e of the largest at most, %.1e on the mean "
      "of %ld points\n",
      worst / most, sum / most / static_cast<double>(number), number);
  EXPECT_LT(worst, 0.01 * most);
  EXPECT_LT(sum, 0.01 * most * static_cast<double>(number));
}
