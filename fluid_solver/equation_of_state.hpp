#pragma once
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <type_traits>
#include <variant>

#include "fluid_solver/ideal_gas.hpp"
#include "fluid_solver/linear_polynomial.hpp"
#include "fluid_solver/mie_grueneisen.hpp"
#include "fluid_solver/stiffened_gas.hpp"
#include "fluid_solver/tait.hpp"

namespace polynya::fluid {

/// One of the laws, by value. Hot loops are entered once per row with std::visit, never per cell.
using EquationOfState = std::variant<MieGrueneisen, LinearPolynomial, IdealGas, StiffenedGas, Tait>;

inline Response respond(const EquationOfState& law, double rho, double e) {
  return std::visit([&](const auto& each) { return each(rho, e); }, law);
}

/// True for laws whose pressure comes from the internal energy alone.
inline bool is_gas(const EquationOfState& law) {
  const auto* polynomial = std::get_if<LinearPolynomial>(&law);
  return std::holds_alternative<IdealGas>(law) || (polynomial && polynomial->is_gas());
}

/// Isentropic bulk modulus rho c^2.
inline double bulk_modulus(double rho, const Response& r) {
  return rho * r.by_density + r.pressure * r.by_energy / rho;
}

/// Density below which a law says nothing of waves, kg/m^3: half the rest density of liquids. What is left of one there
/// is drops and vapour; the energy term of Mie and Grueneisen, which is per rest volume, would let sound run hundreds
/// of times faster in a hot trace of water than in water. Gases: 0.
template <class Law>
double least_wave_density(const Law& law) {
  if constexpr (std::is_same_v<Law, MieGrueneisen> || std::is_same_v<Law, Tait>) return 0.5 * law.density;
  if constexpr (std::is_same_v<Law, LinearPolynomial>) return law.is_gas() ? 0.0 : 0.5 * law.density;
  return 0.0;
}

/// Square of the speed of sound, m^2/s^2; `per_density`: 1 over the density, at most 1 over least_wave_density.
inline double square_of_sound_speed(const Response& r, double per_density) {
  return r.by_density + r.pressure * r.by_energy * per_density * per_density;
}

/// Speed of sound, m/s; 0 where the law has none.
inline double sound_speed(const EquationOfState& law, double rho, const Response& r) {
  const double least = std::visit([](const auto& each) { return least_wave_density(each); }, law);
  return std::sqrt(std::max(0.0, square_of_sound_speed(r, 1.0 / std::max(rho, least))));
}

/// Specific internal energy at which the law gives this pressure; all laws here are linear in the energy. 0 where the
/// pressure does not depend on it.
inline double energy_at(const EquationOfState& law, double rho, double pressure) {
  const Response cold = respond(law, rho, 0.0);
  return cold.by_energy > 0 ? (pressure - cold.pressure) / cold.by_energy : 0.0;
}

/// Density at which the law gives this pressure at specific energy e. Newton from `guess`.
/// Throws std::runtime_error if the iteration does not settle.
inline double density_at(const EquationOfState& law, double pressure, double e, double guess) {
  double rho = guess;
  for (int iteration = 0; iteration < 100; ++iteration) {
    const Response r = respond(law, rho, e);
    const double next = std::max(0.2 * rho, rho - (r.pressure - pressure) / r.by_density);
    if (std::abs(next - rho) <= 2e-16 * rho || (iteration > 50 && std::abs(next - rho) < 1e-14 * rho)) return next;
    rho = next;
  }
  throw std::runtime_error("no density of this material gives a pressure of " + std::to_string(pressure) + " Pa");
}

}  // namespace polynya::fluid
