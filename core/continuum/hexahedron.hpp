#pragma once
#include <array>

#include "core/continuum/material_point.hpp"
#include "core/continuum/number.hpp"

/// The eight-node hexahedron with one point: Flanagan & Belytschko 1981, written in the coefficients of the trilinear
/// map
///     x(xi, eta, zeta) = c0 + c1 xi + c2 eta + c3 zeta + c4 eta zeta + c5 zeta xi + c6 xi eta + c7 xi eta zeta,
/// which an eight-point Hadamard transform gives with additions only. c1..c3 are half the edges of the mean
/// parallelepiped, c4..c7 the hourglass part. Nodal values of a mode are the signs H_m(a).
namespace polynya::continuum {

/// [mode][component].
template <class T>
using Modes = std::array<std::array<T, 3>, 8>;
/// [local node of VTK's order][component].
template <class T>
using NodalVectors = std::array<std::array<T, 3>, 8>;

/// 8 c_m = sum_a H_m(a) n_a, for one component.
template <class T>
POLYNYA_INLINE std::array<T, 8> mode_sums_of(const std::array<T, 8>& n) {
  const T s0 = n[1] + n[0], s1 = n[2] + n[3], s2 = n[5] + n[4], s3 = n[6] + n[7];
  const T d0 = n[1] - n[0], d1 = n[2] - n[3], d2 = n[5] - n[4], d3 = n[6] - n[7];
  const T ss0 = s1 + s0, ss1 = s3 + s2, sd0 = s1 - s0, sd1 = s3 - s2;
  const T ds0 = d1 + d0, ds1 = d3 + d2, dd0 = d1 - d0, dd1 = d3 - d2;
  return {ss1 + ss0, ds1 + ds0, sd1 + sd0, ss1 - ss0, sd1 - sd0, ds1 - ds0, dd1 + dd0, dd1 - dd0};
}

/// n_a = sum_m c_m H_m(a), for one component.
template <class T>
POLYNYA_INLINE std::array<T, 8> nodal_values(const std::array<T, 8>& c) {
  const T ss0 = c[0] - c[3], ss1 = c[0] + c[3], sd0 = c[2] - c[4], sd1 = c[2] + c[4];
  const T ds0 = c[1] - c[5], ds1 = c[1] + c[5], dd0 = c[6] - c[7], dd1 = c[6] + c[7];
  const T s0 = ss0 - sd0, s1 = ss0 + sd0, s2 = ss1 - sd1, s3 = ss1 + sd1;
  const T d0 = ds0 - dd0, d1 = ds0 + dd0, d2 = ds1 - dd1, d3 = ds1 + dd1;
  return {s0 - d0, s0 + d0, s1 + d1, s1 - d1, s2 - d2, s2 + d2, s3 + d3, s3 - d3};
}

/// 8 c_m.
template <class T>
POLYNYA_INLINE Modes<T> mode_sums_of(const NodalVectors<T>& nodal) {
  Modes<T> result;
  for (int i = 0; i < 3; ++i) {
    std::array<T, 8> component;
    for (int a = 0; a < 8; ++a) component[a] = nodal[a][i];
    component = mode_sums_of(component);
    for (int m = 0; m < 8; ++m) result[m][i] = component[m];
  }
  return result;
}
/// c_m.
template <class T>
POLYNYA_INLINE Modes<T> modes_of(const NodalVectors<T>& nodal) {
  Modes<T> result = mode_sums_of(nodal);
  for (auto& mode : result)
    for (T& component : mode) component *= 0.125;
  return result;
}

template <class T>
POLYNYA_INLINE NodalVectors<T> nodal_values(const Modes<T>& modes) {
  NodalVectors<T> result;
  for (int i = 0; i < 3; ++i) {
    std::array<T, 8> component;
    for (int m = 0; m < 8; ++m) component[m] = modes[m][i];
    component = nodal_values(component);
    for (int a = 0; a < 8; ++a) result[a][i] = component[a];
  }
  return result;
}

template <class T>
POLYNYA_INLINE std::array<T, 3> cross(const std::array<T, 3>& a, const std::array<T, 3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
template <class T>
POLYNYA_INLINE T dot(const std::array<T, 3>& a, const std::array<T, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Exact volume V of the trilinear hexahedron and its derivatives 1/8 dV/dc_m for the modes m = 1..6 (the others are
/// zero). The mean gradient of a field with nodal values v_a is 1/V sum_a v_a dV/dx_a = 8/V sum_m v_m gradient[m].
template <class T>
struct Geometry {
  T volume;
  std::array<std::array<T, 3>, 7> gradient;  ///< [m], m^2; entry 0 unused
};

/// V/8 = [c1,c2,c3] - ([c1,c5,c6] + [c4,c2,c6] + [c4,c5,c3])/3, square brackets being triple products.
template <class T>
POLYNYA_INLINE Geometry<T> geometry(const Modes<T>& c) {
  Geometry<T> g;
  std::array<std::array<T, 3>, 4> third;  // of c4..c6, sign reversed
  for (int m = 1; m <= 3; ++m)
    for (int i = 0; i < 3; ++i) third[m][i] = (-1.0 / 3.0) * c[m + 3][i];
  const int next[] = {0, 2, 3, 1}, last[] = {0, 3, 1, 2};
  for (int m = 1; m <= 3; ++m) {
    const auto &a = c[next[m]], &b = c[last[m]], &k = c[last[m] + 3], &h3 = third[next[m]], &k3 = third[last[m]];
    const auto faces = cross(a, b), twist = cross(h3, k), first = cross(a, k3), second = cross(h3, b);
    for (int i = 0; i < 3; ++i) {
      g.gradient[m][i] = faces[i] + twist[i];
      g.gradient[m + 3][i] = first[i] + second[i];
    }
  }
  g.volume = 8.0 * (dot(c[1], g.gradient[1]) + dot(c[4], g.gradient[4]));
  return g;
}

/// Mean velocity gradient L_ij = d v_i / d x_j of the element, 1/s.
template <class T>
POLYNYA_INLINE Tensor<T> mean_gradient(const Modes<T>& velocity, const Geometry<T>& g) {
  Tensor<T> result;
  const T factor = 8.0 / g.volume;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      T sum = velocity[1][i] * g.gradient[1][j];
      for (int m = 2; m <= 6; ++m) sum += velocity[m][i] * g.gradient[m][j];
      result[3 * i + j] = factor * sum;
    }
  return result;
}

/// Area that with the volume gives the length whose crossing by a wave bounds the step, m^2: 4 sqrt(lambda), lambda a
/// bound on the largest eigenvalue of sum_m gradient gradient^T that is exact for bricks in any orientation (there the
/// largest face).
template <class T>
POLYNYA_INLINE T largest_area(const Geometry<T>& g) {
  const auto magnitude = [](const T& x) { return maximum(x, T(-x)); };
  const T d12 = magnitude(dot(g.gradient[1], g.gradient[2]));
  const T d23 = magnitude(dot(g.gradient[2], g.gradient[3]));
  const T d31 = magnitude(dot(g.gradient[3], g.gradient[1]));
  const T row1 = dot(g.gradient[1], g.gradient[1]) + d12 + d31;
  const T row2 = dot(g.gradient[2], g.gradient[2]) + d12 + d23;
  const T row3 = dot(g.gradient[3], g.gradient[3]) + d23 + d31;
  const T twisted =
      dot(g.gradient[4], g.gradient[4]) + dot(g.gradient[5], g.gradient[5]) + dot(g.gradient[6], g.gradient[6]);
  const T largest = maximum(maximum(row1, row2), row3) + twisted;
  return 4.0 * square_root(maximum(largest, T(1e-290)));
}

/// That length, m: for bricks the shortest edge.
template <class T>
POLYNYA_INLINE T shortest_length(const Geometry<T>& g) {
  return g.volume / largest_area(g);
}

/// Modes of the nodal forces -sum_j stress_ij dV/dx_ja. stress: any tensor, row by row.
template <class T>
POLYNYA_INLINE Modes<T> stress_forces(const Tensor<T>& stress, const Geometry<T>& g) {
  Modes<T> force{};
  for (int m = 1; m <= 6; ++m)
    for (int i = 0; i < 3; ++i)
      force[m][i] = -(stress[3 * i] * g.gradient[m][0] + stress[3 * i + 1] * g.gradient[m][1] +
                      stress[3 * i + 2] * g.gradient[m][2]);
  return force;
}

}  // namespace polynya::continuum
