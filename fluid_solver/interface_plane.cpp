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

double square(double x) {
  return x * x;
}

/// Value and slope.
struct Curve {
  double value, slope;
};

/// The volume below m . x = a is a difference of cubes in each of m1, m2, m3, over 6 m1 m2 m3. Here the differences are
/// divided out by m1 and m2, which may be as small as they like.
Curve first_difference(double m1, double t) {  // (t+^3 - (t - m1)+^3) / m1
  if (t <= 0) return {0.0, 0.0};
  if (t < m1) return {square(t) * (t / m1), 3.0 * t * (t / m1)};
  return {3.0 * t * (t - m1) + square(m1), 6.0 * t - 3.0 * m1};
}
Curve second_difference(double m1, double m2, double t) {
  if (t >= m1 + m2) return {6.0 * t - 3.0 * (m1 + m2), 6.0};
  const Curve here = first_difference(m1, t), before = first_difference(m1, t - m2);
  if (here.value == 0) return {0.0, 0.0};
  return {(here.value - before.value) / m2, (here.slope - before.slope) / m2};
}

/// Volume below m . x = a for ascending m that sum to 1, with the area of the cut.
Curve lower_volume(const std::array<double, 3>& m, double a) {
  const Curve here = second_difference(m[0], m[1], a), before = second_difference(m[0], m[1], a - m[2]);
  return {(here.value - before.value) / (6.0 * m[2]), (here.slope - before.slope) / (6.0 * m[2])};
}

/// Offset that cuts off the volume v <= 1/2: closed forms where the cut is a triangle or nearly so, as a first guess
/// elsewhere the plane that cuts no edge; the volume is convex up to 1/2, so Newton's steps stay on one side.
double lower_offset(const std::array<double, 3>& m, double v) {
  if (!(v > 0)) return 0;
  const auto [m1, m2, m3] = m;
  double low = 0, high = 0.5, a = 0;
  if (6.0 * m2 * m3 * v < square(m1))
    a = std::cbrt(6.0 * m1 * m2 * m3 * v);
  else
    a = std::min({0.5, m3 * v + 0.5 * (m1 + m2), 0.5 * (m1 + std::sqrt(8.0 * m2 * m3 * v))});
  for (int iteration = 0; iteration < 60; ++iteration) {
    const Curve here = lower_volume(m, a);
    const double miss = here.value - v;
    if (std::abs(miss) <= 2e-16 * v) break;
    (miss > 0 ? high : low) = a;
    double next = here.slope > 0 ? a - miss / here.slope : 0.5 * (low + high);
    if (!(next >= low && next <= high)) next = 0.5 * (low + high);
    if (std::abs(next - a) <= 1e-16 * a) break;
    a = next;
  }
  return a;
}

double below(const Standard& s, double offset) {
  const double a = std::clamp((offset + s.shift) / s.sum, 0.0, 1.0);
  return a <= 0.5 ? lower_volume(s.m, a).value : 1.0 - lower_volume(s.m, 1.0 - a).value;
}

}  // namespace

double fraction_below(const InterfacePlane& plane) {
  return below(standard(plane.normal), plane.offset);
}

double offset_for(const std::array<double, 3>& normal, double fraction) {
  const Standard s = standard(normal);
  const double a = lower_offset(s.m, std::min(fraction, 1.0 - fraction));
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

constexpr int stride(int axis) {
  return axis == 0 ? 1 : axis == 1 ? 3 : 9;
}
constexpr int centre = 13;

double span(const Widths& width, int axis) {
  return width[axis][1] + 0.5 * (width[axis][0] + width[axis][2]);
}

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
  const auto height = [&](int c) {
    return f[c - s] * width[axis][0] + f[c] * width[axis][1] + f[c + s] * width[axis][2];
  };
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
  int equal = 0;
  for (int axis = 0; axis < 3; ++axis) {
    std::array<double, 3> heights = of_heights(fraction, width, axis);
    normalise(heights, width);
    const double own = std::abs(heights[axis]), tie = 1e-9;  // equal but for rounding: no axis goes before another
    if (own < steepest - tie) continue;
    const bool ahead = own > steepest + tie;
    equal = ahead ? 1 : equal + 1;
    for (int d = 0; d < 3; ++d) best[d] = ahead ? heights[d] : best[d] + heights[d];
    steepest = std::max(own, steepest);
  }
  if (equal > 1) {
    const double sum = std::abs(best[0]) + std::abs(best[1]) + std::abs(best[2]);
    for (double& component : best) component /= sum > 0 ? sum : 1.0;
    if (!(sum > 0)) best = smooth;
  }
  const double largest = std::max({std::abs(smooth[0]), std::abs(smooth[1]), std::abs(smooth[2])});
  const std::array<double, 3>& chosen = steepest > largest ? smooth : best;
  return {-chosen[0], -chosen[1], -chosen[2]};
}

}  // namespace polynya::fluid
