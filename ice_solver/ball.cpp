#include "ice_solver/ball.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>

namespace polynya::ice {
namespace {

using Index = std::array<int, 3>;
using Point = std::array<double, 3>;

constexpr double core_share = 0.5;  // of the radius: half the edge of the core
constexpr double bulge = 0.35;      // of the way from the cube to the sphere that the core's faces go

int largest(const Index& i) {
  return std::max({std::abs(i[0]), std::abs(i[1]), std::abs(i[2])});
}

/// A lattice point: |i|, |j|, |k| <= n in the core; beyond, layer l holds the points with largest |.| = n of the
/// core's surface moved outward, kept apart by l.
class Numbering {
 public:
  Numbering(double radius, double centre, int divisions, int layers)
      : radius_(radius), centre_(centre), n_(divisions), layers_(layers) {}

  std::int32_t node(const Index& i, int layer) {
    const auto [found, is_new] = numbers_.try_emplace({i[0], i[1], i[2], layer}, static_cast<int>(numbers_.size()));
    if (is_new) {
      const Point p = place(i, layer);
      mesh.nodes.insert(mesh.nodes.end(), {p[0], p[1], p[2] + centre_});
    }
    return found->second;
  }

  continuum::HexMesh mesh;

 private:
  /// On the sphere of the radius 1, in the direction of a lattice point with even angles along the cube's faces.
  Point direction(const Index& i) const {
    Point p;
    const int m = largest(i);
    double square = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      p[c] = m == 0 ? 0 : std::tan(0.25 * std::numbers::pi * i[c] / m);
      square += p[c] * p[c];
    }
    for (double& x : p) x /= m == 0 ? 1 : std::sqrt(square);
    return p;
  }
  Point place(const Index& i, int layer) const {
    const Point round = direction(i);
    const double depth = static_cast<double>(largest(i)) / n_, core = core_share * radius_;
    const double share = static_cast<double>(layer) / layers_;
    Point p;
    for (std::size_t c = 0; c < 3; ++c) {
      const double flat = core * i[c] / n_;
      // The bulge grows with the square of the distance from the centre: the innermost elements stay cubes.
      const double inside = flat + bulge * depth * depth * (core * 1.3 * depth * round[c] - flat);
      p[c] = (1 - share) * inside + share * radius_ * round[c];
    }
    return p;
  }

  double radius_, centre_;
  int n_, layers_;
  std::map<std::array<int, 4>, std::int32_t> numbers_;
};

/// The element between two quadrilaterals; turned where its axes are left-handed.
void add_element(Numbering& nodes, const std::array<Index, 8>& corner, const std::array<int, 8>& layer) {
  std::array<std::int32_t, 8> element;
  std::array<Point, 8> at;
  for (std::size_t a = 0; a < 8; ++a) {
    element[a] = nodes.node(corner[a], layer[a]);
    for (std::size_t c = 0; c < 3; ++c) at[a][c] = nodes.mesh.nodes[3 * static_cast<std::size_t>(element[a]) + c];
  }
  const auto edge = [&](std::size_t to) {
    return Point{at[to][0] - at[0][0], at[to][1] - at[0][1], at[to][2] - at[0][2]};
  };
  const Point u = edge(1), v = edge(3), w = edge(4);
  const double triple =
      w[0] * (u[1] * v[2] - u[2] * v[1]) + w[1] * (u[2] * v[0] - u[0] * v[2]) + w[2] * (u[0] * v[1] - u[1] * v[0]);
  if (triple < 0)
    for (std::size_t a = 0; a < 4; ++a) std::swap(element[a], element[a + 4]);
  nodes.mesh.elements.insert(nodes.mesh.elements.end(), element.begin(), element.end());
}

}  // namespace

continuum::HexMesh ball_mesh(double radius, double size, double centre, SymmetryPlanes planes) {
  if (!(radius > 0) || !(size > 0)) throw std::invalid_argument("a ball needs a radius and elements above 0");
  const int n = std::max(2, static_cast<int>(std::lround(0.25 * std::numbers::pi * radius * 0.8 / size)));
  const int layers = std::max(2, static_cast<int>(std::lround((1 - core_share) * 0.9 * radius / size)));
  Numbering nodes(radius, centre, n, layers);
  const Index low{planes.x ? 0 : -n, planes.y ? 0 : -n, -n};
  for (int j = low[1]; j < n; ++j)
    for (int i = low[0]; i < n; ++i)
      for (int k = low[2]; k < n; ++k)
        add_element(nodes,
                    {{{i, j, k},
                      {i + 1, j, k},
                      {i + 1, j + 1, k},
                      {i, j + 1, k},
                      {i, j, k + 1},
                      {i + 1, j, k + 1},
                      {i + 1, j + 1, k + 1},
                      {i, j + 1, k + 1}}},
                    {});
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const int side : {-n, n}) {
      const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
      if (side < low[axis]) continue;
      for (int a = low[u]; a < n; ++a)
        for (int b = low[v]; b < n; ++b)
          for (int layer = 0; layer < layers; ++layer) {
            std::array<Index, 8> corner;
            for (std::size_t q = 0; q < 8; ++q) {
              corner[q][axis] = side;
              corner[q][u] = a + (q % 4 == 1 || q % 4 == 2 ? 1 : 0);
              corner[q][v] = b + (q % 4 >= 2 ? 1 : 0);
            }
            add_element(nodes, corner, {layer, layer, layer, layer, layer + 1, layer + 1, layer + 1, layer + 1});
          }
    }
  return std::move(nodes.mesh);
}

}  // namespace polynya::ice
