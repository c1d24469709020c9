#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/continuum/element_chunks.hpp"
#include "core/continuum/hex_mesh.hpp"
#include "core/continuum/law.hpp"
#include "core/continuum/material_point.hpp"
#include "core/continuum/nodal_lanes.hpp"
#include "core/continuum/sleeping.hpp"
#include "core/continuum/surface.hpp"

/// A body of hexahedra, with one point or with eight, moved by central differences: state and the steps that change it.
///
/// One step from t(n) to t(n+1), with dt the step:
///     advance_positions(solid, dt);                       x(n+1) = x(n) + dt v(n+1/2)
///     internal_forces(solid, dt);                         stress and nodal internal force at x(n+1)
///     advance_velocities(solid, external, dt, dt_next);   v(n+3/2) = v(n+1/2) + (dt + dt_next)/2 a(n+1)
/// A start with forces at t(0): internal_forces(solid, 0), advance_velocities(solid, external, 0, dt).
namespace polynya::continuum {

/// Points of a hexahedron at which the law is asked: one, with forces against hourglass modes (hourglass.hpp); or
/// eight, without such forces (full_hexahedron.hpp): some six times the work, for comparison.
enum class Integration { one_point, full };

/// Where the law is asked, and dimensionless coefficients of what is added to its stress.
struct Numerics {
  double quadratic_viscosity = 1.5;  ///< bulk viscosity, only in compression
  double linear_viscosity = 0.06;
  double hourglass_stiffness = 1;     ///< of what an element's bending means (hourglass.hpp)
  double hourglass_viscosity = 0.05;  ///< decay rate of an hourglass mode in units of wave speed / length
  double hourglass_floor = 0.01;      ///< the part of it that the cap leaves to laws that do not see the modes
  double hourglass_flowed = 0.3;      ///< the part of the stiffness that plastic flow leaves
  Integration integration = Integration::one_point;
};

/// Per element; every array is padded to whole packs, padding elements are dead. With full integration stress, damage,
/// plastic strain and bulking pressure are the plain means over the element's points.
struct ElementState {
  std::array<std::vector<double>, 6> stress;  ///< Pa, Cauchy at t(n): xx, yy, zz, xy, yz, zx; positive in tension
  std::vector<double> volume;                 ///< m^3
  std::vector<double> reference_volume;       ///< m^3
  std::vector<double> mass;                   ///< kg, density x reference volume
  std::vector<double> damage;                 ///< 0..1
  std::vector<double> plastic_strain;
  std::vector<double> bulking_pressure;  ///< Pa
  std::vector<double> step_limit;        ///< s, stable step of the element alone
  std::vector<double> alive;             ///< 1 living, 0 removed

  POLYNYA_STATE(stress, volume, reference_volume, mass, damage, plastic_strain, bulking_pressure, step_limit, alive)
};

/// One point of every element with full integration, padded like ElementState.
struct PointArrays {
  std::array<std::vector<double>, 6> stress;  ///< Pa, like ElementState's
  std::vector<double> damage;                 ///< 0..1
  std::vector<double> plastic_strain;
  std::vector<double> bulking_pressure;  ///< Pa

  POLYNYA_STATE(stress, damage, plastic_strain, bulking_pressure)
};

/// Traction -rho c_p v_n A - rho c_s v_t A on the nodes of a boundary that waves should leave through.
struct DampedNodes {
  std::vector<std::int32_t> nodes;
  std::vector<double> damping;       ///< [k][6], symmetric matrix, N s/m
  std::vector<double> static_force;  ///< [k][3], N, what the medium beyond exerts at rest

  POLYNYA_STATE(nodes, damping, static_force)
};

/// Energies since the start, J. Conserved to round-off: balance() stays at its value of the start.
struct EnergyAccount {
  double kinetic = 0;   ///< of v(n-1/2) and v(n+1/2): 1/2 m |v(n)|^2 less its error of second order
  double internal = 0;  ///< work of the law's stress
  double hourglass = 0;
  double viscous = 0;        ///< bulk viscosity
  double external_work = 0;  ///< done on the body by external forces and by whatever holds fixed components
  double support_work = 0;   ///< the latter part of it: not 0 where held components move
  double boundary_flux = 0;  ///< left through non-reflecting boundaries
  double removed = 0;        ///< kinetic energy taken off with removed elements
  double step_change = 0;    ///< kinetic energy re-read when the step changes: (dt_old^2 - dt_new^2)/8 m a^2
  double balance() const {
    return kinetic + internal + hourglass + viscous + boundary_flux + removed - external_work - step_change;
  }
};

struct ExplicitSolid {
  std::string name;  ///< for messages
  HexMesh mesh;      ///< reference configuration
  Law law;
  Numerics numerics;
  double time = 0;  ///< s, t(n) of positions

  // Nodes.
  std::vector<double> positions;              ///< [n][3], m, at t(n)
  std::vector<double> velocities;             ///< [n][3], m/s, at t(n+1/2)
  std::vector<double> internal_force;         ///< [n][3], N, force of the elements ON the nodes; advance_velocities
                                              ///< adds the traction of non-reflecting boundaries to it
  std::vector<double> masses;                 ///< [n], kg; 0 once every element of the node is removed
  std::vector<std::uint8_t> fixed;            ///< [n], bit 0, 1, 2: the velocity component x, y, z is held as it is
  std::vector<std::uint8_t> living_elements;  ///< [n], number of living elements at the node

  ElementState element;
  std::vector<PointArrays> points;  ///< [8] with full integration, else none
  DampedNodes damped;
  Sleeping sleeping;
  double step_limit = 0;  ///< s, of the last internal_forces

  // Bookkeeping of the energy account: see advance_velocities. internal_work: against the forces of the elements, all
  // of them; hourglass_energy and viscous_energy are parts of it. Pending: half a step begun with the velocities of
  // advance_velocities; whoever sets another velocity after it corrects internal and external work by the difference.
  double kinetic_energy = 0, internal_work = 0, hourglass_energy = 0, viscous_energy = 0, external_work = 0,
         support_work = 0, boundary_flux = 0, removed_energy = 0, step_change = 0;
  double pending_internal_work = 0, pending_external_work = 0, pending_support_work = 0, pending_boundary_flux = 0,
         pending_step_change = 0;

  // Internal to the kernels. Lanes are elements of one pack, W = compute::pack_width.
  std::vector<std::int32_t> connectivity;  ///< [pack][8][W], 3 x node index; padding lanes repeat element 0
  std::vector<double> natural_hourglass;   ///< [pack][12][W], hourglass shape of the reference element
  std::vector<std::uint8_t> irregular;     ///< [pack], 1 if any lane is not a parallelepiped in the reference
  std::array<std::vector<double>, 3> hourglass_stiffness;  ///< [e], N/m, of the modes 4, 5, 6, undamaged
  std::vector<double> exposure;                            ///< [e], 0 (amid others) to 1 (alone): see element_step
  std::vector<std::uint8_t> idle;                          ///< [pack], 1 if every lane is dead
  std::vector<std::uint8_t> complete;                      ///< [pack], 1 if every lane lives, 2 if amid others
  ElementChunks chunks;                                    ///< how the elements are worked through
  std::vector<NodeRecord> force_shares;                    ///< N, of the elements of one chunk on a node that it shares
  std::vector<double> chunk_step_limit;                    ///< [chunk], s, smallest stable step of its elements

  std::size_t node_count() const { return masses.size(); }
  std::size_t element_count() const { return mesh.element_count(); }

  POLYNYA_STATE_WITHOUT((name, law, numerics, connectivity, chunks), name, mesh, law, numerics, time, positions,
                        velocities, internal_force, masses, fixed, living_elements, element, points, damped, sleeping,
                        step_limit, kinetic_energy, internal_work, hourglass_energy, viscous_energy, external_work,
                        support_work, boundary_flux, removed_energy, step_change, pending_internal_work,
                        pending_external_work, pending_support_work, pending_boundary_flux, pending_step_change, connectivity, natural_hourglass, irregular,
                        hourglass_stiffness, exposure, idle, complete, chunks, force_shares, chunk_step_limit)
};

/// A body at rest in its reference configuration. Throws std::invalid_argument naming the first element whose volume is
/// not positive.
ExplicitSolid make_solid(std::string name, HexMesh mesh, Law law, Numerics numerics = {});

/// Takes mesh.nodes for the shape without stress (reference volumes, hourglass shapes) and lays the body down in it, at
/// rest; masses stay. Throws std::invalid_argument like make_solid.
void lay_down_unloaded(ExplicitSolid& solid);

/// x += dt v, time += dt.
void advance_positions(ExplicitSolid& solid, double dt);

/// Stresses and nodal internal forces at the present positions, reached with the present velocities in dt; element
/// energies; step limit. Throws BadElement if a living element is inverted or its stress is not finite.
void internal_forces(ExplicitSolid& solid, double dt);

/// The same with plain doubles instead of packs; the independent code path of tests.
void internal_forces_scalar(ExplicitSolid& solid, double dt);

/// v += (dt_previous + dt_next)/2 a with a from internal, external ([n][3], N) and boundary forces; keeps the account.
void advance_velocities(ExplicitSolid& solid, std::span<const double> external_force, double dt_previous,
                        double dt_next);

/// Largest step that every living element bears, s (no safety factor; 1e300 if none lives).
double stable_step(const ExplicitSolid& solid);

/// Energies at t(n), after advance_velocities.
EnergyAccount energies(const ExplicitSolid& solid);

/// What leaves with an element: its eighth of the mass at each of its nodes.
struct RemovedElement {
  double mass = 0;                   ///< kg
  std::array<double, 3> momentum{};  ///< kg m/s, of v(n+1/2)
  double kinetic_energy = 0;         ///< J, of v(n+1/2); exactly what the account books as `removed`
};

/// Takes a living element and its mass out. Call between advance_velocities and advance_positions. Its stress and
/// damage stay readable; its last half step of work is booked by the next advance_velocities.
RemovedElement remove_element(ExplicitSolid& solid, std::size_t element);

/// Adds the nodes of a plane boundary (living elements' faces on it) to the damped nodes. Fix components first.
void add_non_reflecting_boundary(ExplicitSolid& solid, const Plane& plane);
/// The same for the free faces, plane or not, whose four nodes are all among `nodes`; each has its own normal.
void add_non_reflecting_boundary(ExplicitSolid& solid, std::span<const std::int32_t> nodes);
/// Damps all nodes by a force `rate` (1/s) x mass x velocity against it. Its work is booked with what leaves through
/// non-reflecting boundaries. Fix components first.
void add_mass_damping(ExplicitSolid& solid, double rate);
/// Makes the damped boundary carry what is needed for equilibrium under the present internal and external forces: at
/// each of its nodes, and along axes that no support holds for the body as a whole. Dashpots alone hold nothing: a
/// force F that they do not carry at rest makes the body creep at F / (rho c A).
void hold_boundary_at_rest(ExplicitSolid& solid, std::span<const double> external_force);

// One element, for conversion, output and tests.
std::array<double, 3> element_centre(const ExplicitSolid& solid, std::size_t element);    ///< m
std::array<double, 3> element_velocity(const ExplicitSolid& solid, std::size_t element);  ///< m/s, mean of nodes
Tensor<double> velocity_gradient(const ExplicitSolid& solid, std::size_t element);        ///< 1/s
Tensor<double> deformation_gradient(const ExplicitSolid& solid, std::size_t element);     ///< at the centre
PointState<double> point_state(const ExplicitSolid& solid, std::size_t element);          ///< mean over its points
/// Of all points of the element; not the volume.
void set_point_state(ExplicitSolid& solid, std::size_t element, const PointState<double>& state);
/// Shortest distance between opposite faces, m (a lower bound for skewed elements).
double characteristic_length(const ExplicitSolid& solid, std::size_t element);

/// sqrt(2/3 e:e), e the deviatoric total logarithmic strain between reference and present positions.
double effective_strain(const ExplicitSolid& solid, std::size_t element);
/// Living elements whose effective strain exceeds the critical value, ascending. Most are ruled out by a cheap bound.
std::vector<std::int32_t> elements_above_strain(const ExplicitSolid& solid, double critical_strain);

}  // namespace polynya::continuum
