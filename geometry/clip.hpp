#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "geometry/grid_lines.hpp"

/// How one triangle is cut by the planes of the grid. Internal to the room.
namespace polynya::geometry {

/// A point of a surface with the interval ("slab") of the grid it is assigned to along each axis. Slabs, not
/// coordinates, decide on which side of a plane a corner lies, and corners made on a shared edge are computed from the
/// same numbers in the same order by both neighbours. So pieces of neighbouring triangles and cells always fit
/// together.
template <class Number>
struct BasicCorner {
  std::array<Number, 3> x;
  std::array<std::int32_t, 3> slab;
};
using Corner = BasicCorner<double>;

/// What clipping needs to know of a kind of number.
template <class Number>
struct NumberKind;

template <>
struct NumberKind<double> {
  static double nearest(double x) { return x; }
  /// The interval that holds x, of those from `first` to `last`.
  static std::int32_t slab(const LineLocator& lines, double x, std::int32_t first, std::int32_t last) {
    return std::clamp(lines.below(x), first, last);
  }
};

inline constexpr std::uint8_t on_lower_x = 1, on_upper_x = 2, on_lower_y = 4, on_upper_y = 8;

inline constexpr std::size_t most_corners = 24;

/// A part of a triangle. Corners are not copied from cut to cut: they lie where they were made.
template <class Number>
struct BasicPolygon {
  std::size_t count = 0;
  std::array<const BasicCorner<Number>*, most_corners> corner;
  std::array<std::uint8_t, most_corners> planes;  ///< that the edge from a corner to the next lies on

  void push(const BasicCorner<Number>* c, std::uint8_t edge_planes) {
    corner[count] = c;
    planes[count++] = edge_planes;
  }
};

/// What one triangle leaves in one cell. k may be the number of cells along z: above the grid. i or j may be the number
/// of cells: then the record carries only what lies on the last plane.
struct PieceRecord {
  std::int32_t i, j, k, triangle;
  std::array<double, 3> area;         ///< m^2, outward
  double height_moment;               ///< integral of (z - z_k) n_z dA
  std::array<double, 3> weights;      ///< barycentric coordinates of the centroid
  double x_extent = 0, x_moment = 0;  ///< of the cut along the cell's lower x-plane: integral of dy, of (z - z_k) dy
  double y_extent = 0, y_moment = 0;  ///< likewise along the lower y-plane: integral of dx, of (z - z_k) dx
};

/// Cuts triangles and appends their records. Number is double, or one without rounding (exact_clip.cpp); then records
/// hold the nearest doubles.
template <class Number>
class BasicClipper {
 public:
  using Corner = BasicCorner<Number>;
  using Polygon = BasicPolygon<Number>;

  BasicClipper(const std::array<LineLocator, 3>& lines, std::vector<PieceRecord>& records)
      : lines_(lines), records_(records) {}

  void cut(std::int32_t triangle, const Corner& a, const Corner& b, const Corner& c) {
    Polygon whole;
    whole.push(&a, 0);
    whole.push(&b, 0);
    whole.push(&c, 0);
    triangle_ = triangle;
    prepare_weights(a, b, c);
    cut_along<0>(whole);
  }

 private:
  static constexpr std::array<std::uint8_t, 3> lower_flag{on_lower_x, on_lower_y, 0};
  static constexpr std::array<std::uint8_t, 3> upper_flag{on_upper_x, on_upper_y, 0};

  /// Corners on one plane of the grid. Two, unless rounding folded the polygon.
  struct Crossings {
    std::size_t count = 0;
    std::array<Corner, most_corners> corner;
  };

  template <std::size_t axis>
  void cut_along(const Polygon& polygon) {
    std::int32_t first = polygon.corner[0]->slab[axis], last = first;
    for (std::size_t c = 1; c < polygon.count; ++c) {
      const std::int32_t slab = polygon.corner[c]->slab[axis];
      first = std::min(first, slab);
      last = std::max(last, slab);
    }
    if (first == last) return in_slab<axis>(polygon, first);
    Polygon lower;
    std::array<Polygon, 2> upper;        // in turn: what remains above the last plane
    std::array<Crossings, 2> crossings;  // in turn: a part between two planes has corners on both
    const Polygon* remaining = &polygon;
    for (std::int32_t plane = first + 1; plane <= last; ++plane) {
      const auto turn = static_cast<std::size_t>(plane & 1);
      split<axis>(*remaining, plane, crossings[turn], lower, upper[turn]);
      in_slab<axis>(lower, plane - 1);
      remaining = &upper[turn];
    }
    in_slab<axis>(*remaining, last);
  }

  template <std::size_t axis>
  void in_slab(const Polygon& polygon, std::int32_t slab) {
    const std::int32_t cells = lines_[axis].intervals();
    if (slab < 0 || (slab >= cells && axis != 2)) return;  // beside or below the grid; above it still shades the column
    cell_[axis] = slab;
    if constexpr (axis < 2)
      cut_along<axis + 1>(polygon);
    else
      record(polygon);
  }

  static Number between_0_and_1(const Number& t) { return std::clamp(t, Number(0), Number(1)); }

  /// Assigned to the upper side: of the part below the plane nobody asks any more.
  template <std::size_t axis>
  void cross(const Corner& below, const Corner& above, std::int32_t plane, Corner& r) const {
    const Number position = lines_[axis].line(plane), rise = above.x[axis] - below.x[axis];
    // Both ends on the plane, assigned to different sides: any point of the edge serves, if both neighbours choose the
    // same.
    const Number t = rise > 0 ? between_0_and_1(Number((position - below.x[axis]) / rise)) : Number(0.5);
    for (std::size_t d = 0; d < 3; ++d) {
      if (d == axis) continue;
      r.x[d] = below.x[d] + t * (above.x[d] - below.x[d]);
      r.slab[d] = below.slab[d];
      if (d > axis && below.slab[d] != above.slab[d])
        r.slab[d] = NumberKind<Number>::slab(lines_[d], r.x[d], std::min(below.slab[d], above.slab[d]),
                                             std::max(below.slab[d], above.slab[d]));
    }
    r.x[axis] = position;
    r.slab[axis] = plane;
  }

  template <std::size_t axis>
  void split(const Polygon& polygon, std::int32_t plane, Crossings& crossings, Polygon& lower, Polygon& upper) const {
    lower.count = upper.count = crossings.count = 0;
    const Corner* p = polygon.corner[0];
    bool p_above = p->slab[axis] >= plane;
    for (std::size_t c = 0; c < polygon.count; ++c) {
      const Corner* q = polygon.corner[c + 1 == polygon.count ? 0 : c + 1];
      const bool q_above = q->slab[axis] >= plane;
      const std::uint8_t edge = polygon.planes[c];
      (p_above ? upper : lower).push(p, edge);
      if (p_above != q_above) {
        Corner& r = crossings.corner[crossings.count++];
        cross<axis>(p_above ? *q : *p, p_above ? *p : *q, plane, r);
        lower.push(&r, p_above ? edge : upper_flag[axis]);
        upper.push(&r, p_above ? lower_flag[axis] : edge);
      }
      p = q;
      p_above = q_above;
    }
  }

  void prepare_weights(const Corner& a, const Corner& b, const Corner& c) {
    std::array<Number, 3> e, f;
    for (std::size_t d = 0; d < 3; ++d) {
      origin_[d] = a.x[d];
      e[d] = b.x[d] - a.x[d];
      f[d] = c.x[d] - a.x[d];
    }
    const std::array<Number, 3> n{e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2], e[0] * f[1] - e[1] * f[0]};
    const auto size = [&](std::size_t d) { return Number(n[d] < 0 ? Number(-n[d]) : n[d]); };
    dominant_ = size(0) > size(1) ? 0 : 1;
    if (size(2) > size(dominant_)) dominant_ = 2;
    u_ = (dominant_ + 1) % 3;
    v_ = (dominant_ + 2) % 3;
    const Number inverse = n[dominant_] != 0 ? Number(Number(1) / n[dominant_]) : Number(0);
    to_second_ = {Number(f[v_] * inverse), Number(-f[u_] * inverse)};
    to_third_ = {Number(-e[v_] * inverse), Number(e[u_] * inverse)};
  }

  void record(const Polygon& polygon);

  const std::array<LineLocator, 3>& lines_;
  std::vector<PieceRecord>& records_;
  std::int32_t triangle_ = 0;
  std::array<std::int32_t, 3> cell_{};
  std::array<Number, 3> origin_{};
  std::size_t dominant_ = 2, u_ = 0, v_ = 1;
  std::array<Number, 2> to_second_{}, to_third_{};
};
using TriangleClipper = BasicClipper<double>;

}  // namespace polynya::geometry
