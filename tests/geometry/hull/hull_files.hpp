#pragma once
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "geometry/hull/triangle_soup.hpp"
#include "tests/geometry/shapes.hpp"

/// Surfaces as files, and integrals over their inside by another way than the program's.
namespace hull_files {

using polynya::geometry::Point;

inline std::string path_of(const std::string& name) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "polynya_hull" /
                      testing::UnitTest::GetInstance()->current_test_info()->name();
  std::filesystem::create_directories(folder);
  return folder / name;
}

inline std::string write_binary_stl(const std::string& name, const shapes::Shape& shape) {
  const std::string path = path_of(name);
  std::ofstream file(path, std::ios::binary);
  file << std::string(80, ' ');
  const auto count = static_cast<std::uint32_t>(shape.triangles.size() / 3);
  file.write(reinterpret_cast<const char*>(&count), 4);
  for (std::size_t t = 0; t < shape.triangles.size(); t += 3) {
    float values[12]{};
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t d = 0; d < 3; ++d)
        values[3 + 3 * c + d] = static_cast<float>(shape.vertex(shape.triangles[t + c])[d]);
    file.write(reinterpret_cast<const char*>(values), sizeof values);
    file.write("\0\0", 2);
  }
  return path;
}

inline std::string write_text_stl(const std::string& name, const shapes::Shape& shape) {
  const std::string path = path_of(name);
  std::ofstream file(path);
  file.precision(17);
  file << "solid hull\n";
  for (std::size_t t = 0; t < shape.triangles.size(); t += 3) {
    file << "facet normal 0 0 0\nouter loop\n";
    for (std::size_t c = 0; c < 3; ++c) {
      const auto p = shape.vertex(shape.triangles[t + c]);
      file << "vertex " << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
    }
    file << "endloop\nendfacet\n";
  }
  file << "endsolid\n";
  return path;
}

/// Both shapes in one.
inline shapes::Shape joined(shapes::Shape one, const shapes::Shape& other) {
  const auto first = static_cast<std::int32_t>(one.vertices());
  one.positions.insert(one.positions.end(), other.positions.begin(), other.positions.end());
  for (const std::int32_t v : other.triangles) one.triangles.push_back(v + first);
  return one;
}

inline void turn(shapes::Shape& shape, std::size_t from, std::size_t to) {
  for (std::size_t t = from; t < to; ++t) std::swap(shape.triangles[3 * t], shape.triangles[3 * t + 1]);
}

/// Volume, centre and inertia about it (xx, yy, zz, xy, yz, zx) of what the surface bounds: integrals of polynomials
/// over the volume as fluxes through the triangles, by a quadrature that is exact for cubics.
struct Integrals {
  double volume = 0;
  Point centre{};
  std::array<double, 6> inertia{};
};

inline Integrals by_fluxes(const shapes::Shape& s) {
  constexpr double points[4][3] = {{1. / 3, 1. / 3, 1. / 3}, {.6, .2, .2}, {.2, .6, .2}, {.2, .2, .6}};
  constexpr double weights[4] = {-27. / 48, 25. / 48, 25. / 48, 25. / 48};
  double volume = 0, first[3]{}, square[3]{}, product[3]{};
  for (std::size_t t = 0; t < s.triangles.size(); t += 3) {
    const auto a = s.vertex(s.triangles[t]), b = s.vertex(s.triangles[t + 1]), c = s.vertex(s.triangles[t + 2]);
    Point u, v, area, p;
    for (std::size_t d = 0; d < 3; ++d) u[d] = b[d] - a[d], v[d] = c[d] - a[d];
    for (std::size_t d = 0; d < 3; ++d)
      area[d] = 0.5 * (u[(d + 1) % 3] * v[(d + 2) % 3] - u[(d + 2) % 3] * v[(d + 1) % 3]);
    for (int q = 0; q < 4; ++q) {
      for (std::size_t d = 0; d < 3; ++d) p[d] = points[q][0] * a[d] + points[q][1] * b[d] + points[q][2] * c[d];
      volume += weights[q] * p[0] * area[0];
      for (std::size_t d = 0; d < 3; ++d) {
        first[d] += weights[q] * p[d] * p[d] / 2 * area[d];
        square[d] += weights[q] * p[d] * p[d] * p[d] / 3 * area[d];
        product[d] += weights[q] * p[d] * p[d] * p[(d + 1) % 3] / 2 * area[d];
      }
    }
  }
  Integrals found{volume, {}, {}};
  double m[3];
  for (std::size_t d = 0; d < 3; ++d) {
    found.centre[d] = first[d] / volume;
    m[d] = square[d] - volume * found.centre[d] * found.centre[d];
  }
  for (std::size_t d = 0; d < 3; ++d) {
    found.inertia[d] = m[(d + 1) % 3] + m[(d + 2) % 3];
    found.inertia[3 + d] = -(product[d] - volume * found.centre[d] * found.centre[(d + 1) % 3]);
  }
  return found;
}

}  // namespace hull_files
