// The reference for wedges in compressible water against the wave equation by finite differences.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/fluid_solver/acoustic_entry.hpp"

using polynya::fluid::test::acoustic_entry;

namespace {

/// Half of a plate of unit normal velocity and half-width edge_mach t in a half-plane of unit sound speed whose surface is free
/// beside it (potential 0): Int potential dx over it at time `end`, cells of size 1, leapfrog.
double potential_under_growing_plate(double edge_mach, double end) {
  const int n = static_cast<int>(1.05 * end) + 4;
  const double dt = 0.5;
  std::vector<double> now(n * n), before(n * n), next(n * n);
  for (double t = 0; t < end; t += dt) {
    for (int i = 0; i < n; ++i) {
      const double wetted = std::clamp(edge_mach * t - i, 0.0, 1.0);
      for (int j = 0; j < n; ++j) {
        const double here = now[i * n + j];
        const auto across = [&](bool inside, int other) { return inside ? now[other] - here : 0; };
        const double surface = j > 0 ? now[i * n + j - 1] - here : wetted * -1 + (1 - wetted) * -2 * here;
        const double laplacian = across(i > 0, (i - 1) * n + j) + across(i + 1 < n, (i + 1) * n + j) + surface +
                                 across(j + 1 < n, i * n + j + 1);
        next[i * n + j] = 2 * here - before[i * n + j] + dt * dt * laplacian;
      }
    }
    before.swap(now), now.swap(next);
  }
  double sum = 0;
  for (int i = 0; i < n; ++i) sum -= now[i * n];
  return sum;
}

}  // namespace

TEST(AcousticEntry, IsWagnersWhereSoundIsFast) {
  const auto slow = acoustic_entry(30, 1e-4);
  EXPECT_NEAR(slow.edge_mach, 1e-4 * std::numbers::pi / 2 / std::tan(std::numbers::pi / 6), 1e-9);
  EXPECT_NEAR(slow.half_width, 1, 1e-5);
  EXPECT_NEAR(slow.force, 1, 1e-5);
}

TEST(AcousticEntry, ImpulseOfAGrowingPlateIsThatOfTheWaveEquation) {
  for (const double mach : {0.3, 0.6}) {
    const double end = 200, exact = std::numbers::pi / 4 * std::pow(mach * end, 2) / std::comp_ellint_2(std::sqrt(1 - mach * mach));
    EXPECT_NEAR(potential_under_growing_plate(mach, end) / exact, 1, 0.01) << mach;
  }
}

TEST(AcousticEntry, ForceIsThatOfThePlateWithTheEdgeOfWagnersCondition) {
  const auto entry = acoustic_entry(10, 0.0203);
  const double elliptic = std::comp_ellint_2(std::sqrt(1 - entry.edge_mach * entry.edge_mach));
  EXPECT_NEAR(entry.force, std::pow(entry.half_width, 2) / elliptic, 1e-12);
  EXPECT_LT(entry.half_width, 1);
  EXPECT_NEAR(entry.force, 0.8885, 1e-3);
}
