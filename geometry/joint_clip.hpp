#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "geometry/clip.hpp"
#include "geometry/joint_pieces.hpp"

/// What of a piece of one body's surface lies below triangles of another one, for any kind of number. Internal to the
/// room.
namespace polynya::geometry {

template <class Number>
using JointPoint = std::array<Number, 3>;  ///< from the cell's lower corner, m

/// A convex part of a triangle.
template <class Number>
struct JointPolygon {
  std::size_t count = 0;
  std::array<JointPoint<Number>, most_corners> corner;
  std::array<std::uint8_t, most_corners> planes;  ///< of the grid that the edge from a corner to the next lies on

  void push(const JointPoint<Number>& c, std::uint8_t edge_planes) {
    corner[count] = c;
    planes[count++] = edge_planes;
  }
};

template <class Number>
class JointClip {
 public:
  explicit JointClip(const JointCell& cell) : cell_(cell) {}

  /// Adds what of `piece` in the cell lies below `others`, those that face upward less those that face downward: the
  /// piece's part inside the other body, if nothing but `others` lies above the cell. False if rounding could matter.
  bool add_below(const JointTriangle& piece, std::span<const JointTriangle> others, JointSum& sum) {
    const std::array<JointPoint<Number>, 3> corners = local(piece);
    whole_.count = 0;
    for (const JointPoint<Number>& c : corners) whole_.push(c, 0);
    keep_in_cell();
    if (whole_.count < 3) return true;
    const std::array<JointPoint<double>, 3> rounded{nearest(corners[0]), nearest(corners[1]), nearest(corners[2])};
    JointPoint<double> low = nearest(whole_.corner[0]), high = low;
    for (std::size_t c = 1; c < whole_.count; ++c) {
      const JointPoint<double> p = nearest(whole_.corner[c]);
      for (std::size_t d = 0; d < 3; ++d) low[d] = std::min(low[d], p[d]), high[d] = std::max(high[d], p[d]);
    }
    for (const JointTriangle& other : others)
      if (!add_below_one(rounded, low, high, other, sum)) return false;
    return true;
  }

 private:
  static constexpr bool rounds = std::is_floating_point_v<Number>;

  static JointPoint<double> nearest(const JointPoint<Number>& p) {
    return {NumberKind<Number>::nearest(p[0]), NumberKind<Number>::nearest(p[1]), NumberKind<Number>::nearest(p[2])};
  }

  JointPoint<Number> local(const JointVertex& v) const {
    JointPoint<Number> p;
    for (std::size_t d = 0; d < 3; ++d) p[d] = (Number(v.x[d]) - Number(cell_.low[d])) + Number(v.shift[d]);
    return p;
  }
  std::array<JointPoint<Number>, 3> local(const JointTriangle& t) const {
    return {local(t.corner[0]), local(t.corner[1]), local(t.corner[2])};
  }

  /// Keeps what of a polygon has a distance >= 0; the new edge lies on `planes`.
  template <class Distance>
  static void keep(JointPolygon<Number>& polygon, std::uint8_t planes, Distance&& distance) {
    std::array<Number, most_corners> d;
    std::size_t inside = 0;
    for (std::size_t c = 0; c < polygon.count; ++c) {
      d[c] = distance(polygon.corner[c]);
      inside += d[c] >= 0;
    }
    if (inside == polygon.count) return;
    JointPolygon<Number> kept;
    for (std::size_t c = 0; inside > 0 && c < polygon.count; ++c) {
      const std::size_t n = c + 1 == polygon.count ? 0 : c + 1;
      if (d[c] >= 0) kept.push(polygon.corner[c], polygon.planes[c]);
      if ((d[c] >= 0) == (d[n] >= 0)) continue;
      const bool leaves = d[c] >= 0;
      const std::size_t in = leaves ? c : n, out = leaves ? n : c;  // the same point from both sides of an edge
      const Number t = d[in] / (d[in] - d[out]);
      JointPoint<Number> r;
      for (std::size_t a = 0; a < 3; ++a)
        r[a] = polygon.corner[in][a] + t * (polygon.corner[out][a] - polygon.corner[in][a]);
      kept.push(r, leaves ? planes : polygon.planes[c]);
      if (kept.count + 2 > most_corners) break;
    }
    polygon = std::move(kept);
  }

  void keep_in_cell() {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      keep(whole_,
           axis == 0   ? on_lower_x
           : axis == 1 ? on_lower_y
                       : std::uint8_t{0},
           [&](const JointPoint<Number>& p) { return p[axis]; });
      if (!std::isfinite(cell_.high[axis])) continue;
      const Number width = Number(cell_.high[axis]) - Number(cell_.low[axis]);
      keep(whole_,
           axis == 0   ? on_upper_x
           : axis == 1 ? on_upper_y
                       : std::uint8_t{0},
           [&](const JointPoint<Number>& p) { return Number(width - p[axis]); });
    }
  }

  bool add_below_one(const std::array<JointPoint<double>, 3>& corners, const JointPoint<double>& low,
                     const JointPoint<double>& high, const JointTriangle& other, JointSum& sum) const {
    double largest = 0;
    JointPoint<double> lowest, highest;
    for (std::size_t d = 0; d < 3; ++d) {
      const double a = other.corner[0].x[d] - cell_.low[d], b = other.corner[1].x[d] - cell_.low[d],
                   c = other.corner[2].x[d] - cell_.low[d];
      lowest[d] = std::min({a, b, c}), highest[d] = std::max({a, b, c});
      largest = std::max({largest, -lowest[d], highest[d], high[d]});
    }
    const double near = 1e-9 * largest;  // far beyond shifts and rounding
    if (highest[2] < low[2] - near) return true;
    for (std::size_t d = 0; d < 2; ++d)
      if (highest[d] < low[d] - near || lowest[d] > high[d] + near) return true;
    const std::array<JointPoint<Number>, 3> t = local(other);
    JointPoint<Number> normal = cross(t);
    if constexpr (rounds) {
      const double length = std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
      if (std::abs(normal[2]) <= steepest * length) return true;
      for (double& n : normal) n /= length;
    }
    if (normal[2] == 0) return true;
    const bool up = normal[2] > 0;
    JointPolygon<Number> part = whole_;
    for (std::size_t e = 0; e < 3 && part.count >= 3; ++e) {
      // An edge is the same line for both of its triangles.
      std::size_t from = e, to = (e + 1) % 3;
      bool positive = up;
      if (other.vertex[from] > other.vertex[to]) {
        std::swap(from, to);
        positive = !positive;
      }
      Number ex = t[to][0] - t[from][0], ey = t[to][1] - t[from][1];
      if constexpr (rounds) {
        const double length = std::sqrt(ex * ex + ey * ey);
        if (length > 0) ex /= length, ey /= length;
      }
      const auto inward = [&](const JointPoint<Number>& p) {
        const Number left = ex * (p[1] - t[from][1]) - ey * (p[0] - t[from][0]);
        return positive ? left : Number(-left);
      };
      if constexpr (rounds)
        if (!is_certain(part, inward, largest, 2e-13)) return false;
      keep(part, std::uint8_t{0}, inward);
    }
    if (part.count < 3) return true;
    const auto depth = [&](const JointPoint<Number>& p) {
      const Number above = normal[0] * (p[0] - t[0][0]) + normal[1] * (p[1] - t[0][1]) + normal[2] * (p[2] - t[0][2]);
      return up ? Number(-above) : above;
    };
    if (lowest[2] <= high[2] + near) {
      if constexpr (rounds)
        if (!is_certain(part, depth, largest, 1e-13)) return false;
      keep(part, std::uint8_t{0}, depth);
    }
    if (part.count >= 3) add(corners, part, up ? 1.0 : -1.0, sum);
    return true;
  }

  static JointPoint<Number> cross(const std::array<JointPoint<Number>, 3>& t) {
    JointPoint<Number> e, f;
    for (std::size_t d = 0; d < 3; ++d) e[d] = t[1][d] - t[0][d], f[d] = t[2][d] - t[0][d];
    return {Number(e[1] * f[2] - e[2] * f[1]), Number(e[2] * f[0] - e[0] * f[2]), Number(e[0] * f[1] - e[1] * f[0])};
  }

  /// Of the smallest slope n_z of a triangle that has something below it in doubles.
  static constexpr double steepest = 2e-14;

  /// How far a plane cuts into a polygon, or along an edge of it, is known to the distances' rounding over their
  /// spread. Of nearly parallel planes that is too little: beyond `share` of the cell's face.
  template <class Depth>
  bool is_certain(const JointPolygon<Number>& part, Depth&& depth, double largest, double share) const {
    const double rounding = 8 * std::numeric_limits<double>::epsilon() * largest;
    double least = depth(part.corner[0]), most = least;
    for (std::size_t c = 1; c < part.count; ++c) {
      const double d = depth(part.corner[c]);
      least = std::min(least, d), most = std::max(most, d);
    }
    if (least > rounding || most < -rounding) return true;
    double square = 0;
    for (std::size_t d = 0; d < 3; ++d) {
      double low = part.corner[0][d], high = low;
      for (std::size_t c = 1; c < part.count; ++c)
        low = std::min(low, part.corner[c][d]), high = std::max(high, part.corner[c][d]);
      square += (high - low) * (high - low);
    }
    const double width = std::min(cell_.high[0] - cell_.low[0], cell_.high[1] - cell_.low[1]);
    return square * rounding <= share * width * width * (most - least);
  }

  void add(const std::array<JointPoint<double>, 3>& t, const JointPolygon<Number>& part, double sign,
           JointSum& sum) const {
    std::array<JointPoint<double>, most_corners> p;
    for (std::size_t c = 0; c < part.count; ++c) p[c] = nearest(part.corner[c]);
    const JointPoint<double> normal = JointClip<double>::normal_of(t[0], t[1], t[2]);
    const double square = normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2];
    const double length = std::sqrt(square);
    for (std::size_t c = 2; c < part.count; ++c) {
      const JointPoint<double> n = JointClip<double>::normal_of(p[0], p[c - 1], p[c]);
      JointPoint<double> centre;
      for (std::size_t d = 0; d < 3; ++d) {
        centre[d] = (p[0][d] + p[c - 1][d] + p[c][d]) / 3;
        sum.area[d] += sign * 0.5 * n[d];
      }
      sum.height_moment += sign * 0.5 * n[2] * centre[2];
      if (square == 0) continue;
      const double wall = sign * 0.5 * (n[0] * normal[0] + n[1] * normal[1] + n[2] * normal[2]) / length;
      const JointPoint<double> to_second = JointClip<double>::normal_of(t[0], centre, t[2]),
                               to_third = JointClip<double>::normal_of(t[0], t[1], centre);
      double second = 0, third = 0;
      for (std::size_t d = 0; d < 3; ++d)
        second += to_second[d] * normal[d] / square, third += to_third[d] * normal[d] / square;
      sum.wall += wall;
      sum.weighted[0] += wall * (1 - second - third);
      sum.weighted[1] += wall * second;
      sum.weighted[2] += wall * third;
    }
    for (std::size_t c = 0; c < part.count; ++c) {
      const JointPoint<double>&a = p[c], &b = p[c + 1 == part.count ? 0 : c + 1];
      const double height = 0.5 * (a[2] + b[2]);
      if (part.planes[c] == (cell_.last[0] ? on_upper_x : on_lower_x)) {
        const double extent = (cell_.last[0] ? -sign : sign) * (a[1] - b[1]);
        sum.x_extent += extent;
        sum.x_moment += extent * height;
      } else if (part.planes[c] == (cell_.last[1] ? on_upper_y : on_lower_y)) {
        const double extent = (cell_.last[1] ? -sign : sign) * (b[0] - a[0]);
        sum.y_extent += extent;
        sum.y_moment += extent * height;
      }
    }
  }

 public:
  static JointPoint<Number> normal_of(const JointPoint<Number>& a, const JointPoint<Number>& b,
                                      const JointPoint<Number>& c) {
    return cross({a, b, c});
  }

 private:
  const JointCell& cell_;
  JointPolygon<Number> whole_;
};

}  // namespace polynya::geometry
