#pragma once
#include <map>
#include <string>

#include "core/continuum/material_point.hpp"
#include "core/continuum/number.hpp"

namespace polynya::continuum {

/// Isotropic hypoelasticity: objective stress rate = K tr(D) I + 2 G dev(D).
struct Elastic {
  double density = 0;        ///< kg/m^3, reference
  double bulk_modulus = 0;   ///< Pa
  double shear_modulus = 0;  ///< Pa
};

/// From the values density, youngs_modulus, poisson_ratio (SI). Throws std::invalid_argument naming card and key.
Elastic elastic_from_card(const std::string& card, const std::map<std::string, double>& values);

/// Tangent bulk modulus (1 + mu) dP/dmu at this state, Pa.
template <class T>
POLYNYA_INLINE T tangent_bulk_modulus(const Elastic& law, const PointState<T>&) {
  return T(law.bulk_modulus);
}

/// One step of the law. On entry the stress is the old one, already rotated, and state.relative_volume the new one.
/// strain: D dt of the step. Returns the flow stress (von Mises measure, Pa): here without bound.
template <class T>
POLYNYA_INLINE T advance_stress(const Elastic& law, PointState<T>& state, const SymmetricTensor<T>& strain, T /*dt*/) {
  const T volumetric = strain[0] + strain[1] + strain[2];
  const T diagonal = (law.bulk_modulus - 2.0 / 3.0 * law.shear_modulus) * volumetric;
  for (int c = 0; c < 6; ++c) state.stress[c] += 2.0 * law.shear_modulus * strain[c];
  for (int c = 0; c < 3; ++c) state.stress[c] += diagonal;
  return T(1e300);
}

}  // namespace polynya::continuum
