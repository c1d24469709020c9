#include "geometry/hull/simple_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "geometry/hull/solid_properties.hpp"

namespace polynya::geometry {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int fewest_per_quarter = 4, most_per_quarter = 400;

int pieces_of_quarter(double radius, double edge) {
  const double wanted = std::ceil(0.5 * pi * radius / edge);
  return static_cast<int>(std::clamp(wanted, double{fewest_per_quarter}, double{most_per_quarter}));
}

}  // namespace

TriangleSoup sphere_surface(double diameter, double edge) {
  const int n = pieces_of_quarter(0.5 * diameter, edge);
  TriangleSoup surface;
  std::map<std::array<int, 3>, std::size_t> numbers;
  // The faces of the octahedron |x| + |y| + |z| = n, its lattice points moved out to the sphere.
  const auto point = [&](int x, int y, int z) {
    const auto [found, fresh] = numbers.try_emplace({x, y, z}, surface.points.size());
    if (fresh) {
      // Equal angles along the octahedron's edges: triangles of nearly one size.
      Point p;
      const std::array<int, 3> lattice{x, y, z};
      for (std::size_t d = 0; d < 3; ++d) p[d] = std::sin(0.5 * pi * lattice[d] / n);
      const double length = std::hypot(p[0], p[1], p[2]);
      for (double& c : p) c *= 0.5 * diameter / length;
      surface.points.push_back(p);
    }
    return found->second;
  };
  for (const int sx : {-1, 1})
    for (const int sy : {-1, 1})
      for (const int sz : {-1, 1})
        for (int a = 0; a < n; ++a)
          for (int b = 0; a + b < n; ++b) {
            const auto at = [&](int i, int j) { return point(sx * i, sy * j, sz * (n - i - j)); };
            const bool turned = sx * sy * sz < 0;
            const auto add = [&](std::size_t p, std::size_t q, std::size_t r) {
              surface.triangles.push_back(turned ? Triangle{p, r, q} : Triangle{p, q, r});
            };
            add(at(a, b), at(a + 1, b), at(a, b + 1));
            if (a + b + 1 < n) add(at(a + 1, b), at(a + 1, b + 1), at(a, b + 1));
          }
  const double exact = pi / 6 * diameter * diameter * diameter;
  const double factor = std::cbrt(exact / solid_properties(surface).volume);
  for (Point& p : surface.points)
    for (double& c : p) c *= factor;
  return surface;
}

TriangleSoup cylinder_surface(double diameter, double height, double edge) {
  const int n = pieces_of_quarter(0.5 * diameter, edge), around = 4 * n;
  // The polygon has the area of the circle.
  const double radius = 0.5 * diameter * std::sqrt(2 * pi / around / std::sin(2 * pi / around));
  TriangleSoup surface;
  for (const double z : {-0.5 * height, 0.5 * height})
    for (int i = 0; i < around; ++i) {
      // From the first quarter, so that all four are mirror images to the last bit.
      const double angle = 0.5 * pi * (i % n) / n, c = radius * std::cos(angle),
                   s = i % n ? radius * std::sin(angle) : 0;
      const Point quarters[4]{{c, s, z}, {-s, c, z}, {-c, -s, z}, {s, -c, z}};
      surface.points.push_back(quarters[i / n]);
    }
  const auto m = static_cast<std::size_t>(around), below = 2 * m, above = 2 * m + 1;
  surface.points.push_back({0, 0, -0.5 * height});
  surface.points.push_back({0, 0, 0.5 * height});
  for (std::size_t i = 0; i < m; ++i) {
    const std::size_t j = (i + 1) % m;
    surface.triangles.insert(surface.triangles.end(),
                             {{i, j, m + j}, {i, m + j, m + i}, {below, j, i}, {above, m + i, m + j}});
  }
  return surface;
}

TriangleSoup box_surface(double length, double width, double height) {
  TriangleSoup surface;
  for (const double z : {-0.5 * height, 0.5 * height})
    for (const double y : {-0.5 * width, 0.5 * width})
      for (const double x : {-0.5 * length, 0.5 * length}) surface.points.push_back({x, y, z});
  surface.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                       {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return surface;
}

TriangleSoup wedge_surface(double length, double width, double height) {
  TriangleSoup surface;
  for (const double y : {-0.5 * width, 0.5 * width})
    surface.points.insert(surface.points.end(), {{0, y, 0}, {0.5 * length, y, height}, {-0.5 * length, y, height}});
  surface.triangles = {{0, 1, 2}, {3, 5, 4}, {0, 3, 4}, {0, 4, 1}, {0, 2, 5}, {0, 5, 3}, {1, 4, 5}, {1, 5, 2}};
  return surface;
}

}  // namespace polynya::geometry
