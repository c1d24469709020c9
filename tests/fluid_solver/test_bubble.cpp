// A gas bubble that water crushes, against the equation of Keller and Miksis (1980, J. Acoust. Soc. Am. 68:628), which
// CVODE integrates.
#include <cvode/cvode.h>
#include <gtest/gtest.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <cmath>

#include "fluid_solver/phases.hpp"
#include "tests/fluid_solver/analytic_overlap.hpp"

using namespace polynya::fluid;
using namespace polynya::fluid::test;

namespace {

const double pi = std::acos(-1.0);

struct Bubble {
  double radius, gas_pressure, pressure, density, sound_speed, gamma;

  double gas_at(double r) const { return gas_pressure * std::pow(radius / r, 3 * gamma); }
};

/// (1 - u/c) R u' + 3/2 u^2 (1 - u/(3c)) = (1 + u/c) (p_gas - p)/rho + R/(rho c) d p_gas/dt.
int keller_miksis(double, N_Vector state, N_Vector slope, void* data) {
  const Bubble& b = *static_cast<Bubble*>(data);
  const double r = NV_Ith_S(state, 0), u = NV_Ith_S(state, 1), c = b.sound_speed, gas = b.gas_at(r);
  const double push = (1 + u / c) * (gas - b.pressure) / b.density - 3 * b.gamma * gas * u / (b.density * c);
  NV_Ith_S(slope, 0) = u;
  NV_Ith_S(slope, 1) = (push - 1.5 * u * u * (1 - u / (3 * c))) / ((1 - u / c) * r);
  return 0;
}

/// Radius by time.
class KellerMiksis {
 public:
  explicit KellerMiksis(Bubble bubble) : bubble_(bubble) {
    SUNContext_Create(nullptr, &context_);
    state_ = N_VNew_Serial(2, context_);
    NV_Ith_S(state_, 0) = bubble.radius;
    // Water at rest at one pressure meets the gas's lower one: the plane wave that starts moves the wall at once.
    NV_Ith_S(state_, 1) = (bubble.gas_pressure - bubble.pressure) / (bubble.density * bubble.sound_speed);
    solver_ = CVodeCreate(CV_BDF, context_);
    CVodeInit(solver_, keller_miksis, 0.0, state_);
    CVodeSStolerances(solver_, 1e-10, 1e-12 * bubble.radius);
    CVodeSetUserData(solver_, &bubble_);
    CVodeSetMaxNumSteps(solver_, 100000);
    matrix_ = SUNDenseMatrix(2, 2, context_);
    linear_ = SUNLinSol_Dense(state_, matrix_, context_);
    CVodeSetLinearSolver(solver_, linear_, matrix_);
  }
  KellerMiksis(const KellerMiksis&) = delete;
  ~KellerMiksis() {
    CVodeFree(&solver_);
    SUNLinSolFree(linear_);
    SUNMatDestroy(matrix_);
    N_VDestroy(state_);
    SUNContext_Free(&context_);
  }

  double radius_at(double time) {
    double reached = 0;
    EXPECT_GE(CVode(solver_, time, state_, &reached, CV_NORMAL), 0);
    return NV_Ith_S(state_, 0);
  }
  double speed() const { return NV_Ith_S(state_, 1); }

 private:
  Bubble bubble_;
  SUNContext context_ = nullptr;
  N_Vector state_ = nullptr;
  void* solver_ = nullptr;
  SUNMatrix matrix_ = nullptr;
  SUNLinearSolver linear_ = nullptr;
};

/// Equal cells out to `fine`, then growing by `growth`, to at least `end`.
std::vector<double> growing_line(double cell, double fine, double growth, double end) {
  std::vector<double> line{0};
  while (line.back() < end) {
    const double last = line.size() > 1 ? line.back() - line[line.size() - 2] : cell;
    line.push_back(line.back() + (line.back() < fine - 1e-9 * cell ? cell : growth * last));
  }
  return line;
}

/// Part of a cell inside the sphere about the origin.
double part_inside(const Grid& grid, int i, int j, int k, double radius) {
  const auto inside = [&](double a, double b, double c) {
    return std::hypot(grid.x[i - 1] + a * grid.dx[i], grid.y[j - 1] + b * grid.dy[j], grid.z[k - 1] + c * grid.dz[k]) <
           radius;
  };
  if (inside(1, 1, 1)) return 1;
  if (!inside(0, 0, 0)) return 0;
  constexpr int points = 16;
  int count = 0;
  for (int a = 0; a < points; ++a)
    for (int b = 0; b < points; ++b)
      for (int c = 0; c < points; ++c) count += inside((a + 0.5) / points, (b + 0.5) / points, (c + 0.5) / points);
  return static_cast<double>(count) / (points * points * points);
}

double gas_radius(const Fluid& fluid) {
  double volume = 0;
  for (const double v : fluid.material[air].volume) volume += v;
  return std::cbrt(6 * volume / pi);
}

/// An octant of water with the bubble in its corner.
Fluid octant(const Bubble& bubble, int cells, double reach) {
  polynya::fluid::Setup setup;
  setup.law[air] = IdealGas{bubble.gamma};
  setup.boundary = {Boundary::wall,           Boundary::non_reflecting, Boundary::wall,
                    Boundary::non_reflecting, Boundary::wall,           Boundary::non_reflecting};
  const auto line = growing_line(bubble.radius / cells, 1.1 * bubble.radius, 1.1, reach);
  Fluid fluid(Grid(line, line, line), setup);
  const double thick = density_at(setup.law[water], bubble.pressure, 0, 1000);
  const double thin = density_at(setup.law[water], bubble.gas_pressure, 0, 1000);
  fill(fluid, {}, [&](int i, int j, int k) {
    CellState state;
    state.fraction[air] = part_inside(fluid.grid, i, j, k, bubble.radius);
    state.fraction[water] = 1 - state.fraction[air];
    state.density = {state.fraction[air] > 0 ? thin : thick, 1.2};
    state.specific_energy = {0, energy_at(setup.law[air], 1.2, bubble.gas_pressure)};
    return state;
  });
  for (int k = 1; k <= fluid.grid.nz; ++k) set_ambient(fluid, k, {{1, 0}, {thick, 0}, {0, 0}});
  apply_ambient(fluid);
  start_far_field(fluid, {0, 0, 0});
  return fluid;
}

}  // namespace

TEST(Bubble, CollapsesAsKellerAndMiksisSay) {
  Bubble bubble{1e-3, 1e4, 1e6, 0, 0, 1.4};
  Fluid fluid = octant(bubble, 24, 20 * bubble.radius);
  bubble.radius = gas_radius(fluid);
  bubble.density = density_at(fluid.setup.law[water], bubble.pressure, 0, 1000);
  bubble.sound_speed =
      std::sqrt(bulk_modulus(bubble.density, respond(fluid.setup.law[water], bubble.density, 0)) / bubble.density);
  KellerMiksis reference(bubble);
  double worst = 0, relative = 0, late = 0, before = 1, previous_time = 0, next_print = 0.9;
  for (;;) {
    step(fluid, 0.9 * stable_step(fluid), {});
    const double expected = reference.radius_at(fluid.time), found = gas_radius(fluid);
    if (expected < 0.2 * bubble.radius) break;
    worst = std::max(worst, std::abs(found - expected) / bubble.radius);
    relative = std::max(relative, std::abs(found / expected - 1));
    late = (expected - found) / reference.speed() / fluid.time;
    if (expected < next_print * bubble.radius) {
      std::printf("  %.4e s: radius %.4f, Keller and Miksis %.4f of the first; wall at %.3f c\n", fluid.time,
                  found / bubble.radius, expected / bubble.radius, -reference.speed() / bubble.sound_speed);
      next_print -= 0.1;
    }
    before = found;
    previous_time = fluid.time;
  }
  std::printf("bubble, %zu cells: radius within %.4f of the first, %.4f of the present one; late by %.4f of the time\n",
              fluid.grid.cells(), worst, relative, late);
  RecordProperty("worst", std::to_string(worst));
  RecordProperty("late", std::to_string(late));
  EXPECT_LT(worst, 0.02);
  EXPECT_LT(std::abs(late), 0.005);
  EXPECT_LT(before, 0.25 * bubble.radius) << "at " << previous_time;
}
