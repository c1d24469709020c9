#pragma once
#include <array>

#include "core/continuum/hexahedron.hpp"

/// Hourglass control: forces along the shapes that carry a nodal vector field beyond its linear part (Flanagan &
/// Belytschko 1981). Both forms vanish for every linear field and give no torque.
///
/// Stiffness: total form. The hourglass deformation is what the modes 4..7 hold beyond the reference shape carried
/// along by the mean motion, G_m = c_m - a_mj c_j; with natural coordinates a of the reference element it needs no
/// history, is objective, and for constant stiffness has a potential 32 sum_m k_m |G_m|^2. The stiffness is that of the
/// bending which a mode means (assumed strains of Belytschko & Bindeman 1993, Comput. Methods Appl. Mech. Eng. 105:225,
/// without Poisson's coupling): the mode that varies along the half edges a and b bends a strip with the fibre strain
/// G/a at its surface, energy E V/6 (G/a)^2, so k = E V/(192 a^2). One stiffness serves all directions of a mode, that
/// of the longer of a and b, whose bending is the softer one; mode 7, whose energy is a third, takes the smallest of
/// the three by 3. Bending is so carried right by one element through the thickness, however long it is; twisting
/// across both edges is too stiff (2.6 times for a cube). Where plastic strain has flowed it fades within the strain of
/// yielding to the part that Numerics::hourglass_flowed leaves, and with damage to nothing: what was bent beyond yield
/// is not pulled back to its old shape by all of it.
///
/// Viscosity: on the rate R_m = c_m' - L c_m. The magnitudes of both are capped by the force at which bending would
/// bring the outer fibre to the flow stress Y, Y A / 12 with A the face area: what a crushed element cannot carry, its
/// hourglass modes do not carry either. Laws that ask for it see what the modes hold as a Spread about the mean.
/// Ductile ones do not and flow without end: a part of the viscosity is left to their modes, else their elements fold.
namespace polynya::continuum {

/// Smaller natural coordinates of the reference shape are taken for round-off of a parallelepiped.
inline constexpr double least_natural_hourglass = 1e-13;

/// One vector for every mode 4..7.
template <class T>
using HourglassModes = std::array<std::array<T, 3>, 4>;

template <class T>
struct HourglassInput {
  std::array<T, 4> stiffness;  ///< k_m, N/m, damage and flow included
  T viscosity;                 ///< N s/m, nodal force per unit 8 |R|
  T viscosity_floor;           ///< N s/m, left over by the cap
  T allowed;                   ///< N, largest magnitude of the nodal force
};

template <class T>
POLYNYA_INLINE T square_of(const HourglassModes<T>& v) {
  T sum = dot(v[0], v[0]);
  for (int m = 1; m < 4; ++m) sum += dot(v[m], v[m]);
  return sum;
}

/// R_m, the rate of the modes 4..7 beyond the linear field that turns and stretches with the element.
template <class T>
POLYNYA_INLINE HourglassModes<T> hourglass_rate(const Modes<T>& v, const Modes<T>& middle, const Tensor<T>& gradient) {
  HourglassModes<T> rate;
  for (int m = 0; m < 4; ++m)
    for (int i = 0; i < 3; ++i)
      rate[m][i] = v[m + 4][i] - (gradient[3 * i] * middle[m + 4][0] + gradient[3 * i + 1] * middle[m + 4][1] +
                                  gradient[3 * i + 2] * middle[m + 4][2]);
  return rate;
}

/// Sum of k_m |c_m|^2: N m, or N m/s^2 of a rate.
template <class T>
POLYNYA_INLINE T weighted_square(const std::array<T, 4>& stiffness, const HourglassModes<T>& c) {
  T sum = stiffness[0] * dot(c[0], c[0]);
  for (int m = 1; m < 4; ++m) sum += stiffness[m] * dot(c[m], c[m]);
  return sum;
}

/// The share of a force with this square that the cap leaves. Few elements come near it at a time.
template <class T>
POLYNYA_INLINE T share_allowed(const T& force_square, const T& allowed) {
  if (!any(force_square > allowed * allowed)) return T(1.0);
  return minimum(T(1.0), T(allowed / square_root(maximum(force_square, T(1e-290)))));
}

/// v_m - c_jm v_j for the modes m = 4..7. natural: [m - 4][j], or null where all are zero.
template <class T>
POLYNYA_INLINE HourglassModes<T> beyond_mean_motion(const Modes<T>& v, const HourglassModes<T>* natural) {
  HourglassModes<T> result{v[4], v[5], v[6], v[7]};
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
                                         const HourglassModes<T>* natural, Modes<T>& force) {
  const auto shape = beyond_mean_motion(x, natural);
  const auto rate = beyond_mean_motion(v, natural);
  HourglassModes<T> pull;
  T square = T(0.0);
  for (int m = 0; m < 4; ++m) {
    for (int i = 0; i < 3; ++i) pull[m][i] = (8.0 * in.stiffness[m]) * shape[m][i];
    square += dot(pull[m], pull[m]);
  }
  const T share = share_allowed(square, in.allowed);
  T power = T(0.0), change = T(0.0);
  for (int m = 0; m < 4; ++m) {
    power += dot(pull[m], rate[m]);
    change += (8.0 * in.stiffness[m]) * dot(rate[m], rate[m]);
    for (int i = 0; i < 3; ++i) {
      const T f = share * pull[m][i];
      force[m + 4][i] -= f;
      if (natural)
        for (int j = 0; j < 3; ++j) force[j + 1][i] += (*natural)[m][j] * f;
    }
  }
  return 8.0 * share * (power - 0.5 * dt * change);
}

/// Adds the viscous part: forces on the modes 4..7, and to `stress` what makes them orthogonal to linear fields.
/// rate: of hourglass_rate. Returns the dissipated power, W.
template <class T>
POLYNYA_INLINE T add_hourglass_viscosity(const HourglassInput<T>& in, const Modes<T>& x, const HourglassModes<T>& rate,
                                         const T& inverse_volume, Modes<T>& force, Tensor<T>& stress) {
  const T square = square_of(rate);
  const T share = share_allowed(T(64.0 * in.viscosity * in.viscosity * square), in.allowed);
  const T c = 8.0 * maximum(in.viscosity_floor, T(share * in.viscosity));
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
