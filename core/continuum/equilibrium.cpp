#include "core/continuum/equilibrium.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace polynya::continuum {
namespace {

constexpr int most_steps = 200000, steps_between_checks = 50;
constexpr double step_factor = 0.9, tolerance = 1e-6;  // of the largest load on a node

Eigen::Vector3d row(std::span<const double> values, std::size_t i) {
  return {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
}

/// Bits of components that some node holds: motion along these is not free.
int held_components(const ExplicitSolid& solid) {
  int held = 0;
  for (const std::uint8_t bits : solid.fixed) held |= bits;
  return held;
}

/// Largest force that is not balanced, over free components.
double imbalance(const ExplicitSolid& solid, std::span<const double> loads) {
  double largest = 0;
  for (std::size_t i = 0; i < loads.size(); ++i)
    if (!(solid.fixed[i / 3] >> i % 3 & 1)) largest = std::max(largest, std::abs(solid.internal_force[i] + loads[i]));
  return largest;
}

/// What rounding of the positions does to the force on a node, N: strains of 2^-52 x position / element in elements of
/// that size.
double rounding_force(const ExplicitSolid& solid) {
  double farthest = 0, largest = 0;
  for (const double x : solid.positions) farthest = std::max(farthest, std::abs(x));
  for (const double volume : solid.element.reference_volume) largest = std::max(largest, volume);
  const double speed = longitudinal_wave_speed(solid.law);
  return 4 * 0x1p-52 * farthest * std::cbrt(largest) * density(solid.law) * speed * speed;
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

void relax(ExplicitSolid& solid, std::span<const double> loads) {
  double largest_load = 0;
  for (const double load : loads) largest_load = std::max(largest_load, std::abs(load));
  const double enough = std::max(tolerance * largest_load, rounding_force(solid));
  solid.damped = {};  // nothing leaves while the body comes to rest, and nothing but the loads acts on it then
  double dt = step_factor * stable_step(solid), kinetic = 0, left = 0;
  internal_forces(solid, 0);
  start_from_rest(solid, loads, dt);
  for (int step = 1; step <= most_steps; ++step) {
    advance_positions(solid, dt);
    internal_forces(solid, dt);
    if (step % steps_between_checks == 0 && (left = imbalance(solid, loads)) <= enough) return;
    const double next = step_factor * stable_step(solid);
    advance_velocities(solid, loads, dt, next);
    dt = next;
    const double now = kinetic_energy(solid);
    if (now < kinetic) start_from_rest(solid, loads, dt);
    kinetic = now < kinetic ? 0 : now;
  }
  throw std::runtime_error("body '" + solid.name + "' found no equilibrium with the loads it starts under: " +
                           std::to_string(left / largest_load) + " of the largest nodal load is not balanced after " +
                           std::to_string(most_steps) + " steps of relaxation");
}

}  // namespace

std::vector<double> without_rigid_acceleration(const ExplicitSolid& solid, std::span<const double> loads) {
  using Eigen::Matrix3d, Eigen::Vector3d;
  const int held = held_components(solid);
  Vector3d force = Vector3d::Zero(), moment = Vector3d::Zero(), centre = Vector3d::Zero();
  Matrix3d inertia = Matrix3d::Zero();
  double mass = 0;
  for (std::size_t i = 0; i < solid.node_count(); ++i) {
    mass += solid.masses[i];
    centre += solid.masses[i] * row(solid.positions, i);
    force += row(loads, i);
  }
  centre /= mass;
  for (std::size_t i = 0; i < solid.node_count(); ++i) {
    const Vector3d arm = row(solid.positions, i) - centre;
    moment += arm.cross(row(loads, i));
    inertia += solid.masses[i] * (arm.squaredNorm() * Matrix3d::Identity() - arm * arm.transpose());
  }
  // A rotation moves both components across its axis. Where one axis alone is free it is a principal one by symmetry.
  Vector3d turn = inertia.ldlt().solve(moment);
  for (int axis = 0; axis < 3; ++axis) {
    if (held >> axis & 1) force[axis] = 0;
    const int across = 7 & ~(1 << axis);
    if (held & across) turn[axis] = 0;
    if (held && !(held & across)) turn[axis] = moment[axis] / inertia(axis, axis);
  }
  std::vector<double> balanced(loads.begin(), loads.end());
  for (std::size_t i = 0; i < solid.node_count(); ++i) {
    const Vector3d acceleration = force / mass + turn.cross(row(solid.positions, i) - centre);
    for (int axis = 0; axis < 3; ++axis) balanced[3 * i + axis] -= solid.masses[i] * acceleration[axis];
  }
  return balanced;
}

void bring_into_equilibrium(ExplicitSolid& solid, std::span<const double> loads) {
  if (std::all_of(loads.begin(), loads.end(), [](double load) { return load == 0; })) return;
  ExplicitSolid relaxed = solid;
  relax(relaxed, without_rigid_acceleration(solid, loads));
  HexMesh unloaded = solid.mesh;
  for (std::size_t i = 0; i < unloaded.nodes.size(); ++i)
    unloaded.nodes[i] -= relaxed.positions[i] - solid.positions[i];
  ExplicitSolid shaped = make_solid(solid.name, unloaded, solid.law, solid.numerics);
  solid.mesh = std::move(unloaded);
  solid.natural_hourglass = std::move(shaped.natural_hourglass);
  solid.hourglass_stiffness = std::move(shaped.hourglass_stiffness);
  solid.irregular = std::move(shaped.irregular);
  solid.element.reference_volume = std::move(shaped.element.reference_volume);
  solid.element.stress = std::move(relaxed.element.stress);
  solid.points = std::move(relaxed.points);
}

}  // namespace polynya::continuum
