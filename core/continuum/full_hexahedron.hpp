#pragma once
#include <array>
#include <cstddef>

#include "core/continuum/hexahedron.hpp"

/// The eight-node hexahedron with 2 x 2 x 2 points (Gauss), in the coefficients of its trilinear map (hexahedron.hpp).
/// The change of volume is the element's mean at every point (mean dilatation: Nagtegaal, Parks & Rice 1974; Hughes
/// 1980, Int. J. Numer. Methods Eng. 15:1413), else eight constraints of volume would lock nearly incompressible flow.
/// So the pressures act through the element's exact volume, and the points' own gradients carry the deviators only. No
/// mode but the six of a rigid body is without energy: nothing has to be added against hourglass modes.
namespace polynya::continuum {

inline constexpr std::size_t gauss_point_count = 8;
inline constexpr double gauss_coordinate = 0.57735026918962576;  // 1/sqrt 3, of weight 1

/// Natural coordinates of a point.
using NaturalPlace = std::array<double, 3>;

constexpr NaturalPlace gauss_place(std::size_t point) {
  return {(point & 1) ? gauss_coordinate : -gauss_coordinate, (point & 2) ? gauss_coordinate : -gauss_coordinate,
          (point & 4) ? gauss_coordinate : -gauss_coordinate};
}

/// d c / d xi_k at a place, of a field with the modes c: [k][component].
template <class T>
POLYNYA_INLINE std::array<std::array<T, 3>, 3> natural_derivatives(const Modes<T>& c, const NaturalPlace& at) {
  std::array<std::array<T, 3>, 3> result;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3, last = (k + 2) % 3;
    for (std::size_t i = 0; i < 3; ++i)
      result[k][i] =
          c[k + 1][i] + at[last] * c[next + 4][i] + at[next] * c[last + 4][i] + (at[next] * at[last]) * c[7][i];
  }
  return result;
}

/// The map at one point.
template <class T>
struct PointGeometry {
  T volume;                                ///< m^3, of the point's eighth: the Jacobian determinant
  std::array<std::array<T, 3>, 3> facing;  ///< [k], m^2, volume x gradient of xi_k
};

template <class T>
POLYNYA_INLINE PointGeometry<T> point_geometry(const Modes<T>& c, const NaturalPlace& at) {
  const auto edge = natural_derivatives(c, at);
  PointGeometry<T> g;
  for (std::size_t k = 0; k < 3; ++k) g.facing[k] = cross(edge[(k + 1) % 3], edge[(k + 2) % 3]);
  g.volume = dot(edge[0], g.facing[0]);
  return g;
}

/// Velocity gradient at a point, 1/s, its trace replaced by the element's `expansion`.
template <class T>
POLYNYA_INLINE Tensor<T> point_gradient(const Modes<T>& velocity, const NaturalPlace& at, const PointGeometry<T>& g,
                                        const T& expansion) {
  const auto rate = natural_derivatives(velocity, at);
  const T factor = 1.0 / g.volume;
  Tensor<T> result;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      result[3 * i + j] =
          factor * (rate[0][i] * g.facing[0][j] + rate[1][i] * g.facing[1][j] + rate[2][i] * g.facing[2][j]);
  const T missing = (1.0 / 3.0) * (expansion - (result[0] + result[4] + result[8]));
  for (std::size_t i = 0; i < 9; i += 4) result[i] += missing;
  return result;
}

/// Adds the modes of the nodal forces of a point's deviator (Pa).
template <class T>
POLYNYA_INLINE void add_deviator_forces(const SymmetricTensor<T>& s, const NaturalPlace& at, const PointGeometry<T>& g,
                                        Modes<T>& force) {
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3, last = (k + 2) % 3;
    const auto& a = g.facing[k];
    const std::array<T, 3> eighth{-0.125 * (s[0] * a[0] + s[3] * a[1] + s[5] * a[2]),
                                  -0.125 * (s[3] * a[0] + s[1] * a[1] + s[4] * a[2]),
                                  -0.125 * (s[5] * a[0] + s[4] * a[1] + s[2] * a[2])};
    for (std::size_t i = 0; i < 3; ++i) {
      force[k + 1][i] += eighth[i];
      force[next + 4][i] += at[last] * eighth[i];
      force[last + 4][i] += at[next] * eighth[i];
      force[7][i] += (at[next] * at[last]) * eighth[i];
    }
  }
}

/// The length that bounds the step (shortest_length) of the parallelepiped that the element is about a point, m.
template <class T>
POLYNYA_INLINE T point_length(const PointGeometry<T>& g) {
  Geometry<T> tangent{8.0 * g.volume, {}};
  for (std::size_t k = 0; k < 3; ++k) tangent.gradient[k + 1] = g.facing[k];
  return shortest_length(tangent);
}

}  // namespace polynya::continuum
