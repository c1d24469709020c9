#pragma once
#include "core/continuum/explicit_solid.hpp"
#include "geometry/vehicle/vehicle_mesh.hpp"
#include "structure_solver/launch.hpp"
#include "structure_solver/stress_probe.hpp"
#include "structure_solver/vehicle_body.hpp"

namespace polynya::structure {

/// A flow that is started does not quite keep the pressure it starts with, least behind a flat base, and a body that
/// settled under that pressure would ring. So motion relative to the rigid body's is damped, critically for the gravest
/// longitudinal mode, fading until a stress wave could have run to and fro.
struct StartDamping {
  double rate = 0, until = 0;  ///< 1/s at time 0; s
  double at(double time) const { return time < until ? rate * (1 - time / until) : 0; }
};

/// A vehicle of one-point hexahedra that follows a material law; nodes on planes of symmetry slide in them.
class DeformableVehicle final : public VehicleBody {
 public:
  DeformableVehicle(const geometry::VehicleMesh& mesh, const continuum::Law& law, const Launch& launch);

  void settle(std::span<const double> hull_force) override;
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
  void list_state(compute::StateArchive& archive) override { list_members(archive); }

 private:
  POLYNYA_STATE_MEMBERS_WITHOUT((hull_nodes_, probe_), solid_, hull_nodes_, probe_, gravity_, mass_, initial_centre_z_,
                                gravity_impulse_, start_damping_, wave_time_, damped_energy_, pending_damped_energy_,
                                weight_, external_, damping_force_)
  double centre_of_mass_z() const;
  void add_start_damping();
  /// Power that the start's damping takes out, W.
  double damped_power() const;
  void add_hull_force(std::span<const double> hull_force, std::vector<double>& nodal_force) const;

  continuum::ExplicitSolid solid_;
  std::vector<std::int32_t> hull_nodes_;
  StressProbe probe_;
  double gravity_ = 0, mass_ = 0, initial_centre_z_ = 0, gravity_impulse_ = 0;
  StartDamping start_damping_;
  double wave_time_ = 0;                                   ///< s, of a stress wave along the body
  double damped_energy_ = 0, pending_damped_energy_ = 0;   ///< J; of the step that has begun
  std::vector<double> weight_, external_, damping_force_;  ///< [n][3], N; damping empty when over
};

}  // namespace polynya::structure
