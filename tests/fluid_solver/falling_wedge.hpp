#pragma once
#include <cmath>
#include <numbers>

#include "tests/fluid_solver/slice_entry.hpp"

/// A rigid wedge that falls into water: the fluid slows it, it moves the fluid. Its velocity follows from the impulse
/// of the last step, which is short enough for that: the water that sound reaches in a step weighs a tenth of the
/// wedge.
namespace polynya::fluid::test {

struct Reading {
  double time, value;
};

/// Linear between readings.
inline double read_at(const std::vector<Reading>& curve, double time) {
  std::size_t n = 1;
  while (n + 1 < curve.size() && curve[n].time < time) ++n;
  const Reading &a = curve[n - 1], &b = curve[n];
  return a.value + (b.value - a.value) * (time - a.time) / (b.time - a.time);
}

/// Boundary-element velocity (s, m/s) for the wedge of Yettou, Desrochers & Champoux 2006 as in Sun et al. 2015.
inline const std::vector<Reading> wedge_velocity{
    {0.00024, 5.045}, {0.00250, 4.956}, {0.00492, 4.680}, {0.00728, 4.359}, {0.00964, 4.020}, {0.01188, 3.654},
    {0.01431, 3.360}, {0.01655, 3.120}, {0.01892, 2.870}, {0.02117, 2.683}, {0.02360, 2.487}, {0.02603, 2.372},
    {0.02834, 2.194}, {0.03060, 2.114}, {0.03291, 1.945}, {0.03535, 1.883}, {0.03778, 1.776}, {0.04010, 1.759}};

/// What falls: half a body, per length of the slice.
struct Fall {
  double mass, velocity;  ///< kg/m, m/s (down)
  double depth = 0;       ///< m that it has fallen
};

/// Falls at constant speed down to the water, from far enough for the air to be on its way aside when it comes there: air
/// that starts at rest would slow the body by a piston's pressure. Returns the instant at which the depth is 0.
template <class BodyAt>
double fall_to_water(Fluid& fluid, Fall& body, BodyAt&& at) {
  while (body.depth < 0) {
    const double dt = 0.8 * stable_step(fluid);
    body.depth += dt * body.velocity;
    step(fluid, dt, overlap_of(fluid.grid, at(body.depth), {0, -body.velocity}));
  }
  return fluid.time - body.depth / body.velocity;
}

/// One step of both.
template <class BodyAt>
void fall_on(Fluid& fluid, Fall& body, double gravity, BodyAt&& at) {
  const double dt = 0.8 * stable_step(fluid), before = lift_impulse(fluid);
  step(fluid, dt, overlap_of(fluid.grid, at(body.depth + dt * body.velocity), {0, -body.velocity}));
  body.depth += dt * body.velocity;
  body.velocity += dt * gravity - (lift_impulse(fluid) - before) / body.mass;
}

/// A wedge that falls with the added mass of similarity: as long as the flow only grows, momentum of water 0.5 C rho s^2 V, C the
/// force over rho V^3 t at constant speed; besides weight and the water that it displaces below the level at rest.
struct SimilarFall {
  double mass, force, slope, gravity;  ///< of half a body: kg/m, C / 2, 1, m/s^2
  double velocity, depth = 0;

  /// Midpoint rule.
  void advance(double dt) {
    const auto acceleration = [&](double s, double v) {
      const double added = 0.5 * force * 1000 * s * s;
      return (mass * gravity - force * 1000 * s * v * v - 500 * gravity * s * s / slope) / (mass + added);
    };
    const double half = velocity + 0.5 * dt * acceleration(depth, velocity);
    const double change = dt * acceleration(depth + 0.5 * dt * velocity, half);
    depth += dt * half;
    velocity += change;
  }
};

/// Largest difference of the velocity from the boundary elements' and from similarity's, over that at the start; water inside
/// the wedge over what it displaces.
struct Fallen {
  double velocity, similarity, inside;
};

/// 25 degrees, 1.2 m wide, 94 kg/m, 5.05 m/s, for 40 ms from the first contact. The tank is 5 m wide and 1.1 m deep. Cells at
/// the keel are `smallest` wide and grow by `part` of their distance from it; `sound`: speed in water, m/s (in air 344).
inline Fallen drop_wedge(double smallest, double part, double sound, const std::string& field = {}) {
  constexpr double gravity = 9.81;
  const double half = 0.6, slope = std::tan(25 * std::numbers::pi / 180), height = half * slope;
  polynya::fluid::Setup setup = slice_setup(sound, true);
  setup.gravity = gravity;
  Fluid fluid{Grid(spreading_line(0, 2.5, smallest, part, 0.62), {0, smallest}, spreading_line(-1.1, 0.8, smallest, part, 0.3)),
              setup};
  const auto at = [&](double depth) {
    const double edge = height - depth, top = edge + 0.25;
    return Polygon{{0, -depth}, {half, edge}, {half, top}, {-half, top}, {-half, edge}};
  };
  Fall wedge{47, 5.05, -0.1};
  fill_hydrostatic(fluid, overlap_of(fluid.grid, at(wedge.depth), {0, -wedge.velocity}), 0.0);
  const double contact = fall_to_water(fluid, wedge, at);
  double worst = 0, farthest = 0, shown = 0, similar_time = 0;
  SimilarFall similar{wedge.mass, 0.5 * 23.657, slope, gravity, wedge.velocity};  // Zhao & Faltinsen 1993
  while (fluid.time < contact + 0.04) {
    fall_on(fluid, wedge, gravity, at);
    similar.advance(fluid.time - contact - similar_time);
    similar_time = fluid.time - contact;
    farthest = std::max(farthest, std::abs(wedge.velocity - similar.velocity) / wedge_velocity.front().value);
    const double time = fluid.time - contact, expected = read_at(wedge_velocity, time);
    worst = std::max(worst, std::abs(wedge.velocity - expected) / wedge_velocity.front().value);
    if (time < shown) continue;
    std::printf("  %.1f ms: %.3f m/s, boundary elements %.3f, similarity %.3f\n", 1e3 * time, wedge.velocity, expected,
                similar.velocity);
    shown += 0.004;
  }
  if (!field.empty()) write_field(fluid, field);
  const double displaced = fluid.grid.y[1] * 0.5 * wedge.depth * wedge.depth / slope;
  const Fallen fallen{worst, farthest, water_inside(fluid) / displaced};
  std::printf(
      "dropped wedge, cells of %g mm and %g of the distance, sound %g m/s, %ld steps of %zu cells: velocity off by %.2f %% at "
      "most, from similarity by %.2f %%; water inside %.1e\n",
      1e3 * smallest, part, sound, fluid.steps, fluid.grid.cells(), 100 * fallen.velocity, 100 * fallen.similarity,
      fallen.inside);
  return fallen;
}

}  // namespace polynya::fluid::test
