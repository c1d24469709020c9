#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "fluid_solver/grid.hpp"
#include "fluid_solver/overlap.hpp"

/// Overlaps of a convex polygon in the plane y = const, as long along y as the grid: slices one cell thick.
/// Polygons are cut by half planes of the cell (Sutherland & Hodgman 1974), exact to rounding.
namespace polynya::fluid::test {

struct Point {
  double x, z;
};

/// Corners counterclockwise, seen along +y with x to the right and z up.
using Polygon = std::vector<Point>;

/// What a polygon leaves of itself where sign * (coordinate - bound) <= 0.
inline void keep_below(const Polygon& in, bool along_x, double sign, double bound, Polygon& out) {
  out.clear();
  for (std::size_t n = 0; n < in.size(); ++n) {
    const Point &a = in[n], &b = in[(n + 1) % in.size()];
    const double da = sign * ((along_x ? a.x : a.z) - bound), db = sign * ((along_x ? b.x : b.z) - bound);
    if (da <= 0) out.push_back(a);
    if ((da < 0 && db > 0) || (da > 0 && db < 0)) {
      const double part = da / (da - db);
      Point cut{a.x + part * (b.x - a.x), a.z + part * (b.z - a.z)};
      (along_x ? cut.x : cut.z) = bound;
      out.push_back(cut);
    }
  }
}

inline double area_of(const Polygon& polygon) {
  double twice = 0;
  for (std::size_t n = 1; n + 1 < polygon.size(); ++n) {
    const Point &o = polygon[0], &a = polygon[n], &b = polygon[n + 1];
    twice += (a.x - o.x) * (b.z - o.z) - (a.z - o.z) * (b.x - o.x);
  }
  return 0.5 * twice;
}

/// Part of the line coordinate = at (along the other axis) that lies in the polygon.
inline std::array<double, 2> chord(const Polygon& polygon, bool vertical, double at) {
  double low = 1e300, high = -1e300;
  for (std::size_t n = 0; n < polygon.size(); ++n) {
    const Point &a = polygon[n], &b = polygon[(n + 1) % polygon.size()];
    const double da = (vertical ? a.x : a.z) - at, db = (vertical ? b.x : b.z) - at;
    if ((da < 0) == (db < 0)) continue;
    const double part = da / (da - db), place = vertical ? a.z + part * (b.z - a.z) : a.x + part * (b.x - a.x);
    low = std::min(low, place);
    high = std::max(high, place);
  }
  return {low, high};
}

/// The overlap of a polygon (as vehicle) that moves with one velocity along x and z. Areas of wall follow from the
/// faces, so they close to rounding.
inline Overlap overlap_of(const Grid& grid, const Polygon& body, std::array<double, 2> velocity) {
  Overlap out;
  const int nx = grid.nx, nz = grid.nz;
  const double thick = grid.y[1] - grid.y[0];
  double left = 1e300, right = -1e300, bottom = 1e300, top = -1e300;
  for (const Point& corner : body) {
    left = std::min(left, corner.x), right = std::max(right, corner.x);
    bottom = std::min(bottom, corner.z), top = std::max(top, corner.z);
  }
  const auto cells_between = [](const std::vector<double>& line, double low, double high) {
    const int last = static_cast<int>(line.size()) - 2;
    const auto cell = [&](double at) {
      return std::clamp(static_cast<int>(std::upper_bound(line.begin(), line.end(), at) - line.begin()) - 1, 0, last);
    };
    return std::array<int, 2>{cell(low), cell(high)};
  };
  const auto [first_i, last_i] = cells_between(grid.x, left, right);
  const auto [first_k, last_k] = cells_between(grid.z, bottom, top);
  const auto covered = [](std::array<double, 2> part, double a, double b) {
    return std::clamp((std::min(part[1], b) - std::max(part[0], a)) / (b - a), 0.0, 1.0);
  };
  const std::size_t wide = static_cast<std::size_t>(nx) + 1;
  std::vector<double> x_part(wide * static_cast<std::size_t>(nz)), z_part(wide * (static_cast<std::size_t>(nz) + 1));
  for (int i = first_i; i <= last_i + 1; ++i) {
    const auto part = chord(body, true, grid.x[i]);
    for (int k = first_k; k <= last_k; ++k) x_part[i + wide * k] = covered(part, grid.z[k], grid.z[k + 1]);
  }
  for (int k = first_k; k <= last_k + 1; ++k) {
    const auto part = chord(body, false, grid.z[k]);
    for (int i = first_i; i <= last_i; ++i) z_part[i + wide * k] = covered(part, grid.x[i], grid.x[i + 1]);
  }
  const auto add_face = [&](int axis, std::int64_t face, double part) {
    if (part <= 1e-14) return;
    out.face[axis].push_back(face);
    out.face_solid[axis].push_back(part);
  };
  const auto has_corner = [&](int i, int k) {
    return std::any_of(body.begin(), body.end(), [&](const Point& at) {
      return at.x > grid.x[i] && at.x < grid.x[i + 1] && at.z > grid.z[k] && at.z < grid.z[k + 1];
    });
  };
  Polygon one, two;
  for (int k = first_k; k <= last_k + 1; ++k) {
    for (int i = first_i; i <= last_i + 1; ++i) {
      if (k <= last_k) add_face(0, i + static_cast<std::int64_t>(nx + 1) * k, x_part[i + wide * k]);
      if (i <= last_i) add_face(2, i + static_cast<std::int64_t>(nx) * k, z_part[i + wide * k]);
      if (i > last_i || k > last_k) continue;
      const double dx = grid.x[i + 1] - grid.x[i], dz = grid.z[k + 1] - grid.z[k];
      const double x0 = x_part[i + wide * k], x1 = x_part[i + 1 + wide * k], z0 = z_part[i + wide * k],
                   z1 = z_part[i + wide * (k + 1)];
      const bool apart = x0 <= 0 && x1 <= 0 && z0 <= 0 && z1 <= 0;
      double part = apart ? 0.0 : 1.0;  // of a convex body that covers all four sides or none and has no corner inside
      if (apart ? has_corner(i, k) : !(x0 >= 1 && x1 >= 1 && z0 >= 1 && z1 >= 1)) {
        keep_below(body, true, -1, grid.x[i], one);
        keep_below(one, true, 1, grid.x[i + 1], two);
        keep_below(two, false, -1, grid.z[k], one);
        keep_below(one, false, 1, grid.z[k + 1], two);
        part = two.size() > 2 ? std::clamp(area_of(two) / (dx * dz), 0.0, 1.0) : 0.0;
      }
      const std::array<double, 3> wall{(x1 - x0) * dz * thick, 0.0, (z1 - z0) * dx * thick};
      if (part <= 1e-14 && wall[0] == 0 && wall[2] == 0) continue;
      const std::int64_t cell = i + static_cast<std::int64_t>(nx) * k;
      if (part > 1e-14) {
        add_face(1, i + static_cast<std::int64_t>(nx) * (2 * k), part);
        add_face(1, i + static_cast<std::int64_t>(nx) * (2 * k + 1), part);
      }
      out.cell.push_back(cell);
      out.solid_volume.push_back(part * dx * dz * thick);
      out.debris_volume.push_back(0);
      out.wall_area.insert(out.wall_area.end(), {wall[0], 0.0, wall[2], 0.0, 0.0, 0.0});
      out.wall_velocity.insert(out.wall_velocity.end(), {velocity[0], 0.0, velocity[1], 0.0, 0.0, 0.0});
    }
  }
  return out;
}

/// Lines of a grid that is even, of width h, from `low` to `high` (both on the lattice of h) and grows by `growth` per
/// cell beyond, until `from` and `to` are reached.
inline std::vector<double> graded_line(double from, double low, double high, double to, double h, double growth) {
  std::vector<double> below, line;
  for (double at = low, width = h; at > from + 0.5 * width;) below.push_back(at -= (width *= growth));
  line.assign(below.rbegin(), below.rend());
  const int even = static_cast<int>(std::lround((high - low) / h));
  for (int n = 0; n <= even; ++n) line.push_back(low + h * n);
  for (double at = high, width = h; at < to - 0.5 * width;) line.push_back(at += (width *= growth));
  return line;
}

/// Lines of a grid about 0 whose cells grow with the distance from it, smallest + part * distance, until `near`, beyond by a
/// tenth per cell: what spreads from 0 is resolved alike at all times.
inline std::vector<double> spreading_line(double from, double to, double smallest, double part, double near) {
  const auto one_way = [&](double end) {
    std::vector<double> at{0};
    for (double width = smallest; at.back() < end - 0.5 * width;) {
      at.push_back(at.back() + width);
      width = at.back() < near ? std::min(1.1 * width, smallest + part * at.back()) : 1.1 * width;
    }
    return at;
  };
  const std::vector<double> below = one_way(-from), above = one_way(to);
  std::vector<double> line;
  for (std::size_t n = below.size() - 1; n > 0; --n) line.push_back(-below[n]);
  line.insert(line.end(), above.begin(), above.end());
  return line;
}

}  // namespace polynya::fluid::test
