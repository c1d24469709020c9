#pragma once
#include <gtest/gtest.h>

#include "closure.hpp"
#include "geometry/exact_cut.hpp"
#include "shapes.hpp"

/// Two boxes along the axes, whose union is known in every cell and face.
namespace union_boxes {

using namespace polynya::geometry;
using shapes::Shape;
using shapes::Vector;

inline constexpr int cells = 8;
inline constexpr double h = 0.25;
inline const GridLines grid = shapes::cube_grid(1.0, cells);  // no box comes within half a cell of its walls

struct Bounds {
  Vector low, high;
  Shape shape(int divisions) const {
    Shape s = shapes::box(divisions);
    Vector half, centre;
    for (std::size_t d = 0; d < 3; ++d) half[d] = 0.5 * (high[d] - low[d]), centre[d] = 0.5 * (high[d] + low[d]);
    shapes::scale_and_move(s, half, centre);
    return s;
  }
};

inline Bounds common(const Bounds& a, const Bounds& b) {
  Bounds c;
  for (std::size_t d = 0; d < 3; ++d)
    c.low[d] = std::max(a.low[d], b.low[d]), c.high[d] = std::min(a.high[d], b.high[d]);
  return c;
}

/// Product of the lengths along the axes but `without`.
inline double measure(const Bounds& b, std::size_t without = 3) {
  double product = 1;
  for (std::size_t d = 0; d < 3; ++d)
    if (d != without) product *= std::max(0.0, b.high[d] - b.low[d]);
  return product;
}

inline Bounds cell_bounds(std::int64_t cell) {
  const auto p = grid.cell_position(cell);
  Bounds b;
  for (std::size_t d = 0; d < 3; ++d)
    b.low[d] = grid.lines[d][static_cast<std::size_t>(p[d])],
    b.high[d] = grid.lines[d][static_cast<std::size_t>(p[d]) + 1];
  return b;
}

inline double union_in(const Bounds& a, const Bounds& b, const Bounds& cell) {
  return measure(common(a, cell)) + measure(common(b, cell)) - measure(common(common(a, b), cell));
}

/// What a box covers of the cross-section of `cell` at x along an axis. Sides in the plane count as beyond it.
inline double section(const Bounds& box, const Bounds& cell, std::size_t axis, double x) {
  if (box.low[axis] > x || box.high[axis] < x || !(box.low[axis] < box.high[axis])) return 0;
  return measure(common(box, cell), axis);
}

inline double largest_error(const CutCells& cut, const Bounds& a, const Bounds& b) {
  double worst = 0;
  std::vector<double> volume(static_cast<std::size_t>(grid.cell_count()), 0.0);
  for (std::size_t e = 0; e < cut.cell.size(); ++e) volume[static_cast<std::size_t>(cut.cell[e])] = cut.solid_volume[e];
  for (std::int64_t c = 0; c < grid.cell_count(); ++c)
    worst =
        std::max(worst, std::abs(volume[static_cast<std::size_t>(c)] - union_in(a, b, cell_bounds(c))) / (h * h * h));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::array<std::int64_t, 3> n{cells, cells, cells};
    ++n[axis];
    std::vector<double> solid(static_cast<std::size_t>(n[0] * n[1] * n[2]), 0.0);
    for (std::size_t f = 0; f < cut.faces[axis].face.size(); ++f)
      solid[static_cast<std::size_t>(cut.faces[axis].face[f])] = cut.faces[axis].solid[f];
    for (std::int64_t c = 0; c < grid.cell_count(); ++c) {
      const auto p = grid.cell_position(c);
      if (p[axis] == 0) continue;  // walls of the grid
      const Bounds cell = cell_bounds(c);
      const double x = cell.low[axis];
      const Bounds both = common(a, b);
      double expected = section(a, cell, axis, x) + section(b, cell, axis, x);
      if (section(a, cell, axis, x) > 0 && section(b, cell, axis, x) > 0) expected -= measure(common(both, cell), axis);
      const auto f = static_cast<std::size_t>(p[0] + n[0] * (p[1] + n[1] * p[2]));
      worst = std::max(worst, std::abs(solid[f] - expected / (h * h)));
    }
  }
  return worst;
}

inline CutCells cut_of(const Shape& a, const Shape& b, bool exactly = false) {
  Cutter cutter(grid);
  cutter.set_exact_union(add_below_exactly, exactly);
  CutCells cut;
  cutter.cut(std::array{a.surface(), b.surface()}, cut);
  return cut;
}

inline void expect_closed(const CutCells& cut) {
  const Closure closure = check_closure(cut, grid);
  EXPECT_LT(closure.area, 1e-12);
  EXPECT_LT(closure.pieces, 1e-12);
  EXPECT_LE(closure.fraction, 0.0);
  EXPECT_TRUE(closure.sorted);
  EXPECT_EQ(cut.doubted_unions, 0);
}

inline double wetted(const CutCells& cut) {
  double size = 0;
  for (const WallPiece& p : cut.pieces) size += std::hypot(p.area[0], p.area[1], p.area[2]);
  return size;
}

inline Bounds random_box(std::mt19937& random, bool lattice) {
  std::uniform_int_distribution<int> half(-5, 5);
  std::uniform_real_distribution<double> anywhere(-0.7, 0.7);
  Bounds b;
  for (std::size_t d = 0; d < 3; ++d) {
    double low, high;
    do {
      low = lattice && random() % 8 != 0 ? 0.5 * h * half(random) : anywhere(random);
      high = lattice && random() % 8 != 0 ? 0.5 * h * half(random) : anywhere(random);
    } while (!(high - low > 0.02));
    b.low[d] = low, b.high[d] = high;
  }
  return b;
}

/// Boxes whose sides like to lie in planes of the grid, halfway between them, or in each other's planes.
inline void expect_degenerate_pairs(unsigned seed, int trials) {
  std::mt19937 random(seed);
  double worst = 0;
  std::int64_t united = 0, exactly = 0;
  for (int trial = 0; trial < trials && !testing::Test::HasFailure(); ++trial) {
    SCOPED_TRACE(trial);
    const Bounds a = random_box(random, true), b = trial % 50 == 0 ? a : random_box(random, true);
    const CutCells cut = cut_of(a.shape(1 + trial % 3), b.shape(1 + trial % 2));
    const double error = largest_error(cut, a, b);
    EXPECT_LT(error, 1e-11);
    expect_closed(cut);
    worst = std::max(worst, error);
    united += cut.united_cells;
    exactly += cut.united_exactly;
  }
  std::printf("%ld cells united, %ld looked at exactly; largest error %.1e\n", static_cast<long>(united),
              static_cast<long>(exactly), worst);
}

/// The same turned together: planes, edges and corners coincide to rounding.
inline void expect_turned_pairs(unsigned seed, int trials) {
  std::mt19937 random(seed);
  double worst = 0;
  std::int64_t united = 0, exactly = 0;
  for (int trial = 0; trial < trials && !testing::Test::HasFailure(); ++trial) {
    SCOPED_TRACE(trial);
    const Bounds a = random_box(random, true), b = trial % 50 == 0 ? a : random_box(random, true);
    Shape first = a.shape(1 + trial % 3), second = b.shape(1 + trial % 2);
    std::mt19937 turn(static_cast<unsigned>(trial)), same = turn;
    shapes::rotate_randomly(first, turn);
    shapes::rotate_randomly(second, same);
    constexpr double scale = 0.7;  // stays inside
    for (Shape* s : {&first, &second}) shapes::scale_and_move(*s, {scale, scale, scale}, {0, 0, 0});
    const CutCells cut = cut_of(first, second);
    const double volume = scale * scale * scale * (measure(a) + measure(b) - measure(common(a, b)));
    EXPECT_NEAR(total_volume(cut), volume, 1e-13);
    expect_closed(cut);
    worst = std::max(worst, std::abs(total_volume(cut) - volume));
    united += cut.united_cells;
    exactly += cut.united_exactly;
  }
  std::printf("%ld cells united, %ld looked at exactly; largest error %.1e m^3\n", static_cast<long>(united),
              static_cast<long>(exactly), worst);
}

}  // namespace union_boxes
