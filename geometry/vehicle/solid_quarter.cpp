#include <algorithm>
#include <cmath>

#include "geometry/vehicle/layered_hull.hpp"
#include "geometry/vehicle/quarter_mesh.hpp"

namespace polynya::geometry {
namespace {

using Point = std::array<double, 3>;

constexpr double core_share = 0.55;  ///< half width of the core over the radius of the body

/// The core: a column of n x n hexahedra under the nose patch, as many rows tall as the hull. Its top is a blunt cone
/// with an edge, about as far below the hull as its sides are; from row `flat_row` down its sections are plane.
class Core {
 public:
  Core(const Meridian& outline, const HullNet& net) : net_(net), n_(net.division.patch), rows_(net.division.rows()) {
    const double gap = (1 - core_share) * outline.radius();
    width_ = core_share * outline.radius();
    const MeridianPoint over_edge = outline.head_point(0.5 * outline.head_arc());
    edge_width_ = std::max(over_edge.radius - gap * over_edge.normal_radius, 0.3 * over_edge.radius);
    edge_depth_ = over_edge.depth - gap * over_edge.normal_depth;
    // The nose angle decides how deep a point lies that is `gap` away from the hull.
    const double nose_sine = std::max(0.3, -outline.head_point(0).normal_depth);
    top_depth_ = std::max(std::min(gap / nose_sine, edge_depth_), edge_depth_ - 1.4 * edge_width_);
    // A short head borrows rows of the cylinder, so that the rows below the core's edge keep their height.
    flat_row_ = net.division.head_rows;
    const double row_height = (outline.length() - outline.head_length()) / net.division.cylinder_rows;
    const auto wanted = [&](int row) { return edge_depth_ + 0.5 * row * row_height; };
    while (flat_row_ < rows_ - 1 && depth_of_row(flat_row_) < wanted(flat_row_)) ++flat_row_;
    flat_depth_ = depth_of_row(flat_row_);
  }

  /// The core's node on its sides that faces a column of the hull.
  Point side(int column, int row) const {
    const auto [i, j] = edge(column);
    const auto square = rounded_square(i, j, n_);
    const double share = std::min(1.0, static_cast<double>(row) / flat_row_);
    const double width = (1 - share) * edge_width_ + share * width_;
    const double depth = row >= flat_row_ ? depth_of_row(row) : (1 - share) * edge_depth_ + share * flat_depth_;
    return {width * square[0], width * square[1], depth};
  }

  /// The core's node under node (i, j) of the nose patch.
  Point top(int i, int j) const {
    const auto square = rounded_square(i, j, n_);
    const double share = static_cast<double>(std::max(i, j)) / n_;
    return {edge_width_ * square[0], edge_width_ * square[1], (1 - share) * top_depth_ + share * edge_depth_};
  }

  /// Node strictly inside the core's sides and below its top, 0 <= i, j < n.
  Point inside(int i, int j, int row) const {
    if (row >= flat_row_) return flat(i, j, depth_of_row(row));
    const double u = static_cast<double>(i) / n_, v = static_cast<double>(j) / n_;
    const double w = static_cast<double>(row) / flat_row_;
    // Transfinite interpolation from the six faces of the block: faces minus edges plus corners.
    const auto [ic, jc, kc] = std::array<std::array<int, 2>, 3>{{{0, n_}, {0, n_}, {0, flat_row_}}};
    const std::array<double, 2> us = {1 - u, u}, vs = {1 - v, v}, ws = {1 - w, w};
    Point p = {0, 0, 0};
    const auto add = [&p](double weight, const Point& q) {
      for (int a = 0; a < 3; ++a) p[a] += weight * q[a];
    };
    for (int a = 0; a < 2; ++a) {
      add(us[a], face(ic[a], j, row));
      add(vs[a], face(i, jc[a], row));
      add(ws[a], face(i, j, kc[a]));
      for (int b = 0; b < 2; ++b) {
        add(-us[a] * vs[b], face(ic[a], jc[b], row));
        add(-vs[a] * ws[b], face(i, jc[a], kc[b]));
        add(-ws[a] * us[b], face(ic[b], j, kc[a]));
        for (int c = 0; c < 2; ++c) add(us[a] * vs[b] * ws[c], face(ic[a], jc[b], kc[c]));
      }
    }
    if (i == 0) p[0] = 0;
    if (j == 0) p[1] = 0;
    return p;
  }

  double depth_of_row(int row) const { return net_.nodes[net_.ring_node(0, row)].depth; }
  std::array<int, 2> edge(int column) const {
    return column <= n_ ? std::array<int, 2>{n_, column} : std::array<int, 2>{2 * n_ - column, n_};
  }
  int column(int i, int j) const { return i == n_ ? j : 2 * n_ - i; }

 private:
  Point flat(int i, int j, double depth) const {
    const auto square = rounded_square(i, j, n_);
    return {width_ * square[0], width_ * square[1], depth};
  }

  /// A node on one of the six faces of the block above row `flat_row`.
  Point face(int i, int j, int row) const {
    if (i == n_ || j == n_) return side(column(i, j), row);
    if (row == 0) return top(i, j);
    if (row == flat_row_) return flat(i, j, flat_depth_);
    return plane(i, j, row);
  }

  /// A node on a plane of symmetry (i = 0 or j = 0): transfinite between the axis, the side, the top and the section.
  Point plane(int i, int j, int row) const {
    const double w = static_cast<double>(row) / flat_row_;
    if (i == 0 && j == 0) {
      return {0, 0, (1 - w) * top_depth_ + w * flat_depth_};
    }
    const int k = i + j;
    const double u = static_cast<double>(k) / n_;
    const auto at = [&](int m, int r) { return i > 0 ? face(m, 0, r) : face(0, m, r); };
    const Point axis = plane(0, 0, row), outer = at(n_, row), upper = at(k, 0), lower = at(k, flat_row_);
    const Point upper_axis = at(0, 0), upper_outer = at(n_, 0), lower_axis = at(0, flat_row_),
                lower_outer = at(n_, flat_row_);
    Point p;
    for (int a = 0; a < 3; ++a) {
      p[a] = (1 - u) * axis[a] + u * outer[a] + (1 - w) * upper[a] + w * lower[a] -
             (1 - w) * ((1 - u) * upper_axis[a] + u * upper_outer[a]) -
             w * ((1 - u) * lower_axis[a] + u * lower_outer[a]);
    }
    return p;
  }

  const HullNet& net_;
  int n_, rows_, flat_row_ = 0;
  double width_ = 0, edge_width_ = 0;                       ///< half widths in the cylinder and at the top's edge, m
  double top_depth_ = 0, edge_depth_ = 0, flat_depth_ = 0;  ///< m below the nose
};

std::vector<Point> core_surface(const HullNet& net, const Core& core) {
  std::vector<Point> points(net.nodes.size());
  const int n = net.division.patch;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) points[net.patch_node(i, j)] = core.top(i, j);
  for (int row = 0; row <= net.division.rows(); ++row)
    for (int c = 0; c <= net.division.columns(); ++c) points[net.ring_node(c, row)] = core.side(c, row);
  return points;
}

void add_core(QuarterMesh& mesh, const HullNet& net, const Core& core, int layers) {
  const int n = net.division.patch, rows = net.division.rows();
  const auto surface_begin = static_cast<std::int32_t>(layers * net.nodes.size());
  const auto inside_begin = static_cast<std::int32_t>(mesh.nodes.size());
  for (int row = 1; row <= rows; ++row)
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) mesh.nodes.push_back(core.inside(i, j, row));
  const auto node = [&](int i, int j, int row) {
    if (i == n || j == n) return surface_begin + net.ring_node(core.column(i, j), row);
    if (row == 0) return surface_begin + net.patch_node(i, j);
    return inside_begin + ((row - 1) * n + i) * n + j;
  };
  for (int row = 0; row < rows; ++row)
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        mesh.elements.push_back({node(i, j, row + 1), node(i + 1, j, row + 1), node(i + 1, j + 1, row + 1),
                                 node(i, j + 1, row + 1), node(i, j, row), node(i + 1, j, row), node(i + 1, j + 1, row),
                                 node(i, j + 1, row)});
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      mesh.hull.push_back({node(i, j, rows), node(i, j + 1, rows), node(i + 1, j + 1, rows), node(i + 1, j, rows)});
      mesh.regions.push_back(HullRegion::base);
    }
}

/// The rings of the base between the hull and the core.
void add_base_rings(QuarterMesh& mesh, const HullNet& net, int layers) {
  const auto count = static_cast<std::int32_t>(net.nodes.size());
  const int last = net.division.rows();
  for (int layer = 0; layer < layers; ++layer)
    for (int c = 0; c < net.division.columns(); ++c) {
      const std::int32_t a = layer * count + net.ring_node(c, last), b = layer * count + net.ring_node(c + 1, last);
      mesh.hull.push_back({a, a + count, b + count, b});
      mesh.regions.push_back(HullRegion::base);
    }
}

}  // namespace

QuarterMesh make_solid_quarter(const Meridian& outline, double size, int layers) {
  const HullNet net = make_hull_net(outline, divide_hull(outline, size), false);
  const Core core(outline, net);
  QuarterMesh mesh = layer_hull(net, core_surface(net, core), layers);
  add_base_rings(mesh, net, layers);
  add_core(mesh, net, core, layers);
  return mesh;
}

}  // namespace polynya::geometry
