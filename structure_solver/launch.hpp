#pragma once
#include <Eigen/Core>
#include <span>
#include <vector>

namespace polynya::structure {

/// What a vehicle starts with.
struct Launch {
  double speed = 0;                   ///< m/s, along its axis, nose first
  double gravity = 0;                 ///< m/s^2, downward
  double nose_position = 0;           ///< m, z of the nose
  double length = 0;                  ///< m
  double element_size = 0;            ///< m
  double angle = 0;                   ///< rad, of the axis from the vertical towards +x
  double offset_x = 0, offset_y = 0;  ///< m, of the nose
  double spin = 0;                    ///< rad/s, about the axis, right-handed about the direction of the nose
  double pitch_rate = 0;              ///< rad/s, about +y: of the nose towards +x

  Eigen::Vector3d nose() const { return {offset_x, offset_y, nose_position}; }
  /// Direction of the nose.
  Eigen::Vector3d axis() const;
  Eigen::Vector3d velocity() const { return speed * axis(); }
  Eigen::Vector3d angular_velocity() const { return spin * axis() + Eigen::Vector3d(0, pitch_rate, 0); }
  /// Turns points [n][3] of the upright vehicle, whose nose is at (0, 0, nose_position), about its nose and shifts
  /// them. Nothing moves, to the last bit, where neither angle nor offset is given.
  void place(std::span<double> points) const;
};

}  // namespace polynya::structure
