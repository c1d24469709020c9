#pragma once
#include "core/continuum/material_point.hpp"

namespace polynya::continuum {

/// D dt, the symmetric part of the velocity gradient times the step.
template <class T>
POLYNYA_INLINE SymmetricTensor<T> strain_increment(const Tensor<T>& gradient, T dt) {
  const T half = 0.5 * dt;
  return {dt * gradient[0],
          dt * gradient[4],
          dt * gradient[8],
          half * (gradient[1] + gradient[3]),
          half * (gradient[5] + gradient[7]),
          half * (gradient[2] + gradient[6])};
}

/// Rotation of a step from the spin W at mid-step: (I - W dt/2)^-1 (I + W dt/2), exact for rigid rotations whose
/// velocity is displacement / dt. Hughes & Winget 1980.
template <class T>
POLYNYA_INLINE Tensor<T> hughes_winget_rotation(const Tensor<T>& gradient, T dt) {
  // Axial vector of W dt/2; the Cayley transform is I + 2/(1 + w.w) (w^ + w^ w^).
  const T quarter = 0.25 * dt;
  const T x = quarter * (gradient[7] - gradient[5]);
  const T y = quarter * (gradient[2] - gradient[6]);
  const T z = quarter * (gradient[3] - gradient[1]);
  const T f = 2.0 / (1.0 + x * x + y * y + z * z);
  return {1.0 - f * (y * y + z * z), f * (x * y - z),           f * (x * z + y),
          f * (x * y + z),           1.0 - f * (x * x + z * z), f * (y * z - x),
          f * (x * z - y),           f * (y * z + x),           1.0 - f * (x * x + y * y)};
}

/// R s R^T.
template <class T>
POLYNYA_INLINE SymmetricTensor<T> rotated(const SymmetricTensor<T>& s, const Tensor<T>& r) {
  Tensor<T> a;  // R s
  for (int i = 0; i < 3; ++i) {
    const T &p = r[3 * i], &q = r[3 * i + 1], &u = r[3 * i + 2];
    a[3 * i] = p * s[0] + q * s[3] + u * s[5];
    a[3 * i + 1] = p * s[3] + q * s[1] + u * s[4];
    a[3 * i + 2] = p * s[5] + q * s[4] + u * s[2];
  }
  const auto entry = [&](int i, int j) {
    return a[3 * i] * r[3 * j] + a[3 * i + 1] * r[3 * j + 1] + a[3 * i + 2] * r[3 * j + 2];
  };
  return {entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(1, 2), entry(0, 2)};
}

}  // namespace polynya::continuum
