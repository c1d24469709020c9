#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/compute/state_archive.hpp"
#include "core/continuum/hex_mesh.hpp"

namespace polynya::structure {

/// What the vehicle reports about itself, of the modelled part (a quarter of the body in a quarter model).
///
/// Energies and positions are those of t(n); momentum is that of v(n+1/2), which holds the impulse of every load handed
/// in so far, so that momentum and impulses balance to rounding.
struct Account {
  double kinetic = 0, internal = 0, hourglass = 0, viscous = 0;  ///< J
  double external_work = 0;  ///< J, of the loads, each times the mean of the velocities before and after it
  double gravity_work = 0;   ///< J
  double step_change = 0;    ///< J, kinetic energy re-read when the step changes, as in continuum::EnergyAccount
  std::array<double, 3> momentum{};  ///< kg m/s
  double gravity_impulse = 0;        ///< N s, along z, in momentum
  double mass = 0;                   ///< kg
  double centre_of_mass_z = 0;       ///< m
  double speed_z = 0;                ///< m/s, momentum over mass
  double head_stress = 0;            ///< Pa, von Mises, volume average behind the tip (StressProbe)
  double head_stress_vertex = 0;     ///< Pa, the largest value there

  /// Zero to rounding in every model without loss.
  double balance() const {
    return kinetic + internal + hourglass + viscous - external_work - gravity_work - step_change;
  }
};

struct AccountEntry {
  std::string_view name, unit;
};
inline constexpr std::array<AccountEntry, 16> account_entries{{{"kinetic", "J"},
                                                               {"internal", "J"},
                                                               {"hourglass", "J"},
                                                               {"viscous", "J"},
                                                               {"external_work", "J"},
                                                               {"gravity_work", "J"},
                                                               {"step_change", "J"},
                                                               {"momentum_x", "kg m/s"},
                                                               {"momentum_y", "kg m/s"},
                                                               {"momentum_z", "kg m/s"},
                                                               {"gravity_impulse_z", "N s"},
                                                               {"mass", "kg"},
                                                               {"centre_of_mass_z", "m"},
                                                               {"speed_z", "m/s"},
                                                               {"head_stress", "Pa"},
                                                               {"head_stress_vertex", "Pa"}}};

/// The account in the order of account_entries.
std::array<double, account_entries.size()> account_values(const Account& account);

/// Fields of one moment for a picture: positions and velocities of the nodes, stress of the elements (empty if rigid).
struct VehicleFields {
  std::vector<double> positions, velocities, displacements;  ///< [n][3]; displacements from the reference, m
  std::vector<double> von_mises;                             ///< [e], Pa
  std::vector<double> stress;                                ///< [e][6], xx, yy, zz, xy, yz, zx, Pa
};

/// Where a rigid body is and how it moves: centre and nose at t(n), rates of (n+1/2); in space.
struct Attitude {
  std::array<double, 3> centre{}, velocity{};  ///< m, m/s
  std::array<double, 3> nose_direction{};      ///< unit vector
  std::array<double, 3> angular_velocity{};    ///< rad/s
  std::array<double, 3> angular_momentum{};    ///< kg m^2/s, about the centre
};

/// Number of stations along the axis: 0, 20, ... 100 % of the length.
inline constexpr int station_count = 6;

/// The vehicle as the coupling sees it: an outer hull whose vertices move and carry loads.
///
/// One window:  advance_positions(dt); internal_forces(dt); finish_step(loads, dt, dt_next).
/// The start:   internal_forces(0); finish_step(loads, 0, dt), after settle(loads) if it begins under load.
class VehicleBody {
 public:
  virtual ~VehicleBody() = default;
  /// Brings the stress into equilibrium with loads that act from the start ([hull vertices][3] in N); the shape that
  /// the body has is its shape under these loads. Throws std::runtime_error if none is found.
  virtual void settle(std::span<const double> hull_force) = 0;
  /// x(n+1) = x(n) + dt v(n+1/2)
  virtual void advance_positions(double dt) = 0;
  virtual void internal_forces(double dt) = 0;
  /// v(n+3/2) from internal forces, gravity and hull_force ([hull vertices][3] in N; empty: none).
  virtual void finish_step(std::span<const double> hull_force, double dt_previous, double dt_next) = 0;
  virtual double stable_step() const = 0;  ///< s, no safety factor; 1e300 for a rigid body
  virtual Account account() const = 0;
  virtual std::array<double, station_count> station_stress() const = 0;  ///< Pa, von Mises along the axis

  virtual std::size_t hull_vertices() const = 0;
  /// Positions at t(n+1) and velocities of (n+1/2) of the hull's vertices, [hull vertices][3].
  virtual void hull_motion(std::span<double> positions, std::span<double> velocities) const = 0;
  /// Of a rigid body the mass (kg) with which all of it resists a force at a vertex of the hull; empty if it deforms.
  virtual std::vector<double> rigid_masses() const { return {}; }
  virtual VehicleFields fields() const = 0;
  /// Of a rigid body that may turn.
  virtual std::optional<Attitude> attitude() const { return std::nullopt; }

  /// What the body remembers from step to step, between steps.
  virtual void list_state(compute::StateArchive& archive) = 0;
};

}  // namespace polynya::structure
