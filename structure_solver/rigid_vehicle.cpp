#include "structure_solver/rigid_vehicle.hpp"

#include <utility>

#include "structure_solver/torque_free.hpp"

namespace polynya::structure {
namespace {

Freedom freedom_of(geometry::Portion portion) {
  switch (portion) {
    case geometry::Portion::full:
      return Freedom::full;
    case geometry::Portion::half:
      return Freedom::plane;
    case geometry::Portion::quarter:
      break;
  }
  return Freedom::axial;
}

Eigen::Vector3d node(const std::vector<double>& coordinates, std::size_t i) {
  return {coordinates[3 * i], coordinates[3 * i + 1], coordinates[3 * i + 2]};
}

}  // namespace

RigidVehicle::RigidVehicle(std::vector<double> nodes, std::span<const std::int32_t> hull_nodes,
                           const RigidMotion& at_rest, geometry::Portion portion, const Launch& launch)
    : motion_(at_rest), gravity_(launch.gravity), reference_(std::move(nodes)), axis_(launch.axis()) {
  motion_.freedom = freedom_of(portion);
  for (std::size_t i = 0; 3 * i < reference_.size(); ++i) arms_.push_back(node(reference_, i) - motion_.centre);
  motion_.velocity = launch.velocity();
  initial_centre_z_ = motion_.centre.z();
  for (const std::int32_t i : hull_nodes) hull_arms_.push_back(arms_[i]);
  hull_.resize(hull_arms_.size());
  last_force_.assign(hull_arms_.size(), Eigen::Vector3d::Zero());
  place_hull();
  set_spin(launch.angular_velocity());
}

void RigidVehicle::set_spin(const Eigen::Vector3d& angular_velocity) {
  motion_.angular_momentum = motion_.orientation * motion_.inertia * motion_.orientation.transpose() * angular_velocity;
  turn_rate_ = (Eigen::Matrix3d() << 0, -angular_velocity.z(), angular_velocity.y(), angular_velocity.z(), 0,
                -angular_velocity.x(), -angular_velocity.y(), angular_velocity.x(), 0)
                   .finished() *
               motion_.orientation;
  push(motion_, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), 0, 0);
}

void RigidVehicle::place_hull() {
  for (std::size_t v = 0; v < hull_.size(); ++v) hull_[v] = motion_.centre + motion_.orientation * hull_arms_[v];
}

std::vector<double> RigidVehicle::rigid_masses() const {
  std::vector<double> masses;
  for (const Eigen::Vector3d& arm : hull_arms_) masses.push_back(resistance(motion_, arm));
  return masses;
}

void RigidVehicle::advance_positions(double dt) {
  const Eigen::Matrix3d before = motion_.orientation;
  if (loaded_ || motion_.freedom != Freedom::full)
    advance(motion_, dt);
  else
    advance_torque_free(motion_, dt);
  // Velocities of the hull are the ones that lead from the position before to the present one.
  turn_rate_ = (motion_.orientation - before) / dt;
  place_hull();
}

void RigidVehicle::finish_step(std::span<const double> hull_force, double dt_previous, double dt_next) {
  Eigen::Vector3d force(0, 0, -motion_.mass * gravity_), torque = Eigen::Vector3d::Zero();
  loaded_ = false;
  for (std::size_t v = 0; v < hull_.size(); ++v) {
    const Eigen::Vector3d f = hull_force.empty()
                                  ? Eigen::Vector3d(0, 0, 0)
                                  : Eigen::Vector3d(hull_force[3 * v], hull_force[3 * v + 1], hull_force[3 * v + 2]);
    force += f;
    loaded_ |= !f.isZero(0);
    torque += (hull_[v] - motion_.centre).cross(f);
    work_ += 0.5 * dt_previous * (last_force_[v] + f).dot(hull_velocity(v));
    last_force_[v] = f;
  }
  gravity_impulse_ -= 0.5 * (dt_previous + dt_next) * motion_.mass * gravity_;
  push(motion_, force, torque, dt_previous, dt_next);
}

Account RigidVehicle::account() const {
  Account a;
  a.kinetic = motion_.kinetic_energy;
  a.step_change = motion_.step_change;
  a.external_work = work_;
  a.mass = motion_.mass;
  a.centre_of_mass_z = motion_.centre.z();
  a.gravity_work = -motion_.mass * gravity_ * (a.centre_of_mass_z - initial_centre_z_);
  for (int c = 0; c < 3; ++c) a.momentum[c] = motion_.mass * motion_.velocity[c];
  a.speed_z = motion_.velocity.z();
  a.gravity_impulse = gravity_impulse_;
  return a;
}

void RigidVehicle::hull_motion(std::span<double> positions, std::span<double> velocities) const {
  for (std::size_t v = 0; v < hull_.size(); ++v) {
    const Eigen::Vector3d velocity = hull_velocity(v);
    for (int c = 0; c < 3; ++c) {
      positions[3 * v + c] = hull_[v][c];
      velocities[3 * v + c] = velocity[c];
    }
  }
}

VehicleFields RigidVehicle::fields() const {
  VehicleFields f;
  const Eigen::Vector3d spin = motion_.freedom == Freedom::axial ? Eigen::Vector3d(0, 0, 0) : angular_velocity(motion_);
  for (std::size_t i = 0; i < arms_.size(); ++i) {
    const Eigen::Vector3d arm = motion_.orientation * arms_[i];
    const Eigen::Vector3d position = motion_.centre + arm, velocity = motion_.velocity + spin.cross(arm);
    for (int c = 0; c < 3; ++c) {
      f.positions.push_back(position[c]);
      f.velocities.push_back(velocity[c]);
      f.displacements.push_back(position[c] - reference_[3 * i + c]);
    }
  }
  return f;
}

std::optional<Attitude> RigidVehicle::attitude() const {
  if (motion_.freedom == Freedom::axial) return std::nullopt;
  const auto three = [](const Eigen::Vector3d& v) { return std::array<double, 3>{v.x(), v.y(), v.z()}; };
  return Attitude{three(motion_.centre), three(motion_.velocity), three(motion_.orientation * axis_),
                  three(angular_velocity(motion_)), three(motion_.angular_momentum)};
}

void RigidVehicle::list_state(compute::StateArchive& archive) {
  // All members, so that a new one does not compile until it is looked at here; the rest is the mesh's.
  [[maybe_unused]] auto& [motion, gravity, initial_centre_z, work, gravity_impulse, reference, arms, hull_arms, hull,
                          last_force, axis, loaded, turn_rate] = *this;
  [[maybe_unused]] auto& [freedom, mass, inertia, centre, orientation, velocity, angular_momentum, kinetic_energy,
                          step_change] = motion;
  const auto numbers = [&](const char* name, auto& matrix) {
    archive.values(name, matrix.data(), static_cast<std::size_t>(matrix.size()));
  };
  const auto points = [&](const std::string& name, Points& all) {
    std::uint64_t count = all.size();
    archive.item(name + ".count", count);
    all.resize(count);
    static_assert(sizeof(Eigen::Vector3d) == 3 * sizeof(double));
    archive.values(name, all.empty() ? nullptr : all.front().data(), 3 * all.size());
  };
  numbers("centre", centre), numbers("orientation", orientation), numbers("velocity", velocity);
  numbers("angular_momentum", angular_momentum), numbers("turn_rate", turn_rate);
  archive.item("kinetic_energy", kinetic_energy), archive.item("step_change", step_change);
  archive.item("work", work), archive.item("gravity_impulse", gravity_impulse);
  archive.item("loaded", loaded);
  points("hull", hull), points("last_force", last_force);
}

}  // namespace polynya::structure
