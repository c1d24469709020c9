#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <random>
#include <vector>

#include "geometry/cut_cells.hpp"

/// Closed surfaces with outward triangles, and grids, for the tests of the cut.
namespace shapes {

using Vector = std::array<double, 3>;

struct Shape {
  std::vector<double> positions, velocities;
  std::vector<std::int32_t> triangles;

  polynya::geometry::BodySurface surface() const { return {positions, velocities, triangles}; }
  std::size_t vertices() const { return positions.size() / 3; }
  Vector vertex(std::int32_t v) const {
    const auto at = 3 * static_cast<std::size_t>(v);
    return {positions[at], positions[at + 1], positions[at + 2]};
  }
  void rest() { velocities.assign(positions.size(), 0.0); }
  template <class Map>
  void transform(Map&& map) {
    for (std::size_t v = 0; v < vertices(); ++v) {
      const Vector moved = map(vertex(static_cast<std::int32_t>(v)));
      for (std::size_t d = 0; d < 3; ++d) positions[3 * v + d] = moved[d];
    }
  }
};

inline std::int32_t add_vertex(Shape& shape, const Vector& p) {
  shape.positions.insert(shape.positions.end(), p.begin(), p.end());
  return static_cast<std::int32_t>(shape.vertices()) - 1;
}

/// Icosahedron divided `levels` times, vertices on the sphere of radius 1.
inline Shape sphere(int levels) {
  Shape s;
  const double g = (1.0 + std::sqrt(5.0)) / 2.0;
  for (const Vector& p : std::vector<Vector>{{-1, g, 0},
                                             {1, g, 0},
                                             {-1, -g, 0},
                                             {1, -g, 0},
                                             {0, -1, g},
                                             {0, 1, g},
                                             {0, -1, -g},
                                             {0, 1, -g},
                                             {g, 0, -1},
                                             {g, 0, 1},
                                             {-g, 0, -1},
                                             {-g, 0, 1}})
    add_vertex(s, p);
  s.triangles = {0, 11, 5, 0, 5, 1, 0, 1, 7, 0, 7, 10, 0, 10, 11, 1, 5, 9, 5, 11, 4,  11, 10, 2,  10, 7, 6, 7, 1, 8,
                 3, 9,  4, 3, 4, 2, 3, 2, 6, 3, 6, 8,  3, 8,  9,  4, 9, 5, 2, 4,  11, 6,  2,  10, 8,  6, 7, 9, 8, 1};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles;
    const auto middle = [&](std::int32_t a, std::int32_t b) {
      const auto [at, fresh] = middles.try_emplace({std::min(a, b), std::max(a, b)}, 0);
      if (fresh) {
        const Vector p = s.vertex(a), q = s.vertex(b);
        at->second = add_vertex(s, {(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2});
      }
      return at->second;
    };
    std::vector<std::int32_t> finer;
    for (std::size_t t = 0; t < s.triangles.size(); t += 3) {
      const std::int32_t a = s.triangles[t], b = s.triangles[t + 1], c = s.triangles[t + 2];
      const std::int32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {a, ab, ca, b, bc, ab, c, ca, bc, ab, bc, ca});
    }
    s.triangles = finer;
  }
  s.transform([](Vector p) {
    const double r = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    return Vector{p[0] / r, p[1] / r, p[2] / r};
  });
  s.rest();
  return s;
}

/// Cylinder of radius 1 between z = -1 and z = 1 with `sides` sides and fans as ends.
inline Shape cylinder(int sides) {
  Shape s;
  const std::int32_t bottom = add_vertex(s, {0, 0, -1}), top = add_vertex(s, {0, 0, 1});
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * M_PI * i / sides;
    add_vertex(s, {std::cos(angle), std::sin(angle), -1});
    add_vertex(s, {std::cos(angle), std::sin(angle), 1});
  }
  for (int i = 0; i < sides; ++i) {
    const std::int32_t a = 2 + 2 * i, b = 2 + 2 * ((i + 1) % sides);
    s.triangles.insert(s.triangles.end(), {bottom, b, a, top, a + 1, b + 1, a, b, b + 1, a, b + 1, a + 1});
  }
  s.rest();
  return s;
}

/// Box from (-1,-1,-1) to (1,1,1), n x n squares per side.
inline Shape box(int n = 1) {
  Shape s;
  std::map<std::array<int, 3>, std::int32_t> ids;
  const auto id = [&](std::array<int, 3> p) {
    const auto [at, fresh] = ids.try_emplace(p, 0);
    if (fresh) at->second = add_vertex(s, {2.0 * p[0] / n - 1, 2.0 * p[1] / n - 1, 2.0 * p[2] / n - 1});
    return at->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (int side : {0, 1})
      for (int u = 0; u < n; ++u)
        for (int v = 0; v < n; ++v) {
          const auto at = [&](int du, int dv) {
            std::array<int, 3> p{};
            p[axis] = side * n, p[(axis + 1) % 3] = u + du, p[(axis + 2) % 3] = v + dv;
            return id(p);
          };
          const std::int32_t a = at(0, 0), b = at(1, 0), c = at(1, 1), d = at(0, 1);
          if (side == 1)
            s.triangles.insert(s.triangles.end(), {a, b, c, a, c, d});
          else
            s.triangles.insert(s.triangles.end(), {a, c, b, a, d, c});
        }
  s.rest();
  return s;
}

/// Volume of the polyhedron by the divergence theorem.
inline double volume(const Shape& s) {
  double six = 0;
  for (std::size_t t = 0; t < s.triangles.size(); t += 3) {
    const Vector a = s.vertex(s.triangles[t]), b = s.vertex(s.triangles[t + 1]), c = s.vertex(s.triangles[t + 2]);
    six += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return six / 6;
}

inline void scale_and_move(Shape& s, const Vector& scale, const Vector& shift) {
  s.transform([&](Vector p) {
    return Vector{scale[0] * p[0] + shift[0], scale[1] * p[1] + shift[1], scale[2] * p[2] + shift[2]};
  });
}

/// Uniformly distributed rotation.
inline void rotate_randomly(Shape& s, std::mt19937& random) {
  std::normal_distribution<double> normal;
  std::array<double, 4> q{normal(random), normal(random), normal(random), normal(random)};
  const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  for (double& value : q) value /= length;
  const auto [w, x, y, z] = q;
  s.transform([&](Vector p) {
    return Vector{(1 - 2 * (y * y + z * z)) * p[0] + 2 * (x * y - w * z) * p[1] + 2 * (x * z + w * y) * p[2],
                  2 * (x * y + w * z) * p[0] + (1 - 2 * (x * x + z * z)) * p[1] + 2 * (y * z - w * x) * p[2],
                  2 * (x * z - w * y) * p[0] + 2 * (y * z + w * x) * p[1] + (1 - 2 * (x * x + y * y)) * p[2]};
  });
}

/// Lines from `low` to `high`; growth is the ratio of neighbouring widths.
inline std::vector<double> lines(double low, double high, int cells, double growth = 1.0) {
  std::vector<double> line{0.0};
  double width = 1.0;
  for (int i = 0; i < cells; ++i, width *= growth) line.push_back(line.back() + width);
  const double length = line.back();
  for (double& x : line) x = low + (high - low) * (x / length);
  return line;
}

inline polynya::geometry::GridLines cube_grid(double half, int cells) {
  return {{lines(-half, half, cells), lines(-half, half, cells), lines(-half, half, cells)}};
}

}  // namespace shapes
