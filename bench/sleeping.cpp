#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "bench/kernels.hpp"
#include "fluid_solver/fluid.hpp"

// A wave that spreads from a corner of a tank at rest: what sleeping saves and what it costs.
namespace polynya::bench {
namespace {

constexpr int cells = 96;
constexpr double threshold = 1e-7;
constexpr int looks_to_settle = 5;

/// A tank of water to two thirds under air, at rest under gravity between walls.
std::unique_ptr<fluid::Fluid> tank(double sleeping_threshold) {
  std::vector<double> line;
  for (int i = 0; i <= cells; ++i) line.push_back(0.001 * i);
  fluid::Setup setup;
  setup.gravity = 9.81;
  setup.sleeping_threshold = sleeping_threshold;
  auto tank = std::make_unique<fluid::Fluid>(fluid::Grid(line, line, line), setup);
  fill_hydrostatic(*tank, {}, 0.0643);
  return tank;
}

/// Compresses the water in a corner of the floor by up to 1e-4 (0.2 MPa).
void compress(fluid::Fluid& tank) {
  const fluid::Grid& grid = tank.grid;
  for (int k = 1; k <= cells; ++k) {
    for (int j = 1; j <= cells; ++j) {
      for (int i = 1; i <= cells; ++i) {
        const double x = grid.centre_x(i), y = grid.centre_y(j), z = grid.centre_z(k);
        const double part = std::max(0.0, 1.0 - (x * x + y * y + z * z) / (0.003 * 0.003));
        tank.material[fluid::water].mass[grid.at(i, j, k)] *= 1.0 + 1e-4 * part * part;
      }
    }
  }
  wake_all(tank);
}

/// Sets every node in motion.
void stir(fluid::Fluid& tank) {
  const fluid::Grid& grid = tank.grid;
  for (int k = 2; k <= cells; ++k) {
    for (int j = 2; j <= cells; ++j) {
      for (int i = 2; i <= cells; ++i) {
        const std::ptrdiff_t n = grid.at(i, j, k);
        tank.velocity[0][n] = 1 + std::sin(6.0 * k / cells);
        tank.velocity[1][n] = 1 + std::sin(5.0 * i / cells);
      }
    }
  }
}

double share_awake(const fluid::Fluid& tank) {
  return static_cast<double>(tank.sleeping.cells_awake) / static_cast<double>(tank.grid.cells());
}

void from_look_to_look(fluid::Fluid& tank, double dt) {
  for (long n = 0; n < fluid::Sleeping::steps_between_looks; ++n) step(tank, dt, {});
}

/// Looks until the wave has spread to about this share of the tank.
int looks_until(double wanted, double dt) {
  const auto scout = tank(threshold);
  compress(*scout);
  int best = 0;
  double nearest = 2;
  for (int look = 1; look <= looks_to_settle || share_awake(*scout) < 2 * wanted; ++look) {
    from_look_to_look(*scout, dt);
    const double off = std::abs(share_awake(*scout) - wanted);
    if (off < nearest) nearest = off, best = look;
  }
  return best;
}

/// Time from look to look without sleeping over that with it, the shortest of a few taken in turns from the same state.
double ratio_of_times(const fluid::Fluid& without, const fluid::Fluid& with, double dt) {
  std::array<double, 2> shortest{1e300, 1e300};
  for (int n = 0; n < 4; ++n) {
    for (const int which : {0, 1}) {
      fluid::Fluid copy = which ? with : without;
      shortest[which] = std::min(shortest[which], time_of([&] { from_look_to_look(copy, dt); }));
    }
  }
  return shortest[0] / shortest[1];
}

}  // namespace

/// How much faster steps of a tank are while a wave has reached about 14 % of it, what that share is exactly, and what
/// sleeping costs where everything moves (%). On one thread; looks and what follows from them are counted.
std::vector<Figure> fluid_sleeping() {
  const auto with = tank(threshold), without = tank(0);
  const double dt = 0.8 * fluid::stable_step(*with);
  const int looks = looks_until(0.14, dt);
  for (const auto& each : {with.get(), without.get()}) {
    compress(*each);
    for (int look = 1; look < looks; ++look) from_look_to_look(*each, dt);
  }
  const double speedup = ratio_of_times(*without, *with, dt);
  from_look_to_look(*with, dt);
  const double share = share_awake(*with);
  for (fluid::Fluid* each : {with.get(), without.get()}) {
    wake_all(*each);
    stir(*each);
  }
  const double overhead = 1.0 / ratio_of_times(*without, *with, dt) - 1.0;
  return {{"fluid.sleeping_speedup_14_percent", speedup},
          {"fluid.sleeping_share_percent", 100 * share},
          {"fluid.sleeping_overhead_percent", 100 * overhead}};
}

}  // namespace polynya::bench
