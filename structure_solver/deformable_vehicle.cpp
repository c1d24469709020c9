#include "structure_solver/deformable_vehicle.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include "core/compute/parallel.hpp"
#include "core/continuum/equilibrium.hpp"

namespace polynya::structure {
namespace {

constexpr std::size_t node_chunk = 4096;

continuum::ExplicitSolid make_body(const geometry::VehicleMesh& mesh, const continuum::Law& law, const Launch& launch) {
  continuum::ExplicitSolid solid = continuum::make_solid("vehicle", mesh.hexahedra, law);
  const Eigen::Vector3d velocity = launch.velocity();
  for (std::size_t i = 0; i < solid.node_count(); ++i) {
    for (int c = 0; c < 3; ++c) solid.velocities[3 * i + c] = velocity[c];
    if (mesh.node_flags[i] & geometry::on_plane_x) solid.fixed[i] |= 1;
    if (mesh.node_flags[i] & geometry::on_plane_y) solid.fixed[i] |= 2;
  }
  return solid;
}

}  // namespace

DeformableVehicle::DeformableVehicle(const geometry::VehicleMesh& mesh, const continuum::Law& law, const Launch& launch)
    : solid_(make_body(mesh, law, launch)),
      hull_nodes_(mesh.hull_nodes),
      probe_(solid_, launch),
      gravity_(launch.gravity),
      weight_(3 * solid_.node_count(), 0.0) {
  for (std::size_t i = 0; i < solid_.node_count(); ++i) {
    mass_ += solid_.masses[i];
    weight_[3 * i + 2] = -gravity_ * solid_.masses[i];
  }
  initial_centre_z_ = centre_of_mass_z();
  const auto [density, bulk, shear] = continuum::elastic_part(law);
  wave_time_ = launch.length / std::sqrt(9 * bulk * shear / (3 * bulk + shear) / density);
  external_ = weight_;
  // A step of no length settles the account of the start: kinetic energy is there before the first window.
  continuum::internal_forces(solid_, 0);
  continuum::advance_velocities(solid_, external_, 0, 0);
}

void DeformableVehicle::settle(std::span<const double> hull_force) {
  std::vector<double> loads = weight_;
  add_hull_force(hull_force, loads);
  continuum::bring_into_equilibrium(solid_, loads);
  start_damping_ = {2 * std::numbers::pi / wave_time_, solid_.time + 2 * wave_time_};
}

void DeformableVehicle::add_start_damping() {
  damping_force_.clear();
  const double rate = start_damping_.at(solid_.time);
  if (rate == 0) return;
  int held = 0;
  for (const std::uint8_t bits : solid_.fixed) held |= bits;
  damping_force_.resize(external_.size());
  for (std::size_t a = 0; a < 3; ++a) {
    double momentum = 0;
    for (std::size_t i = 0; i < solid_.node_count(); ++i) momentum += solid_.masses[i] * solid_.velocities[3 * i + a];
    const double mean = held >> a & 1 ? 0.0 : momentum / mass_;
    for (std::size_t i = 0; i < solid_.node_count(); ++i)
      damping_force_[3 * i + a] = -rate * solid_.masses[i] * (solid_.velocities[3 * i + a] - mean);
  }
  for (std::size_t i = 0; i < external_.size(); ++i) external_[i] += damping_force_[i];
}

double DeformableVehicle::damped_power() const {
  double power = 0;
  for (std::size_t i = 0; i < damping_force_.size(); ++i) power -= damping_force_[i] * solid_.velocities[i];
  return power;
}

void DeformableVehicle::advance_positions(double dt) {
  continuum::advance_positions(solid_, dt);
}

void DeformableVehicle::internal_forces(double dt) {
  continuum::internal_forces(solid_, dt);
}

void DeformableVehicle::add_hull_force(std::span<const double> hull_force, std::vector<double>& nodal_force) const {
  for (std::size_t v = 0; v < hull_nodes_.size(); ++v)
    for (int a = 0; a < 3; ++a) nodal_force[3 * hull_nodes_[v] + a] += hull_force[3 * v + a];
}

void DeformableVehicle::finish_step(std::span<const double> hull_force, double dt_previous, double dt_next) {
  external_ = weight_;
  if (!hull_force.empty()) add_hull_force(hull_force, external_);
  gravity_impulse_ -= 0.5 * (dt_previous + dt_next) * mass_ * gravity_;
  add_start_damping();
  damped_energy_ += std::exchange(pending_damped_energy_, 0.0) + 0.5 * dt_previous * damped_power();
  continuum::advance_velocities(solid_, external_, dt_previous, dt_next);
  pending_damped_energy_ = 0.5 * dt_next * damped_power();
}

double DeformableVehicle::stable_step() const {
  return continuum::stable_step(solid_);
}

double DeformableVehicle::centre_of_mass_z() const {
  return compute::ordered_sum(solid_.node_count(), node_chunk,
                              [&](std::size_t i) { return solid_.masses[i] * solid_.positions[3 * i + 2]; }) /
         mass_;
}

Account DeformableVehicle::account() const {
  const continuum::EnergyAccount energy = continuum::energies(solid_);
  Account a;
  a.kinetic = energy.kinetic;
  a.internal = energy.internal;
  a.hourglass = energy.hourglass;
  a.viscous = energy.viscous + damped_energy_;
  a.step_change = energy.step_change;
  a.mass = mass_;
  a.centre_of_mass_z = centre_of_mass_z();
  // The force of gravity is constant, so its work is the potential difference to rounding; the rest is the loads'.
  a.gravity_work = -mass_ * gravity_ * (a.centre_of_mass_z - initial_centre_z_);
  a.external_work = energy.external_work - a.gravity_work + damped_energy_;
  for (int c = 0; c < 3; ++c)
    a.momentum[c] = compute::ordered_sum(solid_.node_count(), node_chunk, [&](std::size_t i) {
      return solid_.masses[i] * solid_.velocities[3 * i + c];
    });
  a.speed_z = a.momentum[2] / mass_;
  a.gravity_impulse = gravity_impulse_;
  a.head_stress = probe_.head_average(solid_);
  a.head_stress_vertex = probe_.head_maximum(solid_);
  return a;
}

void DeformableVehicle::hull_motion(std::span<double> positions, std::span<double> velocities) const {
  for (std::size_t v = 0; v < hull_nodes_.size(); ++v)
    for (int a = 0; a < 3; ++a) {
      positions[3 * v + a] = solid_.positions[3 * hull_nodes_[v] + a];
      velocities[3 * v + a] = solid_.velocities[3 * hull_nodes_[v] + a];
    }
}

VehicleFields DeformableVehicle::fields() const {
  VehicleFields f;
  f.positions = solid_.positions;
  f.velocities = solid_.velocities;
  f.displacements.resize(solid_.positions.size());
  for (std::size_t i = 0; i < f.displacements.size(); ++i)
    f.displacements[i] = solid_.positions[i] - solid_.mesh.nodes[i];
  for (std::size_t e = 0; e < solid_.element_count(); ++e) {
    f.von_mises.push_back(von_mises(solid_, e));
    for (int c = 0; c < 6; ++c) f.stress.push_back(solid_.element.stress[c][e]);
  }
  return f;
}

}  // namespace polynya::structure
