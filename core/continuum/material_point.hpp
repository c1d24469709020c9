#pragma once
#include <array>

#include "core/continuum/number.hpp"

namespace polynya::continuum {

/// Symmetric tensors: xx, yy, zz, xy, yz, zx (tensor components, not engineering shear). Stress: Pa, positive in
/// tension.
template <class T>
using SymmetricTensor = std::array<T, 6>;

/// General tensors, row by row: index 3 i + j. A velocity gradient is L_ij = d v_i / d x_j, 1/s.
template <class T>
using Tensor = std::array<T, 9>;

/// Von Mises stress of a deviator, Pa.
template <class T>
POLYNYA_INLINE T equivalent_stress(const SymmetricTensor<T>& s) {
  return square_root(
      T(1.5 * (s[0] * s[0] + s[1] * s[1] + s[2] * s[2]) + 3.0 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5])));
}

/// What a constitutive law remembers of one material point. T: double, or a pack of doubles.
template <class T>
struct PointState {
  SymmetricTensor<T> stress{};  ///< Pa, Cauchy
  T relative_volume{1.0};       ///< V / V0 = rho0 / rho
  T damage{0.0};                ///< 0..1
  T plastic_strain{0.0};        ///< accumulated equivalent plastic strain
  T bulking_pressure{0.0};      ///< Pa
};

/// How far stress and strain lie from their means over an element whose law is asked once: roots of the mean squares.
template <class T>
struct Spread {
  T stress{0.0};  ///< Pa, von Mises measure, elastic
  T strain{0.0};  ///< equivalent strain of the step
};

}  // namespace polynya::continuum
