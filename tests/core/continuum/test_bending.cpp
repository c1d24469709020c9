#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "block.hpp"
#include "core/continuum/explicit_solid.hpp"

namespace polynya::continuum {
namespace {

constexpr double youngs_modulus = 70e9, poisson_ratio = 0.3, density = 2700, length = 1, height = 0.1, width = 0.1;

/// First natural frequency of a clamped-free beam by Timoshenko's theory (Huang 1961, J. Appl. Mech. 28:579), 1/s.
double timoshenko_frequency() {
  const double shear = youngs_modulus / (2 * (1 + poisson_ratio));
  const double coefficient = 10 * (1 + poisson_ratio) / (12 + 11 * poisson_ratio);  // Cowper 1966
  const double r = height * height / 12 / (length * length);
  const double s = r * youngs_modulus / (coefficient * shear);
  const auto equation = [&](double b) {
    const double root = std::sqrt((r - s) * (r - s) + 4 / (b * b));
    const double alpha = std::sqrt((root - (r + s)) / 2), beta = std::sqrt((root + (r + s)) / 2);
    return 2 + (b * b * (r - s) * (r - s) + 2) * std::cosh(b * alpha) * std::cos(b * beta) -
           b * (r + s) / std::sqrt(1 - b * b * r * s) * std::sinh(b * alpha) * std::sin(b * beta);
  };
  double low = 2, high = 4;  // Euler: 1.8751^2 = 3.516
  for (int k = 0; k < 100; ++k) ((equation((low + high) / 2) > 0) ? low : high) = (low + high) / 2;
  return low * std::sqrt(youngs_modulus * height * height / 12 / density) / (length * length) / (2 * M_PI);
}

struct Swing {
  double frequency, hourglass_share;
};

/// n elements through the height, cut along the beam by `aspect` times that.
Swing cantilever(int n, int across, double aspect, Numerics numerics) {
  const int along = static_cast<int>(std::lround(n * length / height / aspect));
  const Elastic law{density, youngs_modulus / (3 * (1 - 2 * poisson_ratio)),
                    youngs_modulus / (2 * (1 + poisson_ratio))};
  auto beam = make_solid("beam", tests::block({along, across, n}, {length, width, height}), law, numerics);
  for (std::size_t i = 0; i < beam.node_count(); ++i) {
    const double x = beam.mesh.nodes[3 * i], xi = x / length;
    if (x == 0) beam.fixed[i] = 0b111;
    beam.velocities[3 * i + 2] = 0.01 * xi * xi * (1.5 - 0.5 * xi);
  }
  const std::vector<double> none(3 * beam.node_count(), 0.0);
  const double dt = 0.9 * stable_step(beam);
  internal_forces(beam, 0);
  advance_velocities(beam, none, 0, dt);
  Swing swing{0, 0};
  double before = 0, most = 0;
  int turns = 0;
  double first = 0;
  while (turns < 3) {
    advance_positions(beam, dt);
    internal_forces(beam, dt);
    advance_velocities(beam, none, dt, dt);
    double v = 0;
    for (std::size_t i = 0; i < beam.node_count(); ++i) {
      const double xi = beam.mesh.nodes[3 * i] / length;
      v += beam.masses[i] * xi * xi * (1.5 - 0.5 * xi) * (beam.positions[3 * i + 2] - beam.mesh.nodes[3 * i + 2]);
    }
    const auto account = energies(beam);
    if (account.internal > most) {
      most = account.internal;
      swing.hourglass_share = account.hourglass / (account.internal + account.hourglass);
    }
    if (before * v < 0) {
      const double time = beam.time - dt * v / (v - before);
      if (turns == 0) first = time;
      if (turns == 2) swing.frequency = 1 / (time - first);
      ++turns;
    }
    before = v;
  }
  return swing;
}

double error_of(const Swing& swing) {
  return swing.frequency / timoshenko_frequency() - 1;
}

/// Without anything that dissipates.
Numerics elastic_only() {
  Numerics numerics;
  numerics.linear_viscosity = numerics.quadratic_viscosity = 0;
  numerics.hourglass_viscosity = numerics.hourglass_floor = 0;
  return numerics;
}

void expect_swing(int n, double aspect, double tolerance) {
  const Swing swing = cantilever(n, n, aspect, elastic_only());
  const double error = error_of(swing);
  std::printf("%d elements through the height, %.0f times as long: frequency %+.2f %%, hourglass energy %.4f\n", n,
              aspect, 100 * error, swing.hourglass_share);
  EXPECT_LT(std::abs(error), tolerance);
  EXPECT_LT(swing.hourglass_share, 1.2 / (n * n));
}

TEST(Cantilever, SwingsWithTheFrequencyOfTimoshenkosBeamOnTwoElementsAndOnFour) {
  expect_swing(2, 1, 0.02);
  expect_swing(4, 1, 0.015);
}

TEST(Cantilever, LongElementsDoNotLock) {
  expect_swing(2, 4, 0.02);
  expect_swing(4, 4, 0.015);
}

/// From 2 and 4 elements through the height to ever more, if the error falls with the square of their size.
double extrapolated_error(Numerics numerics) {
  const double coarse = error_of(cantilever(2, 2, 1, numerics)), fine = error_of(cantilever(4, 4, 1, numerics));
  EXPECT_LT(std::abs(fine), 0.015);
  const double limit = fine - (coarse - fine) / 3;
  std::printf("%s: frequency %+.2f, %+.2f %%, without end %+.2f %%\n",
              numerics.integration == Integration::full ? "2 x 2 x 2 points" : "one point", 100 * coarse, 100 * fine,
              100 * limit);
  return limit;
}

// What is left of both is not theirs: a clamped end keeps its cross-section from narrowing, a beam's theory does not.
TEST(Cantilever, ElementsOfBothIntegrationsComeToTheSameFrequency) {
  Numerics full = elastic_only();
  full.integration = Integration::full;
  EXPECT_NEAR(extrapolated_error(full), extrapolated_error(elastic_only()), 0.002);
}

}  // namespace
}  // namespace polynya::continuum
