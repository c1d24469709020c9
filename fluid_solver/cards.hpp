#pragma once
#include "core/scene/scene.hpp"
#include "fluid_solver/fluid.hpp"

namespace polynya::fluid {

/// The equation of state of a material card. Throws std::runtime_error naming the card when its law is not one of
/// mie_grueneisen, linear_polynomial, ideal_gas, stiffened_gas.
EquationOfState law_of(const scene::MaterialCard& card);

/// Water and air of a scene on the scene's grid, at rest in hydrostatic balance where the solids leave room; not yet
/// started around moving walls. Full, half and quarter models close the planes of symmetry.
Fluid make_fluid(const scene::Scene& scene);

/// A shock tube along x: the left material is `water`, the right `air`, also when both are the same.
Fluid make_tube(const scene::Scene& scene);

}  // namespace polynya::fluid
