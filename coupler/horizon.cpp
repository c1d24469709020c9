#include "coupler/horizon.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace polynya::coupler {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double share_of_gap = 0.5;

/// Along one axis: where a surface ends, contact radii included, and how fast it moves at most either way.
struct Extent {
  double low = infinity, high = -infinity;         ///< m
  double slowest = infinity, fastest = -infinity;  ///< m/s, of any vertex
};

Extent extent_of(const SolidSide& side, std::size_t axis) {
  Extent e;
  for (std::size_t v = 0; v < side.vertices(); ++v) {
    const double x = side.positions[3 * v + axis], u = side.velocities[3 * v + axis];
    e.low = std::min(e.low, x - side.radii[v]);
    e.high = std::max(e.high, x + side.radii[v]);
    e.slowest = std::min(e.slowest, u);
    e.fastest = std::max(e.fastest, u);
  }
  return e;
}

/// Smallest t >= 0 with u t + a t^2 / 2 = way, way > 0.
double time_for(double way, double u, double a) {
  if (a <= 0) return u > 0 ? way / u : infinity;
  // The root without cancellation for either sign of u.
  const double root = std::sqrt(u * u + 2 * a * way);
  return u > 0 ? 2 * way / (root + u) : (root - u) / a;
}

}  // namespace

double time_apart(const SolidSide& one, const SolidSide& other, double acceleration) {
  double longest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Extent a = extent_of(one, axis), b = extent_of(other, axis);
    if (b.low > a.high)
      longest = std::max(longest, time_for(share_of_gap * (b.low - a.high), a.fastest - b.slowest, acceleration));
    if (a.low > b.high)
      longest = std::max(longest, time_for(share_of_gap * (a.low - b.high), b.fastest - a.slowest, acceleration));
  }
  return longest;
}

}  // namespace polynya::coupler
