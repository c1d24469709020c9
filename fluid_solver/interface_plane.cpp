#include "fluid_solver/interface_plane.hpp"

#include <algorithm>
#include <cmath>

namespace polynya::fluid {
namespace {

/// Components of a normal with their signs taken off, sorted, summing to 1; the mirrored axes shift the offset.
struct Standard {
  std::array<double, 3> m{};  ///< ascending
  double sum = 0, shift = 0;  ///< of the absolute components; of the negative ones
};

Standard standard(const std::array<double, 3>& normal) {
  Standard s;
  for (int d = 0; d < 3; ++d) {
    s.m[d] = std::abs(normal[d]);
    s.sum += s.m[d];
    s.shift += std::max(0.0, -normal[d]);
  }
  for (double& m : s.m) m /= s.sum;
  if (s.m[0] > s.m[1]) std::swap(s.m[0], s.m[1]);
  if (s.m[1] > s.m[2]) std::swap(s.m[1], s.m[2]);
  if (s.m[0] > s.m[1]) std::swap(s.m[0], s.m[1]);
  return s;
}

constexpr double tiny = 1e-50;  // keeps quotients of vanishing components finite: their branch is then empty

double square(double x) { return x * x; }
double cube(double x) { return x * x * x; }

/// Volume below m . x = a for ascending m that sum to 1 and 0 <= a <= 1/2.
double lower_half(const std::array<double, 3>& m, double a) {
  const auto [m1, m2, m3] = m;
  const double m12 = m1 + m2, six = std::max(6.0 * m1 * m2 * m3, tiny);
  if (a < m1) return cube(a) / six;
  if (a < m2) return 0.5 * a * (a - m1) / (m2 * m3) + square(m1) / std::max(6.0 * m2 * m3, tiny);
  if (a < std::min(m12, m3)) return (square(a) * (3 * m12 - a) + square(m1) * (m1 - 3 * a) + square(m2) * (m2 - 3 * a)) / six;
  if (m12 < m3) return (a - 0.5 * m12) / m3;
  return (square(a) * (3 - 2 * a) + square(m1) * (m1 - 3 * a) + square(m2) * (m2 - 3 * a) + square(m3) * (m3 - 3 * a)) / six;
}

/// Middle root of the cubic whose depressed form has these coefficients.
double middle_root(double root_p, double q) {
  const double cosine = std::cos(std::acos(std::clamp(q, -1.0, 1.0)) / 3.0);
  return root_p * (std::sqrt(3.0 * std::max(0.0, 1.0 - square(cosine))) - cosine);
}

/// Inverse of lower_half by its branches, 0 <= v <= 1/2.
double inverse_lower_half(const std::array<double, 3>& m, double v) {
  const auto [m1, m2, m3] = m;
  const double m12 = m1 + m2, six = std::max(6.0 * m1 * m2 * m3, tiny);
  const double v1 = square(m1) / std::max(6.0 * m2 * m3, tiny), v2 = v1 + 0.5 * (m2 - m1) / m3;
  if (v < v1) return std::cbrt(six * v);
  if (v < v2) return 0.5 * (m1 + std::sqrt(square(m1) + 8.0 * m2 * m3 * (v - v1)));
  const double v3 = m3 < m12 ? (square(m3) * (3 * m12 - m3) + square(m1) * (m1 - 3 * m3) + square(m2) * (m2 - 3 * m3)) / six
                             : 0.5 * m12 / m3;
  if (v < v3) return middle_root(std::sqrt(2.0 * m1 * m2), 0.75 * (m12 - 2.0 * m3 * v) / std::sqrt(std::max(2.0 * m1 * m2, tiny))) + m12;
  if (m12 < m3) return m3 * v + 0.5 * m12;
  const double p = m1 * (m2 + m3) + m2 * m3 - 0.25;
  return middle_root(std::sqrt(p), 1.5 * m1 * m2 * m3 * (0.5 - v) / (p * std::sqrt(p))) + 0.5;
}

double below(const Standard& s, double offset) {
  const double a = std::clamp((offset + s.shift) / s.sum, 0.0, 1.0);
  return a <= 0.5 ? lower_half(s.m, a) : 1.0 - lower_half(s.m, 1.0 - a);
}

}  // namespace

double fraction_below(const InterfacePlane& plane) { return below(standard(plane.normal), plane.offset); }

double offset_for(const std::array<double, 3>& normal, double fraction) {
  const Standard s = standard(normal);
  const double part = std::min(fraction, 1.0 - fraction);
  // The closed form loses digits where branches meet; the volume grows with the offset, so a bracket and secants mend it.
  double low = 0, high = 0.5, a = std::clamp(inverse_lower_half(s.m, std::max(part, 0.0)), 0.0, 0.5);
  for (int iteration = 0; iteration < 60; ++iteration) {
    const double miss = lower_half(s.m, a) - part;
    if (std::abs(miss) <= 1e-15 * part) break;
    (miss > 0 ? high : low) = a;
    const double step = 1e-6 * (a > 0.25 ? -1.0 : 1.0), slope = (lower_half(s.m, a + step) - (miss + part)) / step;
    double next = slope > 0 ? a - miss / slope : 0.5 * (low + high);
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - a) <= 1e-16) break;
    a = next;
  }
  return (fraction <= 0.5 ? a : 1.0 - a) * s.sum - s.shift;
}

double fraction_of_slab(const InterfacePlane& plane, int axis, bool upper, double part) {
  InterfacePlane slab = plane;
  slab.normal[axis] *= part;
  if (upper) slab.offset -= plane.normal[axis] * (1.0 - part);
  return fraction_below(slab);
}

namespace {

using Widths = std::array<std::array<double, 3>, 3>;

constexpr int stride(int axis) { return axis == 0 ? 1 : axis == 1 ? 3 : 9; }
constexpr int centre = 13;

double span(const Widths& width, int axis) { return width[axis][1] + 0.5 * (width[axis][0] + width[axis][2]); }

/// Gradient of the fraction by Youngs' weights 1, 2, 1 across.
std::array<double, 3> youngs(const std::array<double, 27>& f, const Widths& width) {
  std::array<double, 3> gradient{};
  for (int axis = 0; axis < 3; ++axis) {
    const int s = stride(axis), t1 = stride((axis + 1) % 3), t2 = stride((axis + 2) % 3);
    double sum = 0;
    for (int a = -1; a <= 1; ++a) {
      for (int b = -1; b <= 1; ++b) {
        const int c = centre + a * t1 + b * t2;
        sum += (a == 0 ? 2 : 1) * (b == 0 ? 2 : 1) * (f[c + s] - f[c - s]);
      }
    }
    gradient[axis] = sum / (16.0 * span(width, axis));
  }
  return gradient;
}

/// Gradient direction if the interface is a height over the plane across `axis`: central differences of column heights.
std::array<double, 3> of_heights(const std::array<double, 27>& f, const Widths& width, int axis) {
  const int s = stride(axis), t1 = stride((axis + 1) % 3), t2 = stride((axis + 2) % 3);
  const auto height = [&](int c) { return f[c - s] * width[axis][0] + f[c] * width[axis][1] + f[c + s] * width[axis][2]; };
  const auto layer = [&](int c) { return f[c] + f[c + t1] + f[c - t1] + f[c + t2] + f[c - t2]; };
  std::array<double, 3> gradient{};
  gradient[axis] = layer(centre + s) >= layer(centre - s) ? 1.0 : -1.0;
  gradient[(axis + 1) % 3] = (height(centre + t1) - height(centre - t1)) / span(width, (axis + 1) % 3);
  gradient[(axis + 2) % 3] = (height(centre + t2) - height(centre - t2)) / span(width, (axis + 2) % 3);
  return gradient;
}

/// In units of the cell's widths and with absolute components that sum to 1.
bool normalise(std::array<double, 3>& n, const Widths& width) {
  double sum = 0;
  for (int d = 0; d < 3; ++d) sum += std::abs(n[d] *= width[d][1]);
  if (!(sum > 0)) return false;
  for (double& component : n) component /= sum;
  return true;
}

}  // namespace

std::array<double, 3> interface_normal(const std::array<double, 27>& fraction, const Widths& width) {
  std::array<double, 3> smooth = youngs(fraction, width);
  if (!normalise(smooth, width)) return {};
  std::array<double, 3> best{};
  double steepest = -1;
  for (int axis = 0; axis < 3; ++axis) {
    std::array<double, 3> heights = of_heights(fraction, width, axis);
    normalise(heights, width);
    if (std::abs(heights[axis]) <= steepest) continue;
    steepest = std::abs(heights[axis]);
    best = heights;
  }
  const double largest = std::max({std::abs(smooth[0]), std::abs(smooth[1]), std::abs(smooth[2])});
  const std::array<double, 3>& chosen = steepest > largest ? smooth : best;
  return {-chosen[0], -chosen[1], -chosen[2]};
}

}  // namespace polynya::fluid
