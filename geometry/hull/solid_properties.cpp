#include "geometry/hull/solid_properties.hpp"

#include <algorithm>

namespace polynya::geometry {
namespace {

Point middle_of(const std::vector<Point>& points) {
  Point low = points.front(), high = points.front();
  for (const Point& p : points)
    for (std::size_t d = 0; d < 3; ++d) low[d] = std::min(low[d], p[d]), high[d] = std::max(high[d], p[d]);
  return {0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1]), 0.5 * (low[2] + high[2])};
}

}  // namespace

SolidProperties solid_properties(const TriangleSoup& surface) {
  const Point origin = middle_of(surface.points);
  double volume = 0, first[3]{}, second[3][3]{};
  for (const Triangle& triangle : surface.triangles) {
    Point p[3];
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t d = 0; d < 3; ++d) p[c][d] = surface.points[triangle[c]][d] - origin[d];
    const double six = p[0][0] * (p[1][1] * p[2][2] - p[1][2] * p[2][1]) +
                       p[0][1] * (p[1][2] * p[2][0] - p[1][0] * p[2][2]) +
                       p[0][2] * (p[1][0] * p[2][1] - p[1][1] * p[2][0]);
    volume += six / 6;
    double sum[3];
    for (std::size_t d = 0; d < 3; ++d) sum[d] = p[0][d] + p[1][d] + p[2][d], first[d] += six / 24 * sum[d];
    // The mean of x y over a tetrahedron with a corner at the origin: (sum of corners x y + product of sums) / 20.
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        second[i][j] += six / 120 * (p[0][i] * p[0][j] + p[1][i] * p[1][j] + p[2][i] * p[2][j] + sum[i] * sum[j]);
  }
  SolidProperties solid;
  solid.volume = volume;
  double centre[3], trace = 0;
  for (std::size_t d = 0; d < 3; ++d) centre[d] = first[d] / volume, solid.centre[d] = origin[d] + centre[d];
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) second[i][j] -= volume * centre[i] * centre[j];
  for (std::size_t i = 0; i < 3; ++i) trace += second[i][i];
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) solid.inertia[i][j] = (i == j ? trace : 0) - second[i][j];
  return solid;
}

}  // namespace polynya::geometry
