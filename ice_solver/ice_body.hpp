#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/compute/timer.hpp"
#include "core/continuum/equilibrium.hpp"
#include "core/continuum/explicit_solid.hpp"
#include "ice_solver/background.hpp"
#include "ice_solver/neighbour_list.hpp"
#include "ice_solver/own_contact.hpp"
#include "ice_solver/pair_sums.hpp"
#include "ice_solver/particles.hpp"
#include "ice_solver/plate.hpp"
#include "ice_solver/set_loads.hpp"

/// The ice: hexahedra that become particles, moved in step. One step from t(n) to t(n+1):
///     advance_positions(ice, dt);                 x(n+1), from v(n+1/2)
///     internal_forces(ice, dt);                   stresses, nodal, pair forces at x(n+1)
///     advance_velocities(ice, loads, dt, next);   v(n+3/2); account
///     convert_failed_elements(ice);               elements past the critical strain become particles
/// A start: internal_forces(ice, 0); advance_velocities(ice, {}, 0, dt).
namespace polynya::ice {

/// What a failed element becomes: an SPH particle; a mass that feels loads only; nothing.
enum class Debris { particles, free_masses, none };

/// A ball in place of the plate: its lowest point at `lowest`, moving down.
struct BallOptions {
  double radius = 0, element = 0, lowest = 0;  ///< m
  double speed = 0;                            ///< m/s
};

struct IceOptions {
  std::vector<double> x, y, z;  ///< m, grid lines of the modelled part
  continuum::Law law;
  continuum::Numerics numerics;
  SymmetryPlanes planes;
  Sides sides = Sides::free;
  double damping = 0;                      ///< 1/s, of all motion: force over mass and velocity
  double held_rim = 0;                     ///< m, width of the rim of the upper face that is held
  std::optional<BallOptions> ball;         ///< then the grid lines mean nothing
  std::optional<continuum::HexMesh> mesh;  ///< likewise; it lies where its nodes say, on planes of symmetry exactly
  std::vector<Support> supports;           ///< of nodes of that mesh
  std::vector<SetLoad> loads;              ///< on nodes of that mesh
  double velocity = 0;                     ///< m/s, of that mesh at the start, along z; held components keep it
  bool conversion = true;
  Debris debris = Debris::particles;
  double critical_strain = 0.35;
  double collapsed_step =
      0.1;             ///< an element is also converted when its stable step falls below this part of its first
  double flaws = 0;                ///< largest damage that elements start with
  std::uint64_t seed = 1;          ///< of that
  double gravity = 0;  ///< m/s^2, along -z
  continuum::EquilibriumMethod equilibrium = continuum::EquilibriumMethod::automatic;  ///< of settle
  double sleeping_threshold = 0;                                                       ///< continuum::Sleeping
  /// Particles meet intact ice that they are not bonded to by contact, not through the sums; surfaces meet by contact.
  bool own_contact = false;
  double contact_friction = 0, contact_stiffness_factor = 0.1;
  double viscosity_linear = 0.1, viscosity_quadratic = 2.0;  ///< of the particles: Monaghan's alpha and beta
};

/// Time integral of a rate that is known at the ends of steps, by the trapezoidal rule: each value closes half a step
/// and opens half of the next one.
struct Trapezoid {
  double total = 0, pending = 0;
  void add(double closing, double opening) {
    total += pending + closing;
    pending = opening;
  }
};

/// Why elements were converted.
struct ConversionCount {
  std::int64_t strained = 0;   ///< effective strain above the critical one
  std::int64_t collapsed = 0;  ///< inverted or with a collapsed step
};

/// What the body has exchanged and lost beyond what continuum::EnergyAccount knows. J, N s, N m s.
struct IceBooks {
  double conversion_heat = 0;                       ///< relative motion within elements that became one particle
  std::array<double, 3> angular_momentum_defect{};  ///< angular momentum lost by the same
  double broken_mass = 0;                           ///< kg
  double lost_kinetic = 0;                          ///< of elements that became nothing
  double lost_mass = 0;                             ///< kg, likewise
  ConversionCount converted;
  double particle_kinetic = 0;
  double removed_since_step = 0;  ///< kinetic energy of elements converted after the last step
  Trapezoid particle_step_change;
  double prescribed_work = 0;  ///< kinetic energy given to nodes whose velocity is set from outside
  Trapezoid particle_heat;     ///< taken from the motion by the artificial viscosity
  Trapezoid node_pair_work, node_gravity_work, particle_gravity_work, particle_load_work;
  Trapezoid set_load_work;
  std::array<double, 3> boundary_impulse{};  ///< of symmetry planes, held and damped nodes, loads on sets, until t(n+1/2)
  double gravity_impulse = 0;                ///< along z, until t(n+1/2)
  std::array<double, 3> momentum{};          ///< at t(n+1/2)
};

struct IceBody {
  IceOptions options;
  continuum::ExplicitSolid solid;
  continuum::FaceNeighbours face_neighbours;
  std::vector<double> first_step;  ///< [e], s, stable step of each element at the start
  Particles particles;
  Background background;
  NeighbourList list;
  PairSums sums;
  OwnContact own_contact;
  SetLoads set_loads;
  bool list_is_stale = true;
  int steps_since_build = 0;
  std::vector<double> pair_force, nodal_force;  ///< [nodes][3], N
  IceBooks books;
  bool topology_changed = false;  ///< by the last convert_failed_elements
  compute::Stopwatch watch;

  /// Between steps; the rest is made from the options.
  POLYNYA_STATE_WITHOUT((options, face_neighbours, first_step, sums, set_loads, watch), options, solid, face_neighbours,
                        first_step, particles, background, list, sums, own_contact, set_loads, list_is_stale, steps_since_build,
                        pair_force, nodal_force, books, topology_changed, watch)
};

/// The ice at rest. Throws std::invalid_argument on bad grid lines, or a bad element of a mesh.
IceBody make_ice(const IceOptions& options);

/// Gives the plate the stress that balances loads on its nodes ([n][3], N) and its weight, but for the rigid
/// acceleration they cause; its present shape is the loaded one. Before the first step. Throws std::runtime_error
/// where forces do not come to balance.
continuum::EquilibriumReport settle(IceBody& ice, std::span<const double> node_loads);

void advance_positions(IceBody& ice, double dt);
void internal_forces(IceBody& ice, double dt);
/// node_loads: [nodes][3], particle_loads: [particles][3], N; either may be empty.
void advance_velocities(IceBody& ice, std::span<const double> node_loads, std::span<const double> particle_loads,
                        double dt_previous, double dt_next);
/// Returns how many elements became particles.
std::size_t convert_failed_elements(IceBody& ice);
/// Turns the given living elements into particles: mass, momentum, stress, damage and density are kept, kinetic energy
/// of relative motion becomes heat.
void convert_elements(IceBody& ice, std::span<const std::int32_t> elements);

/// The smaller of the elements' and the particles' stable steps, s, without a safety factor.
double stable_step(const IceBody& ice);

}  // namespace polynya::ice
