#pragma once
#include "core/continuum/explicit_solid.hpp"

/// Statics with elements that know stress rates only: one step leads from the shape without stress to the present one.
/// Stress grows by the strain increment of the displacement over the configuration at mid-step and turns by its
/// Hughes-Winget rotation. Against the logarithmic strain the increment errs by strain^3 / 12: below 1e-7 of
/// the stress for strains below 1e-3.
namespace polynya::continuum {

/// What the elements remember at the start of such a step.
struct RememberedState {
  std::array<std::vector<double>, 6> stress;
  std::vector<double> damage, plastic_strain, bulking_pressure;
  std::vector<PointArrays> points;
};
RememberedState remembered_state(const ExplicitSolid& solid);

/// Coefficients without viscosities: forces at rest.
Numerics without_viscosities(Numerics numerics);

/// From the reference shape (mesh.nodes, where `solid` is laid down first) to `present` in one step, at rest at its
/// end; internal_force is that of the elements there. displacement: present - mesh.nodes before the nodes were rounded,
/// which would be felt where strains are small (all [n][3], m). Throws std::runtime_error where that shape folds,
/// BadElement where the present one does.
void step_from_reference(ExplicitSolid& solid, const RememberedState& start, std::span<const double> present,
                         std::span<const double> displacement);

}  // namespace polynya::continuum
