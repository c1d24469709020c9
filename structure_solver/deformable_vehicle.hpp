#pragma once
#include "core/continuum/explicit_solid.hpp"
#include "geometry/vehicle/vehicle_mesh.hpp"
#include "structure_solver/stress_probe.hpp"
#include "structure_solver/vehicle_body.hpp"

namespace polynya::structure {

/// What a vehicle starts with.
struct Launch {
  double speed = 0;          ///< m/s, upward
  double gravity = 0;        ///< m/s^2, downward
  double nose_position = 0;  ///< m
  double length = 0;         ///< m
  double element_size = 0;   ///< m
};

/// An elastic vehicle of one-point hexahedra; nodes on planes of symmetry slide in them.
class DeformableVehicle final : public VehicleBody {
 public:
  DeformableVehicle(const geometry::VehicleMesh& mesh, const continuum::Elastic& law, const Launch& launch);

  void advance_positions(double dt) override;
  void internal_forces(double dt) override;
  void finish_step(std::span<const double> hull_force, double dt_previous, double dt_next) override;
  double stable_step() const override;
  Account account() const override;
  std::array<double, station_count> station_stress() const override { return probe_.stations(solid_); }
  std::size_t hull_vertices() const override { return hull_nodes_.size(); }
  void hull_motion(std::span<double> positions, std::span<double> velocities) const override;
  VehicleFields fields() const override;

  const continuum::ExplicitSolid& solid() const { return solid_; }

 private:
  double centre_of_mass_z() const;

  continuum::ExplicitSolid solid_;
  std::vector<std::int32_t> hull_nodes_;
  StressProbe probe_;
  double gravity_ = 0, mass_ = 0, initial_centre_z_ = 0, gravity_impulse_ = 0;
  std::vector<double> weight_, external_;  ///< [n][3], N
};

}  // namespace polynya::structure
