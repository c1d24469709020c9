// A wall on a spring before a column of water. The column takes one step per span by the fluid's own scheme in one
// dimension: acceleration by the pressure predicted in the step, then the volume of the mean velocities.
#include "coupler/handed_loads.hpp"

#include <gtest/gtest.h>

#include <cmath>

using polynya::coupler::SolidSide;

namespace {

constexpr double prediction = 0.85, viscosity = 0.06;  // those of cut cells

/// Density, sound speed and span are 1; so is the area.
struct Case {
  double mass_ratio = 1;  ///< density x sound speed x span / areal mass of the wall
  double courant = 0.5;   ///< sound speed x span / cell
  double first_cell = 1;  ///< over the others: cut cells are between half and one and a half
  double frequency = 0;   ///< of the wall on its spring, 1 / span
  double stiffer = 1;     ///< impedance that is handed on, over the true one
  int windows = 8;
};

class Column {
 public:
  explicit Column(const Case& c) : cell_(1 / c.courant), width_(40, cell_), pressure_(40, 0.0), velocity_(41, 0.0) {
    width_[0] *= c.first_cell;
  }
  /// One step with the wall at this speed. Returns the impulse on the wall, which moves away from the column.
  double step(double wall) {
    const std::size_t n = width_.size();
    velocity_[0] = wall;
    std::vector<double> ahead(n), next = velocity_;
    for (std::size_t i = 0; i < n; ++i) ahead[i] = pressure_[i] - response(i) * strain(velocity_, i);
    for (std::size_t i = 1; i < n; ++i) next[i] -= (ahead[i] - ahead[i - 1]) / (0.5 * (width_[i] + width_[i - 1]));
    next[n] -= (velocity_[n] - ahead[n - 1]) / (0.5 * width_[n - 1]);  // open end
    for (std::size_t i = 0; i <= n; ++i) velocity_[i] = 0.5 * (velocity_[i] + next[i]);
    last_strain_ = strain(velocity_, 0);
    for (std::size_t i = 0; i < n; ++i) pressure_[i] -= strain(velocity_, i);
    velocity_ = next;
    velocity_[0] = wall;
    return -ahead[0];
  }
  double expected() const { return -(pressure_[0] - response(0) * last_strain_); }
  double impedance() const { return response(0) / width_[0]; }

 private:
  double response(std::size_t i) const { return (i == 0 ? prediction : 0.6) + viscosity * cell_; }
  double strain(const std::vector<double>& v, std::size_t i) const { return (v[i + 1] - v[i]) / width_[i]; }

  double cell_;
  std::vector<double> width_, pressure_, velocity_;
  double last_strain_ = 0;
};

SolidSide wall_of(double mass) {
  SolidSide side;
  side.ids = {7};
  side.masses = {mass};
  side.fluid_impulse.assign(3, 0.0);
  side.expected_force.assign(3, 0.0);
  side.velocities = side.seen_velocity = {0, 0, 1};
  side.impedance.assign(6, 0.0);
  return side;
}

struct Motion {
  double late = 0;         ///< largest amplitude in the last tenth of the spans, the first one being 1
  double outstanding = 0;  ///< impulse at the end
  double handed = 0, given = 0;
};

/// Of the coupled wall over many spans, with or without the forecast.
Motion swing(const Case& c, bool expects, int spans = 1000) {
  SolidSide side = wall_of(1 / c.mass_ratio);
  Column column(c);
  const double dt = 1.0 / c.windows;
  double position = 0;
  Motion motion;
  for (int span = 0; span < spans && std::abs(side.velocities[2]) < 1e9; ++span) {
    begin_span_loads(side, {.span = 1, .last_span = 1, .window = dt, .expects = expects && span > 0});
    double way = 0;
    for (int w = 0; w < c.windows; ++w) {
      motion.handed += hand_on_fluid_loads(side, dt)[2];
      const double before = side.velocities[2];
      side.velocities[2] += dt * (side.fluid_force[2] / side.masses[0] - c.frequency * c.frequency * position);
      position += dt * side.velocities[2];
      way += 0.5 * dt * (before + side.velocities[2]);
    }
    const double impulse = column.step(way);
    motion.given += impulse;
    side.fluid_impulse[2] += impulse;
    side.seen_velocity[2] = way;
    side.expected_force[2] = column.expected();
    side.impedance = {0, 0, c.stiffer * column.impedance(), 0, 0, 0};
    if (10 * span > 9 * spans)
      motion.late = std::max(motion.late, std::abs(side.velocities[2]) + c.frequency * std::abs(position));
  }
  if (!(std::abs(side.velocities[2]) < 1e9)) motion.late = std::numeric_limits<double>::infinity();
  motion.outstanding = side.fluid_impulse[2];
  return motion;
}

/// The largest of all kinds of columns and springs.
double worst_swing(double mass_ratio, double stiffer) {
  double worst = 0;
  for (const double frequency : {0.0, 1.0, 2.0, 4.0})
    for (const double first_cell : {0.5, 1.0, 1.5})
      for (const double courant : {0.05, 0.3, 0.6})
        worst = std::max(worst, swing({mass_ratio, courant, first_cell, frequency, stiffer}, true).late);
  return worst;
}

}  // namespace

TEST(HandedLoads, ExpectedLoadsKeepWallsOfAnyMassQuiet) {
  for (const double ratio : {0.3, 1.0, 3.0, 10.0, 30.0, 100.0}) EXPECT_LT(worst_swing(ratio, 1), 1e-2) << ratio;
}

TEST(HandedLoads, TooMuchImpedanceIsNoHarm) {
  for (const double ratio : {1.0, 10.0, 100.0})
    for (const double stiffer : {1.5, 2.0}) EXPECT_LT(worst_swing(ratio, stiffer), 1e-2) << ratio << " " << stiffer;
}

TEST(HandedLoads, TooLittleImpedanceDrivesLightWalls) {
  EXPECT_GT(worst_swing(30, 0.3), 1e6);
}

TEST(HandedLoads, LoadsOfTheSpanBeforeDriveWallsThatForecastsKeepQuiet) {
  const Case light{.mass_ratio = 5, .courant = 0.6};
  EXPECT_GT(swing(light, false).late, 1e6);
  EXPECT_LT(swing(light, true).late, 1e-2);
}

TEST(HandedLoads, WhatIsGivenIsHandedOnOrOutstanding) {
  for (const bool expects : {false, true}) {
    const Motion motion = swing({.mass_ratio = 0.5, .frequency = 1}, expects, 50);
    EXPECT_NEAR(motion.given, motion.handed + motion.outstanding, 1e-13);
    EXPECT_NE(motion.outstanding, 0);
  }
}

/// The speed of a free wall falls like exp(-t / mass) before an endless column of the wall's mass per second: the
/// forecast's error falls with the square of the span, that of loads of the span before with the span.
TEST(HandedLoads, ForecastsFollowAFreeWallMoreCloselyThanLoadsOfTheSpanBefore) {
  const auto error = [](double ratio, bool expects) {
    SolidSide side = wall_of(1 / ratio);
    Column column({.mass_ratio = ratio, .courant = 0.5});
    const int spans = static_cast<int>(std::lround(1 / ratio));
    for (int span = 0; span < spans; ++span) {
      begin_span_loads(side, {.span = 1, .last_span = 1, .window = 0.125, .expects = expects && span > 0});
      double way = 0;
      for (int w = 0; w < 8; ++w) {
        hand_on_fluid_loads(side, 0.125);
        const double before = side.velocities[2];
        side.velocities[2] += 0.125 * side.fluid_force[2] / side.masses[0];
        way += 0.0625 * (before + side.velocities[2]);
      }
      side.fluid_impulse[2] += column.step(way);
      side.seen_velocity[2] = way;
      side.expected_force[2] = column.expected();
      side.impedance = {0, 0, column.impedance(), 0, 0, 0};
    }
    return std::abs(side.velocities[2] - std::exp(-1.0));
  };
  for (const double ratio : {0.1, 0.05, 0.025}) {
    std::printf("mass ratio %g: error with forecasts %.2e, without %.2e\n", ratio, error(ratio, true),
                error(ratio, false));
    EXPECT_LT(error(ratio, true), 0.5 * error(ratio, false));
  }
}

TEST(HandedLoads, ASteadyLoadIsHandedOnWholeWhateverTheImpedanceAndWhileStepsGrow) {
  // Water at rest: the fluid expects and gives the same force again and again, nothing moves.
  constexpr double force = 3;
  for (const double impedance : {0.1, 10.0, 1e3}) {
    SolidSide side = wall_of(1);
    side.seen_velocity = side.velocities = {0, 0, 0};
    side.fluid_force = {0, 0, force};
    side.expected_force = {0, 0, force};
    double window = 0.1;
    side.fluid_impulse[2] = 0.5 * window * force;  // given until the span's end, handed on to the middle of its window
    for (int span = 0; span < 40; ++span) {
      const double next = 1.1 * window;
      side.impedance = {0, 0, impedance, 0, 0, 0};
      begin_span_loads(
          side, {.span = 2 * next, .last_span = 2 * window, .window = next, .last_window = window, .expects = true});
      hand_on_fluid_loads(side, 0.5 * (window + next));
      EXPECT_NEAR(side.fluid_force[2], force, 1e-12 * force) << impedance << " " << span;
      hand_on_fluid_loads(side, next);
      EXPECT_NEAR(side.fluid_force[2], force, 1e-12 * force) << impedance << " " << span;
      side.fluid_impulse[2] += 2 * next * force;
      window = next;
    }
  }
}
