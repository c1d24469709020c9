#pragma once
#include <map>
#include <string>
#include <vector>

#include "core/continuum/elementary.hpp"
#include "core/continuum/material_point.hpp"
#include "core/continuum/number.hpp"

/// Johnson & Holmquist 1994, "An improved computational constitutive model for brittle materials" (JH-2).
/// Starred quantities: stress by the equivalent stress at the Hugoniot elastic limit, pressure by the pressure there,
/// strain rate by the reference rate. mu = rho/rho0 - 1.
namespace polynya::continuum {

struct JohnsonHolmquist2 {
  double density = 0;                             ///< kg/m^3, reference
  double shear_modulus = 0;                       ///< G, Pa
  double bulk_modulus = 0;                        ///< K1, Pa
  double bulk_modulus_2 = 0;                      ///< K2, Pa
  double bulk_modulus_3 = 0;                      ///< K3, Pa
  double stress_at_hugoniot_elastic_limit = 0;    ///< sigma_HEL = 1.5 (HEL - P_HEL), Pa
  double pressure_at_hugoniot_elastic_limit = 0;  ///< P_HEL, Pa
  double intact_strength_constant = 0;            ///< A
  double intact_strength_exponent = 0;            ///< N
  double strain_rate_constant = 0;                ///< C
  double fractured_strength_constant = 0;         ///< B
  double fractured_strength_exponent = 0;         ///< M
  double maximum_tensile_pressure = 0;            ///< T, Pa
  double damage_constant = 0;                     ///< D1
  double damage_exponent = 0;                     ///< D2
  double bulking_fraction = 0;                    ///< beta
  double reference_strain_rate = 1;               ///< 1/s
  double maximum_fractured_strength = 1e300;      ///< sigma_f,max as a fraction of sigma_HEL
  double fracture_energy = 0;                     ///< G_f, J/m^2, of a crack in tension; 0: not known
  double tension_ductility = 1;                   ///< factor on the fracture strain where the pressure is negative
};

/// From the values named like the members, with hugoniot_elastic_limit (HEL, Pa) in place of the stress there.
/// bulk_modulus_2, bulk_modulus_3, bulking_fraction (0), reference_strain_rate (1/s) and maximum_fractured_strength
/// (none) and fracture_energy may be left out. Throws std::invalid_argument naming the card and the key that is missing
/// or unphysical.
JohnsonHolmquist2 johnson_holmquist_2_from_card(const std::string& card, const std::map<std::string, double>& values);

/// Strengths of intact and fractured material and the strain at which it fractures, all at one pressure and rate.
template <class T>
struct JohnsonHolmquist2Strength {
  T intact, fractured;  ///< Pa, von Mises measure
  T fracture_strain;    ///< plastic strain that takes the damage from 0 to 1
};

/// 1 + C ln(rate / reference), 1 at and below the reference rate.
template <class T>
POLYNYA_INLINE T rate_factor(const JohnsonHolmquist2& law, const T& rate) {
  if (law.strain_rate_constant == 0) return T(1.0);
  const T relative = maximum(T(rate / law.reference_strain_rate), T(1.0));
  return 1.0 + law.strain_rate_constant * 0.69314718055994531 * log2_of(relative);
}

/// sigma_i = A (P* + T*)^N rate factor, sigma_f = B (P*)^M rate factor <= sigma_f,max, fracture strain D1 (P* + T*)^D2.
/// pressure in Pa, positive in compression; rate: equivalent strain rate, 1/s. The strength at damage D is
/// sigma_i - D (sigma_i - sigma_f).
template <class T>
POLYNYA_INLINE JohnsonHolmquist2Strength<T> strength(const JohnsonHolmquist2& law, const T& pressure, const T& rate,
                                                     bool fractured, bool fracture_strain) {
  const T tiny = T(1e-290);
  const T zero = T(0.0);
  const T tension = (pressure + law.maximum_tensile_pressure) / law.pressure_at_hugoniot_elastic_limit;
  const T compression = pressure / law.pressure_at_hugoniot_elastic_limit;
  const T log_tension = log2_of(maximum(tension, tiny));
  const T scale = law.stress_at_hugoniot_elastic_limit * rate_factor(law, rate);

  JohnsonHolmquist2Strength<T> result{zero, zero, zero};
  result.intact =
      select(tension > zero,
             T(scale * law.intact_strength_constant * exp2_of(T(law.intact_strength_exponent * log_tension))), zero);
  if (fractured && law.fractured_strength_constant > 0) {
    const T power = exp2_of(T(law.fractured_strength_exponent * log2_of(maximum(compression, tiny))));
    const T bounded = minimum(T(scale * law.fractured_strength_constant * power),
                              T(law.stress_at_hugoniot_elastic_limit * law.maximum_fractured_strength));
    result.fractured = select(compression > zero, bounded, zero);
  }
  if (fracture_strain)
    result.fracture_strain =
        select(tension > zero, T(law.damage_constant * exp2_of(T(law.damage_exponent * log_tension))), zero);
  if (fracture_strain && law.tension_ductility != 1)
    result.fracture_strain *= select(pressure < zero, T(law.tension_ductility), T(1.0));
  return result;
}

/// P = K1 mu + dP, in compression also K2 mu^2 + K3 mu^3, Pa. The cut-off at -T (1 - D) is applied by advance_stress.
template <class T>
POLYNYA_INLINE T pressure(const JohnsonHolmquist2& law, const T& mu, const T& bulking_pressure) {
  const T compression = maximum(mu, T(0.0));
  return law.bulk_modulus * mu + compression * compression * (law.bulk_modulus_2 + law.bulk_modulus_3 * compression) +
         bulking_pressure;
}

/// Tangent bulk modulus (1 + mu) dP/dmu, Pa.
template <class T>
POLYNYA_INLINE T tangent_bulk_modulus(const JohnsonHolmquist2& law, const PointState<T>& state) {
  const T density_ratio = 1.0 / state.relative_volume;
  const T compression = maximum(T(density_ratio - 1.0), T(0.0));
  return density_ratio *
         (law.bulk_modulus + compression * (2.0 * law.bulk_modulus_2 + 3.0 * law.bulk_modulus_3 * compression));
}

/// Damage after the plastic strain `increment`; where the fracture strain is 0 any yielding fractures.
template <class T>
POLYNYA_INLINE T grown_damage(const JohnsonHolmquist2Strength<T>& y, const T& damage, const T& increment) {
  const T grown = damage + increment / maximum(y.fracture_strain, T(1e-290));
  return select(y.fracture_strain > T(0.0), minimum(grown, T(1.0)), T(1.0));
}

/// Bulking: a share beta of the deviatoric elastic energy that the loss of strength sets free becomes pressure.
template <class T>
POLYNYA_INLINE T bulked_pressure(const JohnsonHolmquist2& law, const T& mu, const T& bulking_pressure, const T& before,
                                 const T& after) {
  const T released = maximum(T((before * before - after * after) / (6.0 * law.shear_modulus)), T(0.0));
  const T linear = law.bulk_modulus * mu;
  const T total = linear + bulking_pressure;
  return square_root(T(total * total + 2.0 * law.bulking_fraction * law.bulk_modulus * released)) - linear;
}

/// Whether the trial stress lies beyond the strength by more than round-off. It matters where the strength is 0, at the
/// tensile cut-off: there the smallest shear fractures, but the last digit of a hydrostatic stress is no shear.
template <class T>
POLYNYA_INLINE auto exceeds(const JohnsonHolmquist2& law, const T& trial, const T& strength) {
  return trial > strength + 1e-12 * law.shear_modulus;
}

/// What yielding needs to know of a step.
template <class T>
struct YieldTrial {
  T mean;   ///< Pa, equivalent stress of the elastic step
  T whole;  ///< Pa, root mean square over the element
  T rate;   ///< 1/s, equivalent strain rate of the mean
};

/// Plastic strain of a step. Where stress and strain vary about their means the share of the mean strain that flows is
/// that of the strain's root mean square: no more than all of it, for what varies is not returned to the strength.
template <class T>
POLYNYA_INLINE T plastic_increment(const JohnsonHolmquist2& law, const YieldTrial<T>& trial, const T& old_strength,
                                   const T& dt, const Spread<T>& spread) {
  const T tiny = T(1e-290), stiffness = T(3.0 * law.shear_modulus);
  const T of_mean = maximum(T(trial.mean - old_strength), T(0.0)) / stiffness;
  if (!any(spread.strain > T(0.0))) return of_mean;
  const T mean = trial.rate * dt;
  const T share = minimum(T((trial.whole - old_strength) / maximum(T(stiffness * mean), tiny)), T(1.0));
  return maximum(of_mean, T(share * square_root(T(mean * mean + spread.strain * spread.strain))));
}

/// Plastic flow of one step: radial return to the strength at the old damage, then damage and bulking. The strength
/// lost to the damage of a step is returned to in the next one; so the law follows its rate equations where they have a
/// solution, and fractures within a few steps where the strength falls faster than elastic unloading can follow.
template <class T>
void flow_plastically(const JohnsonHolmquist2& law, PointState<T>& state, SymmetricTensor<T>& deviator, const T& mu,
                      const YieldTrial<T>& trial, const T& old_strength, const T& dt, const Spread<T>& spread, T& p) {
  const T zero = T(0.0), one = T(1.0);
  const auto yields = exceeds(law, trial.whole, old_strength);
  const auto y = strength(law, p, trial.rate, true, true);
  const T increment = select(yields, plastic_increment(law, trial, old_strength, dt, spread), zero);
  const T scale = select(yields, T(old_strength / maximum(trial.whole, T(1e-290))), one);
  for (int c = 0; c < 6; ++c) deviator[c] *= scale;

  const T damage = select(yields, grown_damage(y, state.damage, increment), state.damage);
  if (law.bulking_fraction > 0) {
    const T new_strength = y.intact - damage * (y.intact - y.fractured);
    const T bulked = bulked_pressure(law, mu, state.bulking_pressure, old_strength, new_strength);
    const T increase = select(yields && (mu > zero), T(bulked - state.bulking_pressure), zero);
    state.bulking_pressure += increase;
    p += increase;
  }
  p = maximum(p, T(-law.maximum_tensile_pressure * (one - damage)));
  state.damage = damage;
  state.plastic_strain += increment;
}

/// One step of the law. On entry the stress is the old one, already rotated, and state.relative_volume the new one.
/// strain: D dt of the step. Where stress varies about its mean over an element (spread), the element yields when the
/// root of its mean square reaches the strength, as the resultants of a shell do (Ilyushin 1956; Crisfield 1981), and
/// damage grows with the root mean square of the plastic strain. Returns the flow stress of the step (von Mises
/// measure, Pa).
template <class T>
POLYNYA_INLINE T advance_stress(const JohnsonHolmquist2& law, PointState<T>& state, const SymmetricTensor<T>& strain,
                                T dt, const Spread<T>& spread = {}) {
  const T zero = T(0.0), one = T(1.0);
  const T mean_strain = (strain[0] + strain[1] + strain[2]) * (1.0 / 3.0);
  const T mean_stress = (state.stress[0] + state.stress[1] + state.stress[2]) * (1.0 / 3.0);
  SymmetricTensor<T> deviator = state.stress, stretching = strain;
  for (int c = 0; c < 3; ++c) {
    deviator[c] -= mean_stress;
    stretching[c] -= mean_strain;
  }
  for (int c = 0; c < 6; ++c) deviator[c] += 2.0 * law.shear_modulus * stretching[c];

  const T mu = one / state.relative_volume - one;
  T p = maximum(pressure(law, mu, state.bulking_pressure), T(-law.maximum_tensile_pressure * (one - state.damage)));

  // equivalent_stress of a strain is 3/2 of the equivalent strain sqrt(2/3 e:e).
  const T rate = equivalent_stress(stretching) * (2.0 / 3.0) / maximum(dt, T(1e-290));
  const T mean = equivalent_stress(deviator);
  T whole = mean;
  if (any(spread.stress > zero)) whole = square_root(T(mean * mean + spread.stress * spread.stress));
  const auto y = strength(law, p, rate, any(state.damage > zero), false);
  const T flow = y.intact - state.damage * (y.intact - y.fractured);
  if (any(exceeds(law, whole, flow)))
    flow_plastically(law, state, deviator, mu, YieldTrial<T>{mean, whole, rate}, flow, dt, spread, p);

  state.stress = deviator;
  for (int c = 0; c < 3; ++c) state.stress[c] -= p;
  return flow;
}

/// Equivalent stress at yield of intact material under uniaxial stress at a strain rate (1/s), Pa: the root of
/// q = strength(p), p = q/3 in compression and -q/3 in tension. Infinite where the surface is steeper than the path.
double unconfined_compressive_strength(const JohnsonHolmquist2& law, double rate);
double uniaxial_tensile_strength(const JohnsonHolmquist2& law, double rate);

}  // namespace polynya::continuum
