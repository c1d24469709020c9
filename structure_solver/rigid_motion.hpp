#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <span>

namespace polynya::structure {

/// Which motions a model's symmetry allows: all; those in the plane y = 0; along z only.
enum class Freedom { full, plane, axial };

/// A rigid body in a leapfrog: centre and orientation at t(n), velocity and angular momentum at t(n+1/2).
struct RigidMotion {
  Freedom freedom = Freedom::full;
  double mass = 0;                                             ///< kg
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Identity();       ///< kg m^2, about the centre, in the body's frame
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();            ///< m
  Eigen::Matrix3d orientation = Eigen::Matrix3d::Identity();   ///< body frame to space
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();          ///< m/s
  Eigen::Vector3d angular_momentum = Eigen::Vector3d::Zero();  ///< kg m^2/s, in space
  double kinetic_energy = 0;                                   ///< J at t(n), see push()
  double step_change = 0;                                      ///< J, sum of what push() re-read
};

/// The body at rest that these points make: nodes [n][3] in m, masses [n] in kg.
RigidMotion body_of_points(std::span<const double> nodes, std::span<const double> masses);

/// A mass (kg) at a place (m) in space.
struct PointMass {
  double mass = 0;
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
};
/// Fixes a mass to a body at rest in its reference orientation: mass, centre and inertia are those of both together.
void add_point_mass(RigidMotion& body, const PointMass& point);

/// Moves centre and orientation by one step. The orientation turns by the angular velocity that belongs to the mean of
/// the body-frame angular momenta before and after: angular momentum and, without torque, energy are kept to rounding.
void advance(RigidMotion& body, double dt);

/// Angular velocity in space at the present orientation, rad/s.
Eigen::Vector3d angular_velocity(const RigidMotion& body);

/// The least mass (kg) with which the body resists a force at `arm` (m from the centre, body frame), whatever the direction: one
/// over the largest eigenvalue of 1/m + [arm]^T I^-1 [arm] (operational-space inertia, Khatib 1987).
double resistance(const RigidMotion& body, const Eigen::Vector3d& arm);

/// v += (dt_previous + dt_next)/2 F/m, likewise the angular momentum; components that the symmetry forbids are dropped.
/// The kinetic energy is 1/2 m v(n)^2 less dt_next^2/8 m a^2 (and the same for the rotation), whose change in a step of
/// constant length is exactly the work of the forces; when the length changes the second term is re-read and booked.
void push(RigidMotion& body, Eigen::Vector3d force, Eigen::Vector3d torque, double dt_previous, double dt_next);

}  // namespace polynya::structure
