#pragma once
#include <array>
#include <vector>

#include "core/continuum/explicit_solid.hpp"
#include "core/continuum/surface.hpp"
#include "tests/core/contact/bodies.hpp"

namespace polynya::contact::testing {

/// A quarter of an elastic sphere of radius 1 and density 1 around the z axis, cut on x = 0 and y = 0; fine at its
/// lowest point: a cube inside, a shell around it.
struct Sphere {
  continuum::ExplicitSolid solid;
  continuum::BoundarySurface surface;
  std::vector<double> nodal_force;

  /// `fine`: size of the elements (of radius 1) out to `reach` from the lowest point. `turned`: by half a turn about
  /// x = y, z = 0, so that the fine point is the highest one, at -height, and the sphere moves upward.
  Sphere(double fine, double reach, double height, double speed, bool turned = false);

  Mesh contact_mesh() const;       ///< the surface as a body now
  void refresh(Mesh& mesh) const;  ///< positions and velocities
  void step(const std::vector<double>& surface_force, double dt_before, double dt_after);
  double momentum() const;  ///< of the whole sphere, along z
};

/// What Hertz's theory says of the impact of an elastic sphere (radius 1, density 1) on a rigid plane, which is one of
/// two equal spheres that meet at twice the speed: R* = R, m* = m, E* = E/(1 - nu^2).
struct HertzImpact {
  double duration = 0, peak_force = 0, contact_radius = 0, approach = 0;
  HertzImpact(double plane_strain_modulus, double speed);
};

/// An impact as computed.
struct Impact {
  double restitution = 0, duration = 0, peak_force = 0;
  double account_error = 0;    ///< of the contact's energies against the work of its forces, over the energy exchanged
  double lost = 0;             ///< work of the contact's forces on the bodies, sign reversed, over the energy exchanged
  double momentum_gained = 0;  ///< by both bodies together, over that of one
};

/// elements_per_radius: of the elements in the contact circle's radius at the peak. step: fraction of the stable one.
Impact sphere_on_plane(double elements_per_radius, double step, const ContactLaw& law, double speed,
                       double tangential_speed = 0);

/// Two spheres of different meshes that meet head on, each at `speed`; elements of either in the contact circle's
/// radius.
Impact sphere_on_sphere(const std::array<double, 2>& elements_per_radius, double step, const ContactLaw& law,
                        double speed);

inline constexpr double hertz_youngs_modulus = 1, hertz_poisson_ratio = 0.3;

}  // namespace polynya::contact::testing
