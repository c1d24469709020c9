#pragma once
#include <experimental/simd>
#include <numbers>

namespace polynya::ice {

/// Cubic spline of support 2h, normalised by 1/(pi h^3) in three dimensions (Monaghan & Lattanzio 1985), with
/// q = r/h:  W = ((2-q)^3 - 4 (1-q)^3) / (4 pi h^3), each bracket cut off at zero.
inline double kernel(double distance, double smoothing_length) {
  const double q = distance / smoothing_length;
  const double outer = q < 2 ? 2 - q : 0.0, inner = q < 1 ? 1 - q : 0.0;
  return (outer * outer * outer - 4 * inner * inner * inner) /
         (4 * std::numbers::pi * smoothing_length * smoothing_length * smoothing_length);
}

/// (dW/dr)/r in m^-5 for scalars or packs; grad_i W(x_i - x_j) is this times (x_i - x_j). Zero from 2h on. The distance
/// must not be zero.
template <class Number>
Number kernel_gradient_over_distance(Number distance, Number smoothing_length) {
  using std::max;
  using std::experimental::max;
  const Number q = distance / smoothing_length;
  const Number outer = max(Number(2.0) - q, Number(0.0)), inner = max(Number(1.0) - q, Number(0.0));
  const Number square = smoothing_length * smoothing_length;
  return Number(-0.75 / std::numbers::pi) * (outer * outer - Number(4.0) * inner * inner) /
         (square * square * distance);
}

}  // namespace polynya::ice
