#pragma once
#include "geometry/vehicle/vehicle_mesh.hpp"
#include "structure_solver/deformable_vehicle.hpp"
#include "structure_solver/rigid_motion.hpp"
#include "structure_solver/vehicle_body.hpp"

namespace polynya::structure {

/// A vehicle that does not deform. While something touches it a step keeps angular momentum and energy (advance());
/// without loads ARKODE turns it (advance_torque_free()).
class RigidVehicle final : public VehicleBody {
 public:
  /// nodes: [n][3], m, placed as the launch says, and which of them are the hull's. at_rest: mass, centre and inertia
  /// of the body in that place. Portion full: six degrees of freedom; half: x, z and turning about y; quarter: z.
  RigidVehicle(std::vector<double> nodes, std::span<const std::int32_t> hull_nodes, const RigidMotion& at_rest,
               geometry::Portion portion, const Launch& launch);

  void settle(std::span<const double>) override {}
  void advance_positions(double dt) override;
  void internal_forces(double) override {}
  void finish_step(std::span<const double> hull_force, double dt_previous, double dt_next) override;
  double stable_step() const override { return 1e300; }
  Account account() const override;
  std::array<double, station_count> station_stress() const override { return {}; }
  std::size_t hull_vertices() const override { return hull_arms_.size(); }
  void hull_motion(std::span<double> positions, std::span<double> velocities) const override;
  std::vector<double> rigid_masses() const override;
  VehicleFields fields() const override;
  std::optional<Attitude> attitude() const override;

  void list_state(compute::StateArchive& archive) override;

  const RigidMotion& motion() const { return motion_; }
  void set_spin(const Eigen::Vector3d& angular_velocity);  ///< rad/s in space; before the first step

 private:
  using Points = std::vector<Eigen::Vector3d>;
  void place_hull();
  Eigen::Vector3d hull_velocity(std::size_t v) const { return motion_.velocity + turn_rate_ * hull_arms_[v]; }

  RigidMotion motion_;
  double gravity_ = 0, initial_centre_z_ = 0, work_ = 0, gravity_impulse_ = 0;
  std::vector<double> reference_;                        ///< [n][3], m
  Points arms_, hull_arms_;                              ///< from the centre, body frame, m
  Points hull_;                                          ///< m, at t(n)
  Points last_force_;                                    ///< N, of t(n-1)
  Eigen::Vector3d axis_;                                 ///< direction of the nose in the reference orientation
  bool loaded_ = false;                                  ///< by the last loads
  Eigen::Matrix3d turn_rate_ = Eigen::Matrix3d::Zero();  ///< 1/s, change of the orientation in the last step over dt
};

}  // namespace polynya::structure
