#include "coupler/horizon.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace polynya;

namespace {

coupler::SolidSide body(std::vector<double> positions, std::vector<double> velocities, double radius = 0) {
  coupler::SolidSide side;
  side.ids.resize(positions.size() / 3);
  side.radii.assign(side.ids.size(), radius);
  side.positions = std::move(positions);
  side.velocities = std::move(velocities);
  return side;
}

constexpr double gravity = 9.81;

/// Whether the bounding boxes of two bodies meet after a time, if each vertex keeps `growth` times its velocity and the
/// bodies are pulled together along every axis.
bool meet(const coupler::SolidSide& a, const coupler::SolidSide& b, double time, double growth) {
  for (int axis = 0; axis < 3; ++axis) {
    double low[2] = {1e300, 1e300}, high[2] = {-1e300, -1e300};
    const coupler::SolidSide* sides[] = {&a, &b};
    for (int s = 0; s < 2; ++s)
      for (std::size_t v = 0; v < sides[s]->vertices(); ++v) {
        const double x = sides[s]->positions[3 * v + axis] + growth * sides[s]->velocities[3 * v + axis] * time;
        low[s] = std::min(low[s], x - sides[s]->radii[v]);
        high[s] = std::max(high[s], x + sides[s]->radii[v]);
      }
    const double pulled = 0.5 * gravity * time * time;
    if (low[1] - high[0] > pulled || low[0] - high[1] > pulled) return false;
  }
  return true;
}

}  // namespace

TEST(Horizon, HalfTheGapAtTheClosingSpeed) {
  const auto lower = body({0, 0, -0.1, 0, 0, -0.008}, {0, 0, 40, 0, 0, 40});
  const auto upper = body({0, 0, 0, 0, 0, 0.01}, {0, 0, 0, 0, 0, 0});
  EXPECT_NEAR(coupler::time_apart(lower, upper, 0), 0.004 / 40, 1e-16);
  EXPECT_NEAR(coupler::time_apart(upper, lower, 0), 0.004 / 40, 1e-16);
  // Debris 1 mm thick takes its radius from the gap.
  EXPECT_NEAR(coupler::time_apart(lower, body({0, 0, 0}, {0, 0, 0}, 0.0005), 0), 0.00375 / 40, 1e-16);
}

TEST(Horizon, BodiesAtRestCloseByTheirAccelerationAlone) {
  const auto a = body({0, 0, 0}, {0, 0, 0}), b = body({0, 0, 1}, {0, 0, 0});
  EXPECT_NEAR(coupler::time_apart(a, b, gravity), std::sqrt(1 / gravity), 1e-12);
}

TEST(Horizon, EndlessWhenTheyPartAndNothingPulls) {
  EXPECT_TRUE(std::isinf(coupler::time_apart(body({0, 0, 0}, {0, 0, -1}), body({0, 0, 1}, {0, 0, 1}), 0)));
}

TEST(Horizon, NoneWhereTheBoxesMeet) {
  const auto a = body({0, 0, 0, 1, 1, 1}, std::vector<double>(6, 0.0));
  const auto b = body({0.5, 0.5, 0.9, 2, 2, 2}, std::vector<double>(6, 0.0));
  EXPECT_EQ(coupler::time_apart(a, b, gravity), 0);
}

TEST(Horizon, ContactNeverBeginsWithinItEvenIfAllSpeedsDouble) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> place(-0.05, 0.05), offset(-0.2, 0.2), speed(-80, 80);
  int apart = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    std::vector<double> positions[2], velocities[2];
    for (int s = 0; s < 2; ++s) {
      const double shift[3] = {offset(random), offset(random), offset(random)};
      const double common[3] = {speed(random), speed(random), speed(random)};
      for (int v = 0; v < 5; ++v)
        for (int d = 0; d < 3; ++d) {
          positions[s].push_back(place(random) + shift[d]);
          velocities[s].push_back(common[d] + 0.3 * speed(random));
        }
    }
    const auto a = body(positions[0], velocities[0], 0.001), b = body(positions[1], velocities[1]);
    const double horizon = std::min(coupler::time_apart(a, b, gravity), 1.0);
    if (horizon == 0) continue;
    ++apart;
    for (int k = 0; k <= 20; ++k)
      for (const double growth : {1.0, 2.0})
        ASSERT_FALSE(meet(a, b, 0.999999 * horizon * k / 20, growth)) << "trial " << trial;
  }
  EXPECT_GT(apart, 10000);
}
