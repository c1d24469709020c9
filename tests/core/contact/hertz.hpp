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

  /// `fine`: size of the elements (of radius 1) out to `reach` from the lowest point.
  Sphere(double fine, double reach, double height, double speed);

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
  double account_error = 0;  ///< of the contact's energies against the work of its forces, over the energy exchanged
  double lost = 0;           ///< work of the contact's forces on the bodies, sign reversed, over the energy exchanged
};

/// elements_per_radius: of the elements in the contact circle's radius at the peak. step: fraction of the stable one.
Impact sphere_on_plane(double elements_per_radius, double step, const ContactLaw& law, double speed,
                       double tangential_speed = 0);

inline constexpr double hertz_youngs_modulus = 1, hertz_poisson_ratio = 0.3;

}  // namespace polynya::contact::testing
