#pragma once
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "core/compute/state_archive.hpp"
#include "core/contact/body.hpp"
#include "core/contact/inheritance.hpp"
#include "core/contact/touch.hpp"

namespace polynya::contact {

struct ContactLaw {
  double friction = 0;            ///< Coulomb coefficient
  double damping = 0;             ///< fraction of the critical damping of a pair, 0 to 1
  double stiffness_factor = 0.1;  ///< of mass / dt^2, the bound that keeps a force held over the step stable
  double depth_limit = 0;         ///< m, how deep a point that has no history is found
  double skin = 0;                ///< m, distance beyond that to which candidates are kept; 0: depth_limit
  std::array<bool, 2> mirror{};   ///< symmetry planes x = 0, y = 0 of both bodies
  bool two_way = false;           ///< vertices of the primary surface against the secondary's triangles as well
  bool edges = false;             ///< edges of both surfaces against each other
};

struct ContactForces {
  std::vector<double> primary;    ///< [nv][3] N
  std::vector<double> secondary;  ///< [ns][3] N
  double stored_energy = 0;       ///< J, in the normal and tangential springs now
  double friction_loss = 0;       ///< J, dissipated by sliding since the evaluation before; never negative
  double damping_loss = 0;     ///< J, likewise by damping, as a leapfrog's trapezoidal work; its sum is never negative
  double released_energy = 0;  ///< J, given up since then when stiffness had to fall or a pair vanished; see below
  std::size_t active = 0;      ///< pairs in contact
  double deepest = 0;          ///< m, depth that exerts a force
};

/// Forces of all contacts of one time.
///
/// Stiffness of a pair: share x stiffness_factor x reduced mass / dt^2, then scaled down so that at every vertex the
/// sum of stiffness x weight stays below stiffness_factor x mass / dt^2. With u the motion along the pushes, sum k
/// (g.u)^2 <= sum over vertices of u^2 sum k |g| |g|_1, |g|_1 = 2 (Gershgorin), so the largest eigenvalue of all
/// contacts together is below 2 stiffness_factor / dt^2 however many press on one vertex (one pair alone:
/// stiffness_factor / dt^2). On a rigid body they press together: there the sum of stiffness / mass, the mass with which all of it
/// resists a force at the vertex (convex in the place: weights may interpolate 1 / mass), stays below stiffness_factor / dt^2. A pair keeps the stiffness it was born with unless it must fall; what the springs held
/// more is booked as released.
///
/// A step in which a pair comes into contact or parts is only partly one of contact, but a leapfrog's work takes the
/// force as linear over it: depth d and gap g before or after, the bodies lose k d g / 2 more than the spring stores,
/// and gain as much more where they part. Zero on average, it is booked as released, so that the account closes.
///
/// Normal force: k (depth - offset) plus damping 2 zeta k dt / sqrt(stiffness_factor) x rate of depth, together never
/// negative. Friction: a spring of the same stiffness that grows by the motion of the bodies past each other and turns
/// with the surface's material; beyond friction x normal force it is cut to that (return to the cone), which dissipates.
class ContactSprings {
 public:
  /// Throws std::invalid_argument on a law whose damping would not be stable.
  explicit ContactSprings(const ContactLaw& law);

  /// Forces of pairs that the last change of topology ended; the next apply hands them on (inheritance.hpp).
  void topology_changed(std::vector<LostForce> lost);

  /// Adds to the forces, which have the sizes of the bodies; fills in the energies. Arrays by touch are kept as
  /// the caller's until the next call.
  void apply(const Body& primary, const Body& secondary, double dt, std::vector<Touch>& touches, ContactForces& forces);
  /// Books the second half of the work of the last forces' damping; call before the touches change.
  void settle(const Body& primary, const Body& secondary, double dt, std::span<const Touch> touches);
  /// The same when vertices were renumbered: with the velocities there were.
  void settle_as_before(double dt, std::span<const Touch> touches);

  POLYNYA_STATE(law_, load_primary_, load_secondary_, lost_, settled_damping_)

 private:
  void limit_stiffness(const Body& primary, const Body& secondary, double dt, std::vector<Touch>& touches);
  void push(const Body& primary, const Body& secondary, double dt, Touch& touch, ContactForces& forces);
  /// motion: m, of what is pushed past what it is pushed from in the last step.
  Vector3 friction(const Vector3& motion, double normal_force, Touch& touch, ContactForces& forces) const;

  ContactLaw law_;
  std::vector<double> load_primary_, load_secondary_;  // 1/s^2, sum of stiffness x weight / mass: [vertices], rigid: [1]
  std::optional<std::vector<LostForce>> lost_;         // since the last change of topology
  double settled_damping_ = 0;
};

/// Velocity of what is pushed less that of what it is pushed from, m/s.
Vector3 relative_velocity(const Body& primary, const Body& secondary, const Touch& touch);

}  // namespace polynya::contact
