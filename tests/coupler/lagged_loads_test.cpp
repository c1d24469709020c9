#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

/// The model problem behind lag_limit and radiation_force: a wall of areal mass 1 on a spring against a fluid that
/// answers with `impedance` times the wall's mean speed of the span before; spans of length 1 in `windows` steps.
/// `answered` is the share of the change of speed since that span that the water's impedance answers at once. Returns
/// the growth of the largest amplitude over 300 spans.
namespace {

double growth(double impedance, double frequency, int windows, double answered) {
  const double dt = 1.0 / windows;
  double speed = 1, position = 0, outstanding = 0, seen = 1, late = 0;
  for (int span = 0; span < 300; ++span) {
    double travelled = 0;
    for (int w = 0; w < windows; ++w) {
      const double force = outstanding / (windows - w) / dt - answered * impedance * (speed - seen);
      outstanding -= force * dt;
      const double before = speed;
      speed += dt * (force - frequency * frequency * position);
      position += dt * speed;
      travelled += 0.5 * (before + speed) * dt;
    }
    outstanding -= impedance * travelled;
    seen = travelled;
    if (span >= 270) late = std::max(late, std::abs(speed) + frequency * std::abs(position));
    if (!(std::abs(speed) < 1e12)) return 1e12;
  }
  return late;
}

}  // namespace

TEST(LaggedLoads, FreeWallIsStableUpToTwiceTheBoundOfTheSpan) {
  for (const double answered : {0.0, 1.0})
    for (const double impedance : {0.1, 0.5, 1.0, 1.9}) EXPECT_LT(growth(impedance, 0, 4, answered), 1e-2);
  EXPECT_GT(growth(2.5, 0, 4, 0), 1e6);
}

TEST(LaggedLoads, LaggedLoadsAloneDriveWallsThatOscillateFasterThanTheSpan) {
  for (const double frequency : {2.0, 2.5, 3.0}) EXPECT_GT(growth(0.4, frequency, 5, 0), 1e6) << frequency;
}

TEST(LaggedLoads, AnsweringTheChangeAtOnceKeepsThoseWallsQuiet) {
  for (const double frequency : {2.5, 3.0, 4.0, 5.0, 6.0})
    for (const double impedance : {0.1, 0.4, 1.0}) EXPECT_LT(growth(impedance, frequency, 5, 1), 1.0) << frequency;
}

TEST(LaggedLoads, SpanOfHalfTheStableStepDoesNotDriveTheFastestMotionOfTheIce) {
  for (const double impedance : {0.1, 0.4, 1.0, 2.0}) EXPECT_LT(growth(impedance, 1.0, 5, 1), 1.0) << impedance;
  EXPECT_GT(growth(0.4, 1.6, 5, 1), 100);
}
