#pragma once
#include <cmath>
#include <numbers>

#include "tests/fluid_solver/falling_wedge.hpp"

/// A rigid cylinder, lying, that falls into a tank (Greenhow & Lin 1983): 0.11 m across, half as dense as water, from 0.5 m
/// above: 2.955 m/s. Times over sqrt(D / g), depths of its lowest point below the waterline over D.
namespace polynya::fluid::test {

/// Boundary elements, as read by Sun et al. 2018.
inline const std::vector<Reading> cylinder_depth{{0, 0},         {0.087, 0.159}, {0.236, 0.405}, {0.404, 0.645},
                                                 {0.587, 0.868}, {0.838, 1.129}, {1.079, 1.336}, {1.279, 1.479}};

/// Largest difference of the depth from the boundary elements', over D; water inside over what is displaced.
struct Sunk {
  double depth, inside;
};

/// `across`: cells over the diameter, `until`: time over sqrt(D / g).
inline Sunk drop_cylinder(int across, double until, double sound, const std::string& field = {}) {
  constexpr double gravity = 9.81, diameter = 0.11, radius = diameter / 2;
  const double h = diameter / across, unit = std::sqrt(diameter / gravity);
  const auto whole = [&](double length) { return h * std::ceil(length / h); };
  polynya::fluid::Setup setup = slice_setup(sound, true);
  setup.gravity = gravity;
  Fluid fluid{Grid(graded_line(0, 0, whole(1.2 * diameter), 0.5, h, 1.1), {0, h},
                   graded_line(-0.3, -whole(1.6 * diameter), whole(0.6 * diameter), 0.3, h, 1.1)),
              setup};
  const int sides = 8 * across;
  // As large as the circle.
  const double outer = radius * std::sqrt(2 * std::numbers::pi / (sides * std::sin(2 * std::numbers::pi / sides)));
  const auto at = [&](double depth) {
    Polygon polygon;
    for (int n = 0; n < sides; ++n) {
      const double angle = 2 * std::numbers::pi * (n + 0.5) / sides;
      polygon.push_back({outer * std::cos(angle), radius - depth + outer * std::sin(angle)});
    }
    return polygon;
  };
  Fall cylinder{0.5 * 500 * std::numbers::pi * radius * radius, 2.955, -diameter};
  fill_hydrostatic(fluid, overlap_of(fluid.grid, at(cylinder.depth), {0, -cylinder.velocity}), 0.0);
  const double contact = fall_to_water(fluid, cylinder, at);
  double worst = 0, shown = 0;
  while (fluid.time - contact < until * unit) {
    fall_on(fluid, cylinder, gravity, at);
    const double time = (fluid.time - contact) / unit, depth = cylinder.depth / diameter,
                 expected = read_at(cylinder_depth, time);
    worst = std::max(worst, std::abs(depth - expected));
    if (time < shown) continue;
    std::printf("  %.3f: %.3f D, boundary elements %.3f; %.3f m/s\n", time, depth, expected,
                cylinder.velocity);
    std::fflush(stdout);
    shown += 0.05;
  }
  if (!field.empty()) write_field(fluid, field);
  const Sunk sunk{worst, water_inside(fluid) / (fluid.grid.y[1] * 0.5 * std::numbers::pi * radius * radius)};
  std::printf("falling cylinder, %d cells over its diameter, %ld steps: depth off by %.3f D at most; water inside %.1e\n",
              across, fluid.steps, sunk.depth, sunk.inside);
  return sunk;
}

}  // namespace polynya::fluid::test
