#include "core/continuum/static_step.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace polynya::continuum {

RememberedState remembered_state(const ExplicitSolid& solid) {
  const ElementState& e = solid.element;
  return {e.stress, e.damage, e.plastic_strain, e.bulking_pressure, solid.points};
}

Numerics without_viscosities(Numerics numerics) {
  numerics.quadratic_viscosity = numerics.linear_viscosity = 0;
  numerics.hourglass_viscosity = numerics.hourglass_floor = 0;
  return numerics;
}

void step_from_reference(ExplicitSolid& solid, const RememberedState& start, std::span<const double> present,
                         std::span<const double> displacement) {
  try {
    lay_down_unloaded(solid);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(std::string("no equilibrium: the shape without stress folds: ") + error.what());
  }
  solid.element.stress = start.stress;
  solid.element.damage = start.damage;
  solid.element.plastic_strain = start.plastic_strain;
  solid.element.bulking_pressure = start.bulking_pressure;
  solid.points = start.points;
  constexpr double step = 1;  // s: strain rates far below those that any law heeds
  for (std::size_t i = 0; i < present.size(); ++i) solid.velocities[i] = displacement[i] / step;
  std::copy(present.begin(), present.end(), solid.positions.begin());
  internal_forces(solid, step);
  std::fill(solid.velocities.begin(), solid.velocities.end(), 0.0);
  internal_forces(solid, 0);
}

}  // namespace polynya::continuum
