#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "fluid_solver/grid.hpp"
#include "fluid_solver/overlap.hpp"

/// Overlaps of simple bodies computed without the geometry room: an axis-parallel box exactly, a body of revolution
/// about a vertical axis by Gauss quadrature along its height over exact circle-rectangle areas.
namespace polynya::fluid::test {

using Vector = std::array<double, 3>;

struct Box {
  Vector low, high;
};

inline double common(double a0, double a1, double b0, double b1) {
  return std::max(0.0, std::min(a1, b1) - std::max(a0, b0));
}

/// Area of {x^2 + y^2 <= r^2, x <= a, y <= b}.
inline double circle_quadrant(double r, double a, double b) {
  a = std::clamp(a, -r, r);
  b = std::clamp(b, -r, r);
  // Integral over x from -r to a of (min(b, s) + s), s = sqrt(r^2 - x^2), where b >= -s.
  const auto antiderivative = [r](double x) {  // of sqrt(r^2 - x^2)
    const double t = std::clamp(x / r, -1.0, 1.0);
    return 0.5 * r * r * (t * std::sqrt(std::max(0.0, 1.0 - t * t)) + std::asin(t));
  };
  const double edge = std::sqrt(std::max(0.0, r * r - b * b));
  const auto piece = [&](double x0, double x1, bool inside_b) {  // both integrands over [x0, x1] limited by a
    x1 = std::min(x1, a);
    if (x1 <= x0) return 0.0;
    const double s = antiderivative(x1) - antiderivative(x0);
    return inside_b ? b * (x1 - x0) + s : 2.0 * s;
  };
  if (b >= 0) return piece(-r, -edge, false) + piece(-edge, edge, true) + piece(edge, r, false);
  return piece(-edge, edge, true);
}

inline double circle_rectangle(double r, double x0, double x1, double y0, double y1) {
  if (r <= 0) return 0;
  const double area =
      circle_quadrant(r, x1, y1) - circle_quadrant(r, x0, y1) - circle_quadrant(r, x1, y0) + circle_quadrant(r, x0, y0);
  return std::clamp(area, 0.0, (x1 - x0) * (y1 - y0));
}

template <class Function>
double integrate(double from, double to, int pieces, Function&& f) {
  static constexpr std::array<double, 4> point{-0.8611363115940526, -0.3399810435848563, 0.3399810435848563,
                                               0.8611363115940526};
  static constexpr std::array<double, 4> weight{0.3478548451374538, 0.6521451548625461, 0.6521451548625461,
                                                0.3478548451374538};
  if (to <= from) return 0;
  const double half = 0.5 * (to - from) / pieces;
  double sum = 0;
  for (int p = 0; p < pieces; ++p) {
    for (int q = 0; q < 4; ++q) sum += weight[q] * half * f(from + half * (2 * p + 1 + point[q]));
  }
  return sum;
}

/// Radius over height above the lower end; axis through (x, y).
struct Revolution {
  double x = 0, y = 0, bottom = 0, top = 0;
  std::function<double(double)> radius;  ///< of z in [bottom, top]
};

inline Revolution sphere(Vector centre, double radius) {
  return {centre[0], centre[1], centre[2] - radius, centre[2] + radius, [=](double z) {
            const double d = z - centre[2];
            return std::sqrt(std::max(0.0, radius * radius - d * d));
          }};
}

struct Solid {
  std::function<double(Vector, Vector)> volume;     ///< of solid between two corners
  std::function<double(int, Vector, Vector)> face;  ///< of solid on a face between two corners, m^2
};

inline Solid solid(const Box& box) {
  const auto part = [box](int d, const Vector& a, const Vector& b) {
    return common(a[d], b[d], box.low[d], box.high[d]);
  };
  return {[=](Vector a, Vector b) { return part(0, a, b) * part(1, a, b) * part(2, a, b); },
          [=](int normal, Vector a, Vector b) {
            if (a[normal] <= box.low[normal] || a[normal] >= box.high[normal]) return 0.0;
            return part((normal + 1) % 3, a, b) * part((normal + 2) % 3, a, b);
          }};
}

inline Solid solid(const Revolution& body, int pieces = 8) {
  const auto radius = [body](double z) { return z < body.bottom || z > body.top ? 0.0 : body.radius(z); };
  const auto chord = [=](double z, double offset, double t0, double t1) {
    const double r = radius(z), half = std::sqrt(std::max(0.0, r * r - offset * offset));
    return common(t0, t1, -half, half);
  };
  return {[=](Vector a, Vector b) {
            return integrate(std::max(a[2], body.bottom), std::min(b[2], body.top), pieces, [&](double z) {
              return circle_rectangle(radius(z), a[0] - body.x, b[0] - body.x, a[1] - body.y, b[1] - body.y);
            });
          },
          [=](int normal, Vector a, Vector b) {
            if (normal == 2)
              return circle_rectangle(radius(a[2]), a[0] - body.x, b[0] - body.x, a[1] - body.y, b[1] - body.y);
            return integrate(std::max(a[2], body.bottom), std::min(b[2], body.top), pieces, [&](double z) {
              return normal == 0 ? chord(z, a[0] - body.x, a[1] - body.y, b[1] - body.y)
                                 : chord(z, a[1] - body.y, a[0] - body.x, b[0] - body.x);
            });
          }};
}

/// A cylinder about the z axis, exact.
inline Solid cylinder(double radius, double bottom, double top) {
  return {[=](Vector a, Vector b) {
            return common(a[2], b[2], bottom, top) * circle_rectangle(radius, a[0], b[0], a[1], b[1]);
          },
          [=](int normal, Vector a, Vector b) {
            if (normal == 2)
              return a[2] > bottom && a[2] < top ? circle_rectangle(radius, a[0], b[0], a[1], b[1]) : 0.0;
            const int along = 1 - normal;
            const double half = std::sqrt(std::max(0.0, radius * radius - a[normal] * a[normal]));
            return common(a[along], b[along], -half, half) * common(a[2], b[2], bottom, top);
          }};
}

/// The overlap of one body, given as vehicle (0) or ice (1), moving with one velocity.
inline Overlap overlap_of(const Grid& grid, const Solid& body, Vector velocity, Vector low, Vector high,
                          int number = 0) {
  Overlap out;
  const auto corner = [&](int i, int j, int k) { return Vector{grid.x[i], grid.y[j], grid.z[k]}; };
  const auto near = [&](int i, int j, int k) {
    return grid.x[i] >= low[0] - 1e-12 - grid.dx[1 + std::min(i, grid.nx - 1)] && grid.x[i] <= high[0] + 1e-12 &&
           grid.y[j] >= low[1] - 1e-12 - grid.dy[1 + std::min(j, grid.ny - 1)] && grid.y[j] <= high[1] + 1e-12 &&
           grid.z[k] >= low[2] - 1e-12 - grid.dz[1 + std::min(k, grid.nz - 1)] && grid.z[k] <= high[2] + 1e-12;
  };
  std::array<std::vector<double>, 3> area;
  for (int d = 0; d < 3; ++d) {
    const int fx = grid.nx + (d == 0), fy = grid.ny + (d == 1), fz = grid.nz + (d == 2);
    area[d].assign(static_cast<std::size_t>(fx) * fy * fz, 0.0);
    for (int k = 0; k < fz; ++k) {
      for (int j = 0; j < fy; ++j) {
        for (int i = 0; i < fx; ++i) {
          if (!near(i, j, k)) continue;
          const Vector a = corner(i, j, k), b = corner(i + (d != 0), j + (d != 1), k + (d != 2));
          const double full =
              (d != 0 ? b[0] - a[0] : 1.0) * (d != 1 ? b[1] - a[1] : 1.0) * (d != 2 ? b[2] - a[2] : 1.0);
          const double covered = body.face(d, a, b);
          if (covered <= 1e-14 * full) continue;
          const std::size_t f =
              static_cast<std::size_t>(i) + static_cast<std::size_t>(fx) * (j + static_cast<std::size_t>(fy) * k);
          area[d][f] = std::min(covered, full);
          out.face[d].push_back(static_cast<std::int64_t>(f));
          out.face_solid[d].push_back(std::min(1.0, covered / full));
        }
      }
    }
  }
  for (int k = 0; k < grid.nz; ++k) {
    for (int j = 0; j < grid.ny; ++j) {
      for (int i = 0; i < grid.nx; ++i) {
        if (!near(i, j, k)) continue;
        const double full = (grid.x[i + 1] - grid.x[i]) * (grid.y[j + 1] - grid.y[j]) * (grid.z[k + 1] - grid.z[k]);
        const double covered = body.volume(corner(i, j, k), corner(i + 1, j + 1, k + 1));
        Vector wall{};
        for (int d = 0; d < 3; ++d) {
          const std::size_t fx = grid.nx + (d == 0), fy = grid.ny + (d == 1);
          const std::size_t lower = i + fx * (j + fy * k),
                            upper = (i + (d == 0)) + fx * ((j + (d == 1)) + fy * (k + (d == 2)));
          wall[d] = area[d][upper] - area[d][lower];
        }
        const bool wetted = wall[0] != 0 || wall[1] != 0 || wall[2] != 0;
        if (covered <= 1e-14 * full && !wetted) continue;
        out.cell.push_back(i + static_cast<std::int64_t>(grid.nx) * (j + static_cast<std::int64_t>(grid.ny) * k));
        out.solid_volume.push_back(std::min(covered, full));
        out.debris_volume.push_back(0);
        for (int b = 0; b < 2; ++b) {
          for (int d = 0; d < 3; ++d) {
            out.wall_area.push_back(b == number ? wall[d] : 0.0);
            out.wall_velocity.push_back(b == number ? velocity[d] : 0.0);
          }
        }
      }
    }
  }
  return out;
}

inline Overlap overlap_of(const Grid& grid, const Box& box, Vector velocity, int number = 0) {
  return overlap_of(grid, solid(box), velocity, box.low, box.high, number);
}

inline Overlap overlap_of(const Grid& grid, const Revolution& body, Vector velocity, double largest_radius,
                          int number = 0) {
  return overlap_of(grid, solid(body), velocity, {body.x - largest_radius, body.y - largest_radius, body.bottom},
                    {body.x + largest_radius, body.y + largest_radius, body.top}, number);
}

inline std::vector<double> even_line(double from, double to, int cells) {
  std::vector<double> line;
  for (int i = 0; i <= cells; ++i) line.push_back(from + (to - from) * i / cells);
  return line;
}

}  // namespace polynya::fluid::test
