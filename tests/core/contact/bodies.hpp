#pragma once
#include <array>
#include <cstdint>
#include <numeric>
#include <vector>

#include "core/contact/penalty_contact.hpp"

namespace polynya::contact::testing {

/// A body of mass points with a surface, moved by its forces alone.
struct Mesh {
  std::vector<double> positions, velocities, masses, radii;
  std::vector<std::int64_t> ids;
  std::vector<std::int32_t> triangles;

  Body body() const { return {positions, velocities, masses, radii, ids, triangles}; }
  std::size_t count() const { return masses.size(); }

  std::size_t add_point(const Vector3& x, const Vector3& v, double mass, double radius = 0) {
    for (std::size_t d = 0; d < 3; ++d) {
      positions.push_back(x[d]);
      velocities.push_back(v[d]);
    }
    masses.push_back(mass);
    radii.push_back(radius);
    ids.push_back(static_cast<std::int64_t>(ids.size()));
    return masses.size() - 1;
  }
  void set_velocity(const Vector3& v) {
    for (std::size_t k = 0; k < velocities.size(); ++k) velocities[k] = v[k % 3];
  }
  void move(const Vector3& d) {
    for (std::size_t k = 0; k < positions.size(); ++k) positions[k] += d[k % 3];
  }
  void drift(double dt) {
    for (std::size_t k = 0; k < positions.size(); ++k) positions[k] += dt * velocities[k];
  }
  Vector3 momentum() const {
    Vector3 sum{};
    for (std::size_t i = 0; i < count(); ++i) sum = sum + masses[i] * row(velocities, i);
    return sum;
  }
};

/// Square facing up at z = height, of 2 n^2 triangles, too heavy to move.
inline Mesh floor_of(double half_width = 1, int n = 1, double height = 0) {
  Mesh mesh;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      mesh.add_point({half_width * (2.0 * i / n - 1), half_width * (2.0 * j / n - 1), height}, {}, 1e15);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const std::int32_t a = i + (n + 1) * j, b = a + 1, c = b + n + 1, d = a + n + 1;
      mesh.triangles.insert(mesh.triangles.end(), {a, b, c, a, c, d});
    }
  return mesh;
}

/// Closed box [low, high] with n x n squares per face; masses equal.
inline Mesh box_of(const Vector3& low, const Vector3& high, int n, double mass) {
  Mesh mesh;
  std::vector<std::int32_t> number(static_cast<std::size_t>((n + 1) * (n + 1) * (n + 1)), -1);
  const auto vertex = [&](std::array<int, 3> i) {
    std::int32_t& v = number[static_cast<std::size_t>(i[0] + (n + 1) * (i[1] + (n + 1) * i[2]))];
    if (v < 0) {
      Vector3 x;
      for (std::size_t d = 0; d < 3; ++d) x[d] = low[d] + (high[d] - low[d]) * i[d] / n;
      v = static_cast<std::int32_t>(mesh.add_point(x, {}, 1));
    }
    return v;
  };
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side)
      for (int b = 0; b < n; ++b)
        for (int a = 0; a < n; ++a) {
          const auto at = [&](int da, int db) {
            std::array<int, 3> i;
            i[axis] = side * n;
            i[(axis + 1) % 3] = a + da;
            i[(axis + 2) % 3] = b + db;
            return vertex(i);
          };
          const std::int32_t p = at(0, 0), q = at(1, 0), r = at(1, 1), s = at(0, 1);
          if (side == 1)
            mesh.triangles.insert(mesh.triangles.end(), {p, q, r, p, r, s});
          else
            mesh.triangles.insert(mesh.triangles.end(), {p, r, q, p, s, r});
        }
  mesh.masses.assign(mesh.count(), mass / static_cast<double>(mesh.count()));
  return mesh;
}

/// One point, to be the secondary body.
inline Mesh point_at(const Vector3& x, const Vector3& v, double mass = 1, double radius = 0) {
  Mesh mesh;
  mesh.add_point(x, v, mass, radius);
  return mesh;
}

/// Velocities after forces ([n][3], N) acted for dt, all bodies under gravity as well.
inline void kick(Mesh& mesh, const std::vector<double>& forces, double dt, const Vector3& gravity = {}) {
  for (std::size_t k = 0; k < mesh.velocities.size(); ++k)
    mesh.velocities[k] += dt * (forces[k] / mesh.masses[k / 3] + gravity[k % 3]);
}

/// A single mass with the surface of a mesh: all its vertices move as one.
inline void kick_as_one(Mesh& mesh, const std::vector<double>& forces, double dt, const Vector3& gravity = {}) {
  Vector3 sum{};
  double mass = 0;
  for (std::size_t i = 0; i < mesh.count(); ++i) sum = sum + row(forces, i), mass += mesh.masses[i];
  for (std::size_t k = 0; k < mesh.velocities.size(); ++k)
    mesh.velocities[k] += dt * (sum[k % 3] / mass + gravity[k % 3]);
}

}  // namespace polynya::contact::testing
