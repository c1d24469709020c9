#include "structure_solver/rigid_motion.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace polynya::structure {
namespace {

Eigen::Matrix3d turn(const Eigen::Vector3d& angle) {
  const double size = angle.norm();
  if (size == 0) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(size, angle / size).toRotationMatrix();
}

Eigen::Vector3d body_angular_velocity(const RigidMotion& body, const Eigen::Vector3d& body_momentum) {
  if (body.freedom == Freedom::plane) return {0, body_momentum.y() / body.inertia(1, 1), 0};
  return body.inertia.inverse() * body_momentum;
}

Eigen::Vector3d point(std::span<const double> nodes, std::size_t i) {
  return {nodes[3 * i], nodes[3 * i + 1], nodes[3 * i + 2]};
}

}  // namespace

RigidMotion body_of_points(std::span<const double> nodes, std::span<const double> masses) {
  RigidMotion body;
  for (std::size_t i = 0; i < masses.size(); ++i) {
    body.mass += masses[i];
    body.centre += masses[i] * point(nodes, i);
  }
  body.centre /= body.mass;
  body.inertia.setZero();
  for (std::size_t i = 0; i < masses.size(); ++i) {
    const Eigen::Vector3d r = point(nodes, i) - body.centre;
    body.inertia += masses[i] * (r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose());
  }
  return body;
}

void add_point_mass(RigidMotion& body, const PointMass& point) {
  const double total = body.mass + point.mass;
  const Eigen::Vector3d arm = point.place - body.centre;
  const double reduced = body.mass * point.mass / total;
  body.inertia += reduced * (arm.squaredNorm() * Eigen::Matrix3d::Identity() - arm * arm.transpose());
  body.centre += point.mass / total * arm;
  body.mass = total;
}

void advance(RigidMotion& body, double dt) {
  body.centre += dt * body.velocity;
  if (body.freedom == Freedom::axial) return;
  const Eigen::Vector3d before = body.orientation.transpose() * body.angular_momentum;
  Eigen::Vector3d rate = body_angular_velocity(body, before);
  // The iteration contracts by about dt times the rate; a handful of sweeps reach rounding for any sensible step.
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector3d after = turn(-dt * rate) * before;
    const Eigen::Vector3d next = body_angular_velocity(body, 0.5 * (before + after));
    const bool settled = (next - rate).norm() <= 1e-16 * next.norm();
    rate = next;
    if (settled) break;
  }
  body.orientation = Eigen::Quaterniond(body.orientation * turn(dt * rate)).normalized().toRotationMatrix();
}

Eigen::Vector3d angular_velocity(const RigidMotion& body) {
  return body.orientation * body_angular_velocity(body, body.orientation.transpose() * body.angular_momentum);
}

double resistance(const RigidMotion& body, const Eigen::Vector3d& arm) {
  if (body.freedom == Freedom::axial) return body.mass;
  if (body.freedom == Freedom::plane)
    return 1 / (1 / body.mass + (arm.x() * arm.x() + arm.z() * arm.z()) / body.inertia(1, 1));
  Eigen::Matrix3d cross;
  cross << 0, -arm.z(), arm.y(), arm.z(), 0, -arm.x(), -arm.y(), arm.x(), 0;
  const Eigen::Matrix3d yielding =
      Eigen::Matrix3d::Identity() / body.mass + cross.transpose() * body.inertia.inverse() * cross;
  return 1 / Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(yielding, Eigen::EigenvaluesOnly).eigenvalues()[2];
}

void push(RigidMotion& body, Eigen::Vector3d force, Eigen::Vector3d torque, double dt_previous, double dt_next) {
  if (body.freedom != Freedom::full) {
    force.y() = 0;
    torque.x() = torque.z() = 0;
  }
  if (body.freedom == Freedom::axial) {
    force.x() = 0;
    torque.setZero();
  }
  const auto spin_energy = [&](const Eigen::Vector3d& momentum) {
    const Eigen::Vector3d in_body = body.orientation.transpose() * momentum;
    return 0.5 * in_body.dot(body_angular_velocity(body, in_body));
  };
  const Eigen::Vector3d velocity = body.velocity + 0.5 * dt_previous / body.mass * force;
  const Eigen::Vector3d momentum = body.angular_momentum + 0.5 * dt_previous * torque;
  const double rate = 0.5 * force.squaredNorm() / body.mass + spin_energy(torque);
  body.step_change += 0.25 * (dt_previous * dt_previous - dt_next * dt_next) * rate;
  body.kinetic_energy =
      0.5 * body.mass * velocity.squaredNorm() + spin_energy(momentum) - 0.25 * dt_next * dt_next * rate;
  body.velocity += 0.5 * (dt_previous + dt_next) / body.mass * force;
  body.angular_momentum += 0.5 * (dt_previous + dt_next) * torque;
}

}  // namespace polynya::structure
