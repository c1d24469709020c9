#pragma once
#include <cmath>
#include <numeric>
#include <vector>

#include "core/continuum/law.hpp"
#include "ice_solver/account.hpp"
#include "ice_solver/ice_body.hpp"

namespace polynya::ice::testing {

inline std::vector<double> line(double from, double to, int cells) {
  std::vector<double> nodes(static_cast<std::size_t>(cells) + 1);
  for (int i = 0; i <= cells; ++i) nodes[static_cast<std::size_t>(i)] = from + (to - from) * i / cells;
  return nodes;
}

inline continuum::Law elastic_ice() {
  return continuum::Elastic{900, 8.1254e9, 4.4444e9};
}

/// The constants of the card ice.fresh, but a damage constant at which elements fail later.
inline continuum::JohnsonHolmquist2 brittle_ice() {
  continuum::JohnsonHolmquist2 law;
  law.density = 900;
  law.shear_modulus = 4.4444e9;
  law.bulk_modulus = 8.1254e9;
  law.stress_at_hugoniot_elastic_limit = 2642.85e6;
  law.pressure_at_hugoniot_elastic_limit = 3438.1e6;
  law.intact_strength_constant = 1.4;
  law.intact_strength_exponent = 0.8918;
  law.strain_rate_constant = 0.05;
  law.fractured_strength_constant = 0.09;
  law.fractured_strength_exponent = 1.2;
  law.maximum_tensile_pressure = 1e6;
  law.damage_constant = 0.1;
  law.damage_exponent = 0.5;
  return law;
}

/// A free block of cells x cells x cells elements of edge `size`, all of one law, nothing converted by itself.
inline IceOptions block_options(int nx, int ny, int nz, double size, continuum::Law law = elastic_ice()) {
  IceOptions options;
  options.x = line(0, nx * size, nx);
  options.y = line(0, ny * size, ny);
  options.z = line(0, nz * size, nz);
  options.law = law;
  options.conversion = false;
  return options;
}

/// Elements whose centre fulfils a condition.
template <class Condition>
std::vector<std::int32_t> elements_where(const IceBody& ice, Condition&& condition) {
  std::vector<std::int32_t> list;
  for (std::size_t e = 0; e < ice.solid.element_count(); ++e)
    if (ice.solid.element.alive[e] != 0 && condition(continuum::element_centre(ice.solid, e)))
      list.push_back(static_cast<std::int32_t>(e));
  return list;
}

inline std::vector<std::int32_t> all_elements(const IceBody& ice) {
  return elements_where(ice, [](const auto&) { return true; });
}

/// Starts the ice with forces at t = 0 and returns the first step.
inline double start(IceBody& ice, double factor = 0.8) {
  const double dt = factor * stable_step(ice);
  internal_forces(ice, 0);
  advance_velocities(ice, {}, {}, 0, dt);
  return dt;
}

/// One step of length dt, followed by one of the same length or of what is stable then.
inline double advance(IceBody& ice, double dt, double factor = 0.8) {
  advance_positions(ice, dt);
  internal_forces(ice, dt);
  const double next = std::min(factor * stable_step(ice), 1.1 * dt);
  advance_velocities(ice, {}, {}, dt, next);
  convert_failed_elements(ice);
  return next;
}

inline std::array<double, 3> momentum_of(const IceBody& ice) {
  std::array<double, 3> sum{};
  for (std::size_t n = 0; n < ice.solid.node_count(); ++n)
    for (std::size_t c = 0; c < 3; ++c) sum[c] += ice.solid.masses[n] * ice.solid.velocities[3 * n + c];
  const Points& points = ice.particles.points;
  for (std::size_t i = 0; i < points.count(); ++i)
    for (std::size_t c = 0; c < 3; ++c) sum[c] += points.mass[i] * points.velocity[3 * i + c];
  return sum;
}

inline double mass_of(const IceBody& ice) {
  return std::accumulate(ice.solid.masses.begin(), ice.solid.masses.end(), 0.0) +
         std::accumulate(ice.particles.points.mass.begin(), ice.particles.points.mass.end(), 0.0);
}

}  // namespace polynya::ice::testing
