#include "geometry/vehicle/mesh_quality.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace polynya::geometry {
namespace {

using Vector = std::array<double, 3>;
using Corners = std::array<Vector, 8>;

Vector minus(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Vector plus(const Vector& a, const Vector& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
double norm(const Vector& a) {
  return std::sqrt(dot(a, a));
}
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// The three neighbours of each corner, right-handed for a positive element.
constexpr std::array<std::array<int, 3>, 8> neighbours = {
    {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7}, {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}}};
constexpr std::array<std::array<int, 2>, 12> edges = {
    {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};
constexpr std::array<std::array<int, 4>, 6> faces = {
    {{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};

Corners corners_of(const continuum::HexMesh& mesh, std::size_t element) {
  Corners c;
  for (int k = 0; k < 8; ++k) {
    const double* node = &mesh.nodes[3 * static_cast<std::size_t>(mesh.elements[8 * element + k])];
    c[k] = {node[0], node[1], node[2]};
  }
  return c;
}

/// Volume of a trilinear hexahedron from three triple products (Grandy 1997, the form that is symmetric in the
/// corners).
double volume(const Corners& c) {
  const auto d = [&c](int a, int b) { return minus(c[a], c[b]); };
  const auto triple = [](const Vector& a, const Vector& b, const Vector& e) { return dot(a, cross(b, e)); };
  return (triple(plus(d(3, 1), d(7, 2)), d(6, 3), d(2, 0)) + triple(plus(d(4, 3), d(5, 7)), d(6, 4), d(7, 0)) +
          triple(plus(d(1, 4), d(2, 5)), d(6, 1), d(5, 0))) /
         12;
}

double largest_face(const Corners& c) {
  double largest = 0;
  for (const auto& f : faces)
    largest = std::max(largest, 0.5 * norm(cross(minus(c[f[2]], c[f[0]]), minus(c[f[3]], c[f[1]]))));
  return largest;
}

}  // namespace

MeshQuality measure_quality(const continuum::HexMesh& mesh) {
  MeshQuality quality;
  quality.smallest_edge = quality.smallest_height = std::numeric_limits<double>::max();
  for (std::size_t e = 0; e < mesh.elements.size() / 8; ++e) {
    const Corners c = corners_of(mesh, e);
    double shortest = std::numeric_limits<double>::max(), longest = 0;
    for (const auto& [a, b] : edges) {
      const double length = norm(minus(c[a], c[b]));
      shortest = std::min(shortest, length);
      longest = std::max(longest, length);
    }
    quality.smallest_edge = std::min(quality.smallest_edge, shortest);
    quality.greatest_aspect = std::max(quality.greatest_aspect, longest / shortest);
    for (int k = 0; k < 8; ++k) {
      const Vector a = minus(c[neighbours[k][0]], c[k]), b = minus(c[neighbours[k][1]], c[k]),
                   d = minus(c[neighbours[k][2]], c[k]);
      quality.least_scaled_jacobian =
          std::min(quality.least_scaled_jacobian, dot(cross(a, b), d) / (norm(a) * norm(b) * norm(d)));
    }
    const double element_volume = volume(c);
    quality.smallest_height = std::min(quality.smallest_height, element_volume / largest_face(c));
  }
  quality.volume = mesh_volume(mesh);
  return quality;
}

double mesh_volume(const continuum::HexMesh& mesh) {
  // Compensated (Neumaier): a wall is sought until this sum agrees with a mass to rounding.
  double sum = 0, lost = 0;
  for (std::size_t e = 0; e < mesh.elements.size() / 8; ++e) {
    const double term = volume(corners_of(mesh, e)), next = sum + term;
    lost += std::abs(sum) >= std::abs(term) ? (sum - next) + term : (term - next) + sum;
    sum = next;
  }
  return sum + lost;
}

}  // namespace polynya::geometry
