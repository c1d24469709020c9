#pragma once
#include <map>
#include <string>
#include <variant>

#include "core/continuum/elastic.hpp"
#include "core/continuum/j2_plastic.hpp"
#include "core/continuum/johnson_holmquist_2.hpp"
#include "core/continuum/rotation.hpp"

namespace polynya::continuum {

/// The law of a body: chosen once per body, so that kernels are compiled per law.
/// A law is a struct of constants with density and shear_modulus and the functions advance_stress and
/// tangent_bulk_modulus.
using Law = std::variant<Elastic, J2Plastic, JohnsonHolmquist2>;

/// law: "elastic", "j2_plastic" or "johnson_holmquist_2". Throws std::invalid_argument naming the card and the key at
/// fault.
Law law_from_card(const std::string& card, const std::string& law, const std::map<std::string, double>& values);

/// Reference density, kg/m^3.
double density(const Law& law);
void set_density(Law& law, double density);

/// The elastic solid with the density and the moduli of a law: what is left of it without yielding and failure.
Elastic elastic_part(const Law& law);

/// Longitudinal wave speed sqrt((K + 4 G / 3) / rho) at the reference state, m/s.
double longitudinal_wave_speed(const Law& law);
/// Shear wave speed sqrt(G / rho), m/s.
double shear_wave_speed(const Law& law);

/// One step of one material point from the velocity gradient at mid-step (1/s): the relative volume follows tr(L), the
/// old stress turns by the Hughes-Winget rotation, the law adds its increment. For particles; T double or a pack.
template <class L, class T>
void update_stress(const L& law, PointState<T>& state, const Tensor<T>& velocity_gradient, T dt) {
  const T growth = 0.5 * dt * (velocity_gradient[0] + velocity_gradient[4] + velocity_gradient[8]);
  state.relative_volume *= (1.0 + growth) / (1.0 - growth);
  state.stress = rotated(state.stress, hughes_winget_rotation(velocity_gradient, dt));
  advance_stress(law, state, strain_increment(velocity_gradient, dt), dt);
}

/// Longitudinal wave speed of the point at its present state, m/s.
template <class L, class T>
POLYNYA_INLINE T wave_speed(const L& law, const PointState<T>& state) {
  return square_root(T((tangent_bulk_modulus(law, state) + 4.0 / 3.0 * law.shear_modulus) * state.relative_volume *
                       (1 / law.density)));
}

}  // namespace polynya::continuum
