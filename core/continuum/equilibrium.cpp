#include "core/continuum/equilibrium.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <utility>

#include "core/continuum/bad_element.hpp"
#include "core/continuum/hourglass.hpp"
#include "core/continuum/newton_equilibrium.hpp"
#include "core/continuum/rigid_modes.hpp"
#include "core/continuum/static_step.hpp"

namespace polynya::continuum {
namespace {

constexpr int most_steps = 200000, steps_between_checks = 50, most_swings = 5;
constexpr double step_factor = 0.9;
constexpr double relaxation_tolerance = 1e-6, newton_tolerance = 1e-10;  // of the largest load on a node

double largest_of(std::span<const double> loads) {
  double largest = 0;
  for (const double load : loads) largest = std::max(largest, std::abs(load));
  return largest;
}

/// Largest force that is not balanced, over free components.
double imbalance(const ExplicitSolid& solid, std::span<const double> loads) {
  double largest = 0;
  for (std::size_t i = 0; i < loads.size(); ++i)
    if (!(solid.fixed[i / 3] >> i % 3 & 1)) largest = std::max(largest, std::abs(solid.internal_force[i] + loads[i]));
  return largest;
}

/// What rounding of the positions does to the force on a node, N: strains of 2^-52 x position / element in elements of
/// that size; and what hourglass shapes left out do, 64 k_m G_m with k_m = E V/(192 a^2) (hourglass.hpp).
double rounding_force(const ExplicitSolid& solid) {
  double farthest = 0, largest = 0;
  for (const double x : solid.positions) farthest = std::max(farthest, std::abs(x));
  for (const double volume : solid.element.reference_volume) largest = std::max(largest, volume);
  const double speed = longitudinal_wave_speed(solid.law), size = std::cbrt(largest);
  return std::max(4 * 0x1p-52 * farthest, 64.0 / 96 * least_natural_hourglass * size) * size * density(solid.law) *
         speed * speed;
}

/// What may stay without balance, N: a share of the largest load, or some times what rounding hides.
double enough_for(const ExplicitSolid& solid, std::span<const double> loads, double tolerance, double roundings) {
  return std::max(tolerance * largest_of(loads), roundings * rounding_force(solid));
}

/// From rest at the present positions: half a step of acceleration. A plain stop would leave the fastest modes, w dt
/// near 2, at 1 / cos(asin(w dt / 2)) of their amplitude, and a body that is stopped often would fly apart.
void start_from_rest(ExplicitSolid& solid, std::span<const double> loads, double dt) {
  std::fill(solid.velocities.begin(), solid.velocities.end(), 0.0);
  advance_velocities(solid, loads, 0, dt);
}

double kinetic_energy(const ExplicitSolid& solid) {
  double sum = 0;
  for (std::size_t i = 0; i < solid.velocities.size(); ++i)
    sum += 0.5 * solid.masses[i / 3] * solid.velocities[i] * solid.velocities[i];
  return sum;
}

std::runtime_error unbalanced(const ExplicitSolid& solid, double left, const std::string& after) {
  char share[32];
  std::snprintf(share, sizeof share, "%.2g", left);
  return std::runtime_error("no equilibrium: " + std::string(share) + " of the largest nodal load on body '" +
                            solid.name + "' is not balanced after " + after);
}

/// Returns the number of steps.
int relax(ExplicitSolid& solid, std::span<const double> loads, double enough) {
  solid.damped = {};  // nothing leaves while the body comes to rest, and nothing but the loads acts on it then
  double dt = step_factor * stable_step(solid), kinetic = 0, left = 0;
  internal_forces(solid, 0);
  start_from_rest(solid, loads, dt);
  for (int step = 1; step <= most_steps; ++step) {
    advance_positions(solid, dt);
    internal_forces(solid, dt);
    if (step % steps_between_checks == 0 && (left = imbalance(solid, loads)) <= enough) return step;
    const double next = step_factor * stable_step(solid);
    advance_velocities(solid, loads, dt, next);
    dt = next;
    const double now = kinetic_energy(solid);
    if (now < kinetic) start_from_rest(solid, loads, dt);
    kinetic = now < kinetic ? 0 : now;
  }
  throw unbalanced(solid, left / largest_of(loads), std::to_string(most_steps) + " steps of relaxation");
}

/// The body whose displacement from the shape without stress is `displacement`: at its present positions, at rest.
/// The swing ends at other positions, by strains and, in slender bodies, by turns: what balances there does not quite
/// do so here, and swings again.
ExplicitSolid relaxed(const ExplicitSolid& solid, std::span<const double> loads, EquilibriumReport& report) {
  const RememberedState start = remembered_state(solid);
  const double enough = enough_for(solid, loads, relaxation_tolerance, 4),
               enough_for_a_swing = enough_for(solid, loads, 0.2 * relaxation_tolerance, 1);
  std::vector<double> displacement(loads.size(), 0.0);
  ExplicitSolid found = solid;
  for (int swing = 0; swing < most_swings; ++swing) {
    ExplicitSolid swinging = found;
    report.iterations += relax(swinging, loads, enough_for_a_swing);
    for (std::size_t i = 0; i < loads.size(); ++i) {
      displacement[i] += swinging.positions[i] - solid.positions[i];
      found.mesh.nodes[i] = solid.mesh.nodes[i] - displacement[i];
    }
    step_from_reference(found, start, solid.positions, displacement);
    report.imbalance = imbalance(found, loads);
    if (report.imbalance <= enough) return found;
  }
  throw unbalanced(solid, report.imbalance / largest_of(loads), "relaxation at the shape of the scene");
}

/// Shape without stress, stress and what else the law remembers.
void take_over(ExplicitSolid&& from, ExplicitSolid& solid) {
  solid.mesh = std::move(from.mesh);
  solid.natural_hourglass = std::move(from.natural_hourglass);
  solid.hourglass_stiffness = std::move(from.hourglass_stiffness);
  solid.irregular = std::move(from.irregular);
  solid.element.reference_volume = std::move(from.element.reference_volume);
  solid.element.stress = std::move(from.element.stress);
  solid.element.damage = std::move(from.element.damage);
  solid.element.plastic_strain = std::move(from.element.plastic_strain);
  solid.element.bulking_pressure = std::move(from.element.bulking_pressure);
  solid.points = std::move(from.points);
}

EquilibriumReport by_newton(ExplicitSolid& solid, std::span<const double> loads) {
  NewtonResult found = newton_equilibrium(solid, loads, enough_for(solid, loads, newton_tolerance, 1));
  take_over(std::move(found.solid), solid);
  return {EquilibriumMethod::newton, found.iterations, found.factorisations, found.imbalance};
}

EquilibriumReport by_relaxation(ExplicitSolid& solid, std::span<const double> loads) {
  EquilibriumReport report{EquilibriumMethod::relaxation, 0, 0, 0};
  try {
    take_over(relaxed(solid, loads, report), solid);
  } catch (const BadElement& error) {
    throw std::runtime_error(std::string("no equilibrium: ") + error.what());
  }
  return report;
}

}  // namespace

EquilibriumReport bring_into_equilibrium(ExplicitSolid& solid, std::span<const double> loads,
                                         EquilibriumMethod method) {
  if (std::all_of(loads.begin(), loads.end(), [](double load) { return load == 0; })) return {};
  const std::vector<double> balanced = without_rigid_acceleration(solid, loads);
  if (method == EquilibriumMethod::newton) return by_newton(solid, balanced);
  if (method == EquilibriumMethod::automatic && solid.node_count() <= most_nodes_for_newton) {
    try {
      return by_newton(solid, balanced);
    } catch (const std::runtime_error&) {
      // Parts that are each in balance alone, or strength that a Newton step jumps over: they may still come to rest.
    }
  }
  return by_relaxation(solid, balanced);
}

}  // namespace polynya::continuum
