#pragma once
#include <array>

#include "core/continuum/hexahedron.hpp"

/// Hourglass control after Flanagan & Belytschko 1981: forces along the shapes that carry a nodal vector field beyond
/// its linear part. Both forms vanish for every linear field and give no torque.
///
/// Stiffness: total form. The hourglass deformation is what the modes 4..7 hold beyond the reference shape carried
/// along by the mean motion, G = g - c_j a_j; with natural coordinates c of the reference element it needs no history,
/// is objective, and for constant stiffness has a potential 32 k |G|^2. Viscosity: on the rate R = g' - L g. The
/// magnitudes of both are capped by the force at which bending would bring the outer fibre to the flow stress Y, Y A /
/// 12 with A the face area: what a crushed element cannot carry, its hourglass modes do not carry either.
namespace polynya::continuum {

template <class T>
struct HourglassInput {
  T stiffness;        ///< k, N/m, damage included
  T viscosity;        ///< N s/m, nodal force per unit 8 |R|
  T viscosity_floor;  ///< N s/m, left over by the cap
  T allowed;          ///< N, largest magnitude of the nodal force
};

template <class T>
POLYNYA_INLINE T square_of(const std::array<std::array<T, 3>, 4>& v) {
  T sum = dot(v[0], v[0]);
  for (int m = 1; m < 4; ++m) sum += dot(v[m], v[m]);
  return sum;
}

/// The coefficient c of a force 8 c |q|, or what the allowed force leaves of it. Few elements come near it at a time.
template <class T>
POLYNYA_INLINE T capped(const T& coefficient, const T& square, const T& allowed) {
  const T force_square = 64.0 * coefficient * coefficient * square;
  if (!any(force_square > allowed * allowed)) return coefficient;
  return coefficient * minimum(T(1.0), T(allowed / square_root(maximum(force_square, T(1e-290)))));
}

/// v_m - c_jm v_j for the modes m = 4..7. natural: [m - 4][j], or null where all are zero.
template <class T>
POLYNYA_INLINE std::array<std::array<T, 3>, 4> beyond_mean_motion(const Modes<T>& v,
                                                                  const std::array<std::array<T, 3>, 4>* natural) {
  std::array<std::array<T, 3>, 4> result{v[4], v[5], v[6], v[7]};
  if (natural)
    for (int m = 0; m < 4; ++m)
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i) result[m][i] -= (*natural)[m][j] * v[j + 1][i];
  return result;
}

/// Adds the stiffness part to the modes of the nodal force; returns its power against the velocity at mid-step, W
/// positive where energy is taken up.
template <class T>
POLYNYA_INLINE T add_hourglass_stiffness(const HourglassInput<T>& in, const Modes<T>& x, const Modes<T>& v, T dt,
                                         const std::array<std::array<T, 3>, 4>* natural, Modes<T>& force) {
  const auto shape = beyond_mean_motion(x, natural);
  const auto rate = beyond_mean_motion(v, natural);
  const T k = 8.0 * capped(in.stiffness, square_of(shape), in.allowed);
  T power = T(0.0), change = T(0.0);
  for (int m = 0; m < 4; ++m) {
    power += dot(shape[m], rate[m]);
    change += dot(rate[m], rate[m]);
    for (int i = 0; i < 3; ++i) {
      force[m + 4][i] -= k * shape[m][i];
      if (natural)
        for (int j = 0; j < 3; ++j) force[j + 1][i] += (*natural)[m][j] * (k * shape[m][i]);
    }
  }
  return 8.0 * k * (power - 0.5 * dt * change);
}

/// Adds the viscous part: forces on the modes 4..7, and to `stress` what makes them orthogonal to linear fields.
/// middle: modes at mid-step. Returns the dissipated power, W.
template <class T>
POLYNYA_INLINE T add_hourglass_viscosity(const HourglassInput<T>& in, const Modes<T>& x, const Modes<T>& middle,
                                         const Modes<T>& v, const Tensor<T>& gradient, const T& inverse_volume,
                                         Modes<T>& force, Tensor<T>& stress) {
  std::array<std::array<T, 3>, 4> rate;
  for (int m = 0; m < 4; ++m)
    for (int i = 0; i < 3; ++i)
      rate[m][i] = v[m + 4][i] - (gradient[3 * i] * middle[m + 4][0] + gradient[3 * i + 1] * middle[m + 4][1] +
                                  gradient[3 * i + 2] * middle[m + 4][2]);
  const T square = square_of(rate);
  const T c = 8.0 * maximum(in.viscosity_floor, capped(in.viscosity, square, in.allowed));
  const T per_volume = 8.0 * c * inverse_volume;
  for (int i = 0; i < 3; ++i) {
    for (int m = 0; m < 4; ++m) force[m + 4][i] -= c * rate[m][i];
    for (int j = 0; j < 3; ++j) {
      T sum = rate[0][i] * x[4][j];
      for (int m = 1; m < 4; ++m) sum += rate[m][i] * x[m + 4][j];
      stress[3 * i + j] -= per_volume * sum;
    }
  }
  return 8.0 * c * square;
}

}  // namespace polynya::continuum
