#pragma once
#include "geometry/clip.hpp"

/// What a piece of a triangle adds to its cell, for any kind of number. Internal to the room.
namespace polynya::geometry {

/// Sums over the edges of a piece that lie on one plane of the grid.
template <class Number>
struct PlaneCut {
  Number x_extent = 0, x_moment = 0, y_extent = 0, y_moment = 0;
};

/// The solid below a cut edge. On an x-plane a piece to its right, run round counter-clockwise about the outward
/// normal, leaves the integral of -z dy below its edge (then the area vector -z dy of the piece and the faces of the
/// cell close); on a y-plane +z dx. Seen from the other side of the plane the signs change.
template <class Number>
PlaneCut<Number> cut_along_planes(const BasicPolygon<Number>& polygon, const Number& floor, std::uint8_t x_plane,
                                  std::uint8_t y_plane) {
  PlaneCut<Number> cut;
  for (std::size_t c = 0; c < polygon.count; ++c) {
    if ((polygon.planes[c] & (x_plane | y_plane)) == 0) continue;
    const BasicCorner<Number>& p = *polygon.corner[c];
    const BasicCorner<Number>& q = *polygon.corner[c + 1 == polygon.count ? 0 : c + 1];
    const Number height = 0.5 * ((p.x[2] - floor) + (q.x[2] - floor));
    if (polygon.planes[c] & x_plane) {
      const Number extent = p.x[1] - q.x[1];
      cut.x_extent += extent;
      cut.x_moment += extent * height;
    } else {
      const Number extent = q.x[0] - p.x[0];
      cut.y_extent += extent;
      cut.y_moment += extent * height;
    }
  }
  return cut;
}

template <class Number>
void BasicClipper<Number>::record(const Polygon& polygon) {
  const auto nearest = [](const Number& x) { return NumberKind<Number>::nearest(x); };
  const std::array<Number, 3>& o = polygon.corner[0]->x;
  const std::int32_t top = lines_[2].intervals();
  const Number floor = lines_[2].line(std::min(cell_[2], top));
  PieceRecord piece;
  piece.i = cell_[0], piece.j = cell_[1], piece.k = cell_[2], piece.triangle = triangle_;
  Number height_moment = 0, weight_sum = 0;
  std::array<Number, 3> area{0, 0, 0}, centre{0, 0, 0}, e, f;
  unsigned planes = polygon.planes[0] | polygon.planes[1];
  for (std::size_t d = 0; d < 3; ++d) f[d] = polygon.corner[1]->x[d] - o[d];
  for (std::size_t c = 2; c < polygon.count; ++c) {
    const Corner& corner = *polygon.corner[c];
    planes |= polygon.planes[c];
    e = f;
    for (std::size_t d = 0; d < 3; ++d) f[d] = corner.x[d] - o[d];
    const std::array<Number, 3> n{e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2], e[0] * f[1] - e[1] * f[0]};
    const Number share = n[dominant_];
    for (std::size_t d = 0; d < 3; ++d) {
      area[d] += 0.5 * n[d];
      centre[d] += share * (e[d] + f[d]);
    }
    weight_sum += share;
    height_moment += 0.5 * n[2] * (e[2] + f[2]);
  }
  for (std::size_t d = 0; d < 3; ++d) piece.area[d] = nearest(area[d]);
  piece.height_moment = nearest(height_moment / 3 + area[2] * (o[2] - floor));
  const Number third = weight_sum != 0 ? Number(Number(1) / (3 * weight_sum)) : Number(0);
  const Number pu = o[u_] + centre[u_] * third - origin_[u_], pv = o[v_] + centre[v_] * third - origin_[v_];
  const double second = std::clamp(nearest(pu * to_second_[0] + pv * to_second_[1]), 0.0, 1.0);
  const double third_weight = std::clamp(nearest(pu * to_third_[0] + pv * to_third_[1]), 0.0, 1.0 - second);
  piece.weights = {1.0 - second - third_weight, second, third_weight};

  if (planes & (on_lower_x | on_lower_y)) {
    const PlaneCut<Number> cut = cut_along_planes(polygon, floor, on_lower_x, on_lower_y);
    piece.x_extent = nearest(cut.x_extent), piece.x_moment = nearest(cut.x_moment);
    piece.y_extent = nearest(cut.y_extent), piece.y_moment = nearest(cut.y_moment);
  }
  const bool has_area = piece.area[0] != 0 || piece.area[1] != 0 || piece.area[2] != 0;
  if (has_area || piece.x_extent != 0 || piece.y_extent != 0) records_.push_back(piece);

  // The last planes of the grid have no cell behind them that would count the cut.
  const bool last_x = (planes & on_upper_x) && cell_[0] + 1 == lines_[0].intervals();
  const bool last_y = (planes & on_upper_y) && cell_[1] + 1 == lines_[1].intervals();
  if (!last_x && !last_y) return;
  const PlaneCut<Number> cut = cut_along_planes(polygon, floor, on_upper_x, on_upper_y);
  PieceRecord beyond = piece;
  beyond.area = {0, 0, 0};
  beyond.height_moment = 0;
  beyond.x_extent = beyond.x_moment = beyond.y_extent = beyond.y_moment = 0;
  if (last_x && cut.x_extent != 0) {
    PieceRecord on_x = beyond;
    on_x.i = cell_[0] + 1;
    on_x.x_extent = -nearest(cut.x_extent), on_x.x_moment = -nearest(cut.x_moment);
    records_.push_back(on_x);
  }
  if (last_y && cut.y_extent != 0) {
    PieceRecord on_y = beyond;
    on_y.j = cell_[1] + 1;
    on_y.y_extent = -nearest(cut.y_extent), on_y.y_moment = -nearest(cut.y_moment);
    records_.push_back(on_y);
  }
}

}  // namespace polynya::geometry
