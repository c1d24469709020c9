#pragma once
#include <string>

#include "fluid_solver/equation_of_state.hpp"

/// Where the laws hold. Beyond, their formulas still give numbers, which mean nothing. Densities are above 0. Laws that
/// know a lower bound of the pressure (the vapour pressure of water) are not asked below it.
///
/// - Ideal gas, linear polynomial that is one: specific internal energy at least 0.
/// - Stiffened gas: pressure above minus the stiffening pressure, where the sound speed ends.
/// - Mie-Grueneisen: in compression up to the density at which the fitted shock Hugoniot turns down or has its pole
///   (`largest_density`); in tension as far as the sound speed is real, which with a lower bound of 0 or more it always
///   is.
/// - Linear polynomial in general: as far as the sound speed is real.
/// - Tait: every density.
namespace polynya::fluid {

/// Density at which a Mie-Grueneisen law ends, kg/m^3; infinite for the others.
double largest_density(const EquationOfState& law);

struct Bounds {
  double floor;            ///< lower bound of the pressure, Pa
  double largest_density;  ///< of the law, kg/m^3
  double rounding = 0;     ///< energies of a gas count as negative below minus this, J/m^3
};

/// What is wrong with density (kg/m^3) and specific energy (J/kg), as a part of a sentence; empty in the law's range.
std::string range_fault(const EquationOfState& law, const Bounds& bounds, double rho, double e);

}  // namespace polynya::fluid
