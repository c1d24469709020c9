#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

/// Three-component vectors of the contact search.
namespace polynya::contact {

using Vector3 = std::array<double, 3>;

inline Vector3 operator+(const Vector3& a, const Vector3& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Vector3 operator-(const Vector3& a, const Vector3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Vector3 operator*(double s, const Vector3& a) {
  return {s * a[0], s * a[1], s * a[2]};
}
inline double dot(const Vector3& a, const Vector3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double norm(const Vector3& a) {
  return std::sqrt(dot(a, a));
}

/// Row i of an array [count][3].
inline Vector3 row(std::span<const double> values, std::size_t i) {
  return {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
}
inline void add_to_row(std::span<double> values, std::size_t i, const Vector3& v) {
  values[3 * i] += v[0];
  values[3 * i + 1] += v[1];
  values[3 * i + 2] += v[2];
}

}  // namespace polynya::contact
