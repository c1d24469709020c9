#pragma once
#include <map>
#include <string>

#include "core/continuum/material_point.hpp"
#include "core/continuum/number.hpp"

namespace polynya::continuum {

/// Von Mises plasticity with linear isotropic hardening (Simo & Hughes 1998, Computational Inelasticity, box 3.2, with
/// Kappa' = H): yield stress Y = Y0 + H eps_p, pressure K mu, mu = rho/rho0 - 1. Where eps_p has reached the failure
/// strain the point carries neither shear nor tension any more.
struct J2Plastic {
  double density = 0;             ///< kg/m^3, reference
  double bulk_modulus = 0;        ///< Pa
  double shear_modulus = 0;       ///< Pa
  double yield_stress = 0;        ///< Y0, Pa, von Mises measure
  double hardening_modulus = 0;   ///< H = dY/d eps_p, Pa
  double failure_strain = 1e300;  ///< plastic strain
};

/// From the values density, youngs_modulus, poisson_ratio, yield_stress, hardening_modulus (0) and failure_strain
/// (none), SI. Throws std::invalid_argument naming card and key.
J2Plastic j2_plastic_from_card(const std::string& card, const std::map<std::string, double>& values);

/// Tangent bulk modulus (1 + mu) dP/dmu at this state, Pa.
template <class T>
POLYNYA_INLINE T tangent_bulk_modulus(const J2Plastic& law, const PointState<T>& state) {
  return law.bulk_modulus / state.relative_volume;
}

/// One step of the law: radial return, exact for linear hardening. On entry the stress is the old one, already rotated,
/// and state.relative_volume the new one. strain: D dt of the step. Returns the flow stress (von Mises measure, Pa).
template <class T>
POLYNYA_INLINE T advance_stress(const J2Plastic& law, PointState<T>& state, const SymmetricTensor<T>& strain,
                                T /*dt*/) {
  const T zero = T(0.0), one = T(1.0);
  const T mean_strain = (strain[0] + strain[1] + strain[2]) * (1.0 / 3.0);
  const T mean_stress = (state.stress[0] + state.stress[1] + state.stress[2]) * (1.0 / 3.0);
  SymmetricTensor<T> deviator = state.stress;
  for (int c = 0; c < 3; ++c) deviator[c] += 2.0 * law.shear_modulus * (strain[c] - mean_strain) - mean_stress;
  for (int c = 3; c < 6; ++c) deviator[c] += 2.0 * law.shear_modulus * strain[c];

  const T yield = law.yield_stress + law.hardening_modulus * state.plastic_strain;
  const T trial = equivalent_stress(deviator);
  const T increment = maximum(T(trial - yield), zero) / (3.0 * law.shear_modulus + law.hardening_modulus);
  state.plastic_strain += increment;
  const auto failed = state.plastic_strain >= law.failure_strain;
  state.damage = select(failed, one, state.damage);
  const T flow = select(failed, zero, T(yield + law.hardening_modulus * increment));
  const T scale = minimum(T(flow / maximum(trial, T(1e-290))), one);
  const T elastic = law.bulk_modulus * (one / state.relative_volume - one);
  const T pressure = select(failed, maximum(elastic, zero), elastic);

  for (int c = 0; c < 6; ++c) state.stress[c] = scale * deviator[c];
  for (int c = 0; c < 3; ++c) state.stress[c] -= pressure;
  return flow;
}

}  // namespace polynya::continuum
