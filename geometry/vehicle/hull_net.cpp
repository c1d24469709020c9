#include "geometry/vehicle/hull_net.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace polynya::geometry {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double base_patch_share = 0.58;  ///< half width of the base's patch over the radius: evens out the elements

int divisions(double length, double size) {
  return std::max(1, static_cast<int>(std::lround(length / size)));
}

/// Direction of column c of the rows; exact on the planes of symmetry.
std::array<double, 2> column_direction(int c, int columns) {
  if (c == 0) return {1, 0};
  if (c == columns) return {0, 1};
  const double angle = 0.5 * pi * c / columns;
  return {std::cos(angle), std::sin(angle)};
}

/// Grid indices of the edge of an n x n patch, walked from the plane y = 0 to the plane x = 0.
std::array<int, 2> patch_edge(int column, int n) {
  return column <= n ? std::array<int, 2>{n, column} : std::array<int, 2>{2 * n - column, n};
}

/// Half width of the nose patch, along the head's outline.
double patch_width(const Meridian& outline, int patch, double size) {
  return std::min(patch * size, 0.45 * outline.head_arc());
}

HullNode head_node(const Meridian& outline, double x, double y) {
  HullNode node;
  node.arc = std::min(std::hypot(x, y), outline.head_arc());
  const MeridianPoint p = outline.head_point(node.arc);
  node.depth = p.depth;
  node.radius = p.radius;
  if (node.arc > 0) {
    const double distance = std::hypot(x, y);
    node.cosine = x / distance;
    node.sine = y / distance;
  }
  return node;
}

class NetBuilder {
 public:
  NetBuilder(const Meridian& outline, const HullDivision& division) : outline_(outline) { net_.division = division; }

  void add_head() {
    const HullDivision& d = net_.division;
    const double size = 0.5 * pi * outline_.radius() / d.columns();
    const double width = patch_width(outline_, d.patch, size);
    for (int i = 0; i <= d.patch; ++i)
      for (int j = 0; j <= d.patch; ++j) {
        const auto [x, y] = rounded_square(i, j, d.patch);
        net_.nodes.push_back(head_node(outline_, width * x, width * y));
      }
    for (int row = 1; row <= d.head_rows; ++row)
      for (int column = 0; column <= d.columns(); ++column) {
        const auto [i, j] = patch_edge(column, d.patch);
        const auto inner = rounded_square(i, j, d.patch);
        const auto outer = column_direction(column, d.columns());
        const double share = static_cast<double>(row) / d.head_rows;
        const double arc = outline_.head_arc();
        if (row == d.head_rows) {
          net_.nodes.push_back({arc, outline_.head_length(), outline_.radius(), outer[0], outer[1]});
        } else {
          net_.nodes.push_back(head_node(outline_, (1 - share) * width * inner[0] + share * arc * outer[0],
                                         (1 - share) * width * inner[1] + share * arc * outer[1]));
        }
      }
    patch_quads(0, false, HullRegion::head);
    row_quads(0, d.head_rows, HullRegion::head);
  }

  void add_cylinder() {
    const HullDivision& d = net_.division;
    for (int row = 1; row <= d.cylinder_rows; ++row) {
      const double share = static_cast<double>(row) / d.cylinder_rows;
      const double depth = (1 - share) * outline_.head_length() + share * outline_.length();
      for (int column = 0; column <= d.columns(); ++column) {
        const auto direction = column_direction(column, d.columns());
        net_.nodes.push_back({0, depth, outline_.radius(), direction[0], direction[1]});
      }
    }
    row_quads(d.head_rows, d.rows(), HullRegion::cylinder);
  }

  void add_base() {
    const HullDivision& d = net_.division;
    const double width = base_patch_share * outline_.radius();
    for (int row = 1; row < d.base_rows; ++row)
      for (int column = 0; column <= d.columns(); ++column) {
        const auto [i, j] = patch_edge(column, d.patch);
        const auto inner = rounded_square(i, j, d.patch);
        const auto outer = column_direction(column, d.columns());
        const double share = static_cast<double>(row) / d.base_rows;
        add_base_node((1 - share) * outline_.radius() * outer[0] + share * width * inner[0],
                      (1 - share) * outline_.radius() * outer[1] + share * width * inner[1]);
      }
    const auto patch_begin = static_cast<std::int32_t>(net_.nodes.size());
    for (int i = 0; i <= d.patch; ++i)
      for (int j = 0; j <= d.patch; ++j) {
        const auto [x, y] = rounded_square(i, j, d.patch);
        add_base_node(width * x, width * y);
      }
    base_row_quads(patch_begin);
    patch_quads(patch_begin, true, HullRegion::base);
  }

  HullNet take() { return std::move(net_); }

 private:
  void add_base_node(double x, double y) {
    const double radius = std::hypot(x, y);
    HullNode node{0, outline_.length(), radius, 1, 0};
    if (radius > 0) {
      node.cosine = x / radius;
      node.sine = y / radius;
    }
    net_.nodes.push_back(node);
  }

  void add_quad(std::array<std::int32_t, 4> quad, HullRegion region) {
    net_.quads.push_back(quad);
    net_.regions.push_back(region);
  }

  void patch_quads(std::int32_t begin, bool facing_down, HullRegion region) {
    const int n = net_.division.patch;
    const auto node = [&](int i, int j) { return begin + i * (n + 1) + j; };
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        if (facing_down)
          add_quad({node(i, j), node(i, j + 1), node(i + 1, j + 1), node(i + 1, j)}, region);
        else
          add_quad({node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)}, region);
      }
  }

  void row_quads(int first, int last, HullRegion region) {
    for (int row = first; row < last; ++row)
      for (int c = 0; c < net_.division.columns(); ++c)
        add_quad({net_.ring_node(c, row), net_.ring_node(c, row + 1), net_.ring_node(c + 1, row + 1),
                  net_.ring_node(c + 1, row)},
                 region);
  }

  void base_row_quads(std::int32_t patch_begin) {
    const HullDivision& d = net_.division;
    const auto node = [&](int c, int row) {
      if (row < d.base_rows) return net_.ring_node(c, d.rows() + row);
      const auto [i, j] = patch_edge(c, d.patch);
      return patch_begin + i * (d.patch + 1) + j;
    };
    for (int row = 0; row < d.base_rows; ++row)
      for (int c = 0; c < d.columns(); ++c)
        add_quad({node(c, row), node(c, row + 1), node(c + 1, row + 1), node(c + 1, row)}, HullRegion::base);
  }

  const Meridian& outline_;
  HullNet net_;
};

}  // namespace

std::array<double, 2> rounded_square(int i, int j, int n) {
  const double u = static_cast<double>(i) / n, v = static_cast<double>(j) / n;
  const double radius = std::max(u, v);
  std::array<double, 2> circle = {radius, 0};
  if (i == 0) {
    circle = {0, radius};
  } else if (j > 0) {
    const double angle = j <= i ? 0.25 * pi * v / u : 0.5 * pi - 0.25 * pi * u / v;
    circle = {radius * std::cos(angle), radius * std::sin(angle)};
  }
  return {0.5 * (u + circle[0]), 0.5 * (v + circle[1])};
}

std::int32_t HullNet::ring_node(int column, int row) const {
  if (row == 0) {
    const auto [i, j] = patch_edge(column, division.patch);
    return patch_node(i, j);
  }
  const int patch_nodes = (division.patch + 1) * (division.patch + 1);
  return patch_nodes + (row - 1) * (division.columns() + 1) + column;
}

HullDivision divide_hull(const Meridian& outline, double size) {
  HullDivision d;
  d.patch = std::max(2, divisions(0.25 * pi * outline.radius(), size));
  const double actual = 0.25 * pi * outline.radius() / d.patch;
  d.head_rows = divisions(outline.head_arc() - 1.1 * patch_width(outline, d.patch, actual), size);
  d.cylinder_rows = std::max(3, divisions(outline.length() - outline.head_length(), size));
  // Rather too few than too many: the corner of the base is where a thin shell has its smallest elements.
  d.base_rows = std::max(1, static_cast<int>((1 - base_patch_share) * outline.radius() / size + 0.25));
  return d;
}

HullNet make_hull_net(const Meridian& outline, const HullDivision& division, bool with_base) {
  NetBuilder builder(outline, division);
  builder.add_head();
  builder.add_cylinder();
  if (with_base) builder.add_base();
  return builder.take();
}

}  // namespace polynya::geometry
