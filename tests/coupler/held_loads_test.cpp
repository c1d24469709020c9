#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "coupler/stability_limits.hpp"

/// The model problem behind the bounds of coupler/stability_limits.hpp: a wall of areal mass 1 on a spring against a
/// fluid that answers with `impedance` times the wall's mean speed of the span before; spans of length 1 in `windows`
/// steps. Returns the growth of the largest amplitude over 300 spans.
namespace {

double growth(double impedance, double frequency, int windows) {
  const double dt = 1.0 / windows;
  double speed = 1, position = 0, force = 0, late = 0;
  for (int span = 0; span < 300; ++span) {
    double travelled = 0;
    for (int w = 0; w < windows; ++w) {
      const double before = speed;
      speed += dt * (force - frequency * frequency * position);
      position += dt * speed;
      travelled += 0.5 * (before + speed) * dt;
    }
    force = -impedance * travelled;
    if (span >= 270) late = std::max(late, std::abs(speed) + frequency * std::abs(position));
    if (!(std::abs(speed) < 1e12)) return 1e12;
  }
  return late;
}

}  // namespace

TEST(HeldLoads, FreeWallIsStableUpToTwiceTheBoundOfTheSpan) {
  for (const double impedance : {0.1, 0.5, 1.0, 1.9}) EXPECT_LT(growth(impedance, 0, 4), 1e-2);
  EXPECT_GT(growth(2.5, 0, 4), 1e6);
}

TEST(HeldLoads, DriveWallsThatOscillateFasterThanTheSpan) {
  for (const double frequency : {2.0, 2.5, 3.0}) EXPECT_GT(growth(0.4, frequency, 5), 1e6) << frequency;
}

TEST(HeldLoads, WithinBothBoundsKeepEveryWallQuiet) {
  using namespace polynya::coupler;
  for (const double share : {0.1, 0.5, 1.0})
    for (const double turn : {0.0, 0.3, 0.6, 1.0})
      for (const int windows : {1, 2, 5})
        EXPECT_LT(growth(share * lag_factor, turn * 2 * held_share_of_step, windows), 1e-1) << share << " " << turn;
}
