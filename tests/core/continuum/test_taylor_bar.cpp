#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "block.hpp"
#include "core/continuum/explicit_solid.hpp"

namespace polynya::continuum {
namespace {

const J2Plastic copper{8930, 117e9 / (3 * (1 - 2 * 0.35)), 117e9 / (2 * (1 + 0.35)), 400e6, 100e6};

/// A quarter of a cylinder along z: a square net of n x n columns drawn to the circle.
ExplicitSolid quarter_bar(int n, int along, double radius, double length) {
  auto mesh = tests::block({n, n, along}, {1, 1, length}, [&](double* x) {
    // Squares around the axis become circles the more the farther out they are.
    const double r = std::max(x[0], x[1]), norm = std::hypot(x[0], x[1]);
    if (norm == 0) return;
    const double circle = r / norm, square = 0.8;
    const double blend = square * (1 - r) + circle * r;
    x[0] *= radius * blend;
    x[1] *= radius * blend;
  });
  auto solid = make_solid("bar", mesh, copper);
  for (std::size_t i = 0; i < solid.node_count(); ++i) {
    const double* x = &solid.mesh.nodes[3 * i];
    solid.fixed[i] = static_cast<std::uint8_t>((x[0] == 0 ? 1 : 0) | (x[1] == 0 ? 2 : 0) | (x[2] == 0 ? 4 : 0));
    solid.velocities[3 * i + 2] = x[2] == 0 ? 0 : -227;
  }
  return solid;
}

struct Bar {
  double length, radius, plastic_strain, energy_error;
};

/// Copper bar of 32.4 mm by 6.4 mm that meets a rigid wall without friction at 227 m/s, after 80 us.
Bar taylor_bar(int n, int along) {
  auto solid = quarter_bar(n, along, 3.2e-3, 32.4e-3);
  const std::vector<double> none(3 * solid.node_count(), 0.0);
  double before = 0;
  internal_forces(solid, 0);
  double dt = 0.6 * stable_step(solid);
  advance_velocities(solid, none, 0, dt);
  const double start = energies(solid).balance(), kinetic = energies(solid).kinetic;
  while (solid.time < 80e-6) {
    before = dt;
    advance_positions(solid, dt);
    internal_forces(solid, dt);
    dt = std::min(1.02 * dt, 0.6 * stable_step(solid));
    advance_velocities(solid, none, before, dt);
  }
  Bar bar{0, 0, 0, std::abs(energies(solid).balance() - start) / kinetic};
  for (std::size_t i = 0; i < solid.node_count(); ++i) {
    const double* x = &solid.positions[3 * i];
    bar.length = std::max(bar.length, x[2]);
    if (solid.mesh.nodes[3 * i + 2] == 0) bar.radius = std::max(bar.radius, std::hypot(x[0], x[1]));
  }
  for (std::size_t e = 0; e < solid.element_count(); ++e)
    bar.plastic_strain = std::max(bar.plastic_strain, solid.element.plastic_strain[e]);
  std::printf("%d elements over the radius: length %.2f mm, radius %.2f mm, plastic strain %.2f, energy error %.1e\n",
              n, 1e3 * bar.length, 1e3 * bar.radius, bar.plastic_strain, bar.energy_error);
  return bar;
}

// Published results of many codes: length 21.4 to 21.5 mm, radius of the foot 7.0 to 7.2 mm, plastic strain 2.9 to 3.3.
void expect_published_length(const Bar& bar) {
  EXPECT_GT(bar.length, 21.4e-3);
  EXPECT_LT(bar.length, 21.5e-3);
  EXPECT_LT(bar.energy_error, 1e-10);
}

TEST(TaylorBar, OfCopperShortensAsPublished) {
  expect_published_length(taylor_bar(5, 36));
}

TEST(TaylorBarLong, OfCopperSpreadsAndHardensAsPublishedOnThreeMeshes) {
  for (const Bar& bar : {taylor_bar(10, 72), taylor_bar(12, 86), taylor_bar(15, 108)}) {
    expect_published_length(bar);
    EXPECT_GT(bar.radius, 7.0e-3);
    EXPECT_LT(bar.radius, 7.2e-3);
    EXPECT_GT(bar.plastic_strain, 2.9);
    EXPECT_LT(bar.plastic_strain, 3.3);
  }
}

}  // namespace
}  // namespace polynya::continuum
