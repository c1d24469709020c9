#pragma once
#include <array>
#include <cmath>

#include "ice_solver/points.hpp"

namespace polynya::ice::testing {

/// A block of nx * ny * nz points of ice at rest, in a cubic lattice whose first cell begins at `corner`.
inline Points lattice(std::array<int, 3> number, double spacing, std::array<double, 3> corner, double density = 900) {
  Points points;
  points.resize(static_cast<std::size_t>(number[0]) * number[1] * number[2]);
  std::size_t i = 0;
  for (int c = 0; c < number[2]; ++c)
    for (int b = 0; b < number[1]; ++b)
      for (int a = 0; a < number[0]; ++a, ++i) {
        points.position[3 * i] = corner[0] + (a + 0.5) * spacing;
        points.position[3 * i + 1] = corner[1] + (b + 0.5) * spacing;
        points.position[3 * i + 2] = corner[2] + (c + 0.5) * spacing;
        points.density[i] = density;
        points.mass[i] = density * spacing * spacing * spacing;
        points.smoothing_length[i] = 1.2 * spacing;
      }
  return points;
}

/// Numbers in [-1, 1] that are the same on every machine.
class Noise {
 public:
  double operator()() {
    state_ = state_ * 6364136223846793005ull + 1442695040888963407ull;
    return static_cast<double>(state_ >> 11) / 4503599627370496.0 - 1.0;
  }

 private:
  unsigned long long state_ = 42;
};

/// Displaces, stresses and moves the points at random.
inline void disturb(Points& points, Noise& noise, double displacement) {
  for (double& x : points.position) x += displacement * noise();
  for (double& v : points.velocity) v = 10 * noise();
  for (double& s : points.stress) s = 1e6 * noise();
}

}  // namespace polynya::ice::testing
