// Ten thousand degenerate configurations: boxes whose sides touch planes, lines, corners and walls of the grid; bodies
// with corners on nodes and faces through them; needles, slivers of no area, doubled corners and triangles. References:
// the product of three lengths, the same body without the degeneracy, and CGAL's exact numbers.
#include <gtest/gtest.h>

#include "closure.hpp"
#include "geometry/exact_cut.hpp"
#include "shapes.hpp"

using namespace polynya::geometry;
using shapes::Shape;
using shapes::Vector;

namespace {

constexpr int cells = 8;
const GridLines grid = shapes::cube_grid(1.0, cells);  // cells of 1/4
constexpr double h = 0.25;

CutCells cut_of(const Shape& body) {
  static Cutter cutter(grid);
  CutCells cut;
  cutter.cut(std::array{body.surface()}, cut);
  return cut;
}

void expect_closed(const CutCells& cut) {
  const Closure closure = check_closure(cut, grid);
  EXPECT_LT(closure.area, 1e-12);
  EXPECT_LT(closure.pieces, 1e-12);
  EXPECT_LE(closure.fraction, 0.0);
  EXPECT_TRUE(closure.sorted);
}

std::vector<double> volumes(const CutCells& cut) {
  std::vector<double> all(static_cast<std::size_t>(grid.cell_count()), 0.0);
  for (std::size_t e = 0; e < cut.cell.size(); ++e) all[static_cast<std::size_t>(cut.cell[e])] = cut.body_volume[e];
  return all;
}

std::vector<double> fractions(const CutCells& cut, std::size_t axis) {
  std::vector<double> all(static_cast<std::size_t>((cells + 1) * cells * cells), 0.0);
  for (std::size_t f = 0; f < cut.faces[axis].face.size(); ++f)
    all[static_cast<std::size_t>(cut.faces[axis].face[f])] = cut.faces[axis].solid[f];
  return all;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double worst = 0;
  for (std::size_t c = 0; c < a.size(); ++c) worst = std::max(worst, std::abs(a[c] - b[c]));
  return worst;
}

/// Of volumes and of the cut itself, over the cell's.
void expect_same_solid(const CutCells& cut, const CutCells& reference) {
  EXPECT_LT(largest_difference(volumes(cut), volumes(reference)), 1e-12 * h * h * h);
  for (std::size_t axis = 0; axis < 3; ++axis)
    EXPECT_LT(largest_difference(fractions(cut, axis), fractions(reference, axis)), 1e-11);
}

void expect_exact_somewhere(const CutCells& cut, const Shape& body, std::mt19937& random, int samples) {
  for (int s = 0; s < samples && !cut.cell.empty(); ++s) {
    const std::size_t e = random() % cut.cell.size();
    const ExactCell exact = exact_cut(grid, cut.cell[e], body.surface());
    EXPECT_NEAR(cut.body_volume[e] / (h * h * h), exact.volume / (h * h * h), 1e-11) << "cell " << cut.cell[e];
  }
}

/// Coordinates that like to lie on planes, halfway between them, or a rounding beside them.
double on_lattice(std::mt19937& random) {
  std::uniform_int_distribution<int> half(-10, 10), kind(0, 9);  // beyond the grid, too
  std::uniform_real_distribution<double> anywhere(-1.2, 1.2);
  const double place = 0.5 * h * half(random);
  const int what = kind(random);
  return what == 0 ? anywhere(random) : what == 1 ? place * (1 + 1e-16) : what == 2 ? place - 1e-15 : place;
}

double common(double a, double b, double c, double d) {
  return std::max(0.0, std::min(b, d) - std::max(a, c));
}

double line(int i) {
  return grid.lines[0][static_cast<std::size_t>(i)];
}

/// Sides between `low` and `high`: volumes and fractions must be the products of the lengths in common.
void expect_box(const CutCells& cut, Vector low, Vector high) {
  for (std::size_t d = 0; d < 3; ++d) {  // sides within half a cell of a wall that they face rest on it
    if (std::abs(low[d] - line(0)) < 0.5 * h) low[d] = line(0);
    if (std::abs(high[d] - line(cells)) < 0.5 * h) high[d] = line(cells);
  }
  std::array<std::array<double, cells>, 3> length{};
  std::array<std::array<bool, cells + 1>, 3> inside{};
  for (std::size_t d = 0; d < 3; ++d) {
    for (int i = 0; i < cells; ++i)
      length[d][static_cast<std::size_t>(i)] = common(low[d], high[d], line(i), line(i + 1)) / h;
    // A plane that a side lies on is closed by it: the wall belongs to the cell that it faces. What only touches the
    // grid from outside closes nothing.
    for (int i = 0; i <= cells; ++i)
      inside[d][static_cast<std::size_t>(i)] = low[d] <= line(i) + 1e-13 && line(i) <= high[d] + 1e-13 &&
                                               low[d] < line(cells) - 1e-9 * h && high[d] > line(0) + 1e-9 * h;
  }
  const std::vector<double> volume = volumes(cut);
  double worst = 0;
  for (std::size_t k = 0; k < cells; ++k)
    for (std::size_t j = 0; j < cells; ++j)
      for (std::size_t i = 0; i < cells; ++i)
        worst = std::max(worst, std::abs(volume[i + cells * (j + cells * k)] / (h * h * h) -
                                         length[0][i] * length[1][j] * length[2][k]));
  EXPECT_LT(worst, 1e-11);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::vector<double> solid = fractions(cut, axis);
    std::array<std::size_t, 3> n{cells, cells, cells};
    ++n[axis];
    for (std::size_t k = 0; k < n[2]; ++k)
      for (std::size_t j = 0; j < n[1]; ++j)
        for (std::size_t i = 0; i < n[0]; ++i) {
          const std::array<std::size_t, 3> at{i, j, k};
          const std::size_t u = (axis + 1) % 3, w = (axis + 2) % 3;
          const double expected = inside[axis][at[axis]] ? length[u][at[u]] * length[w][at[w]] : 0.0;
          ASSERT_NEAR(solid[i + n[0] * (j + n[1] * k)], expected, 1e-11)
              << "axis " << axis << " face " << i << ' ' << j << ' ' << k;
        }
  }
}

/// Puts a vertex at `share` of a randomly chosen edge into both triangles beside it.
void split_edge(Shape& body, double share, std::mt19937& random) {
  const std::size_t t = random() % (body.triangles.size() / 3), side = random() % 3;
  const std::int32_t a = body.triangles[3 * t + side], b = body.triangles[3 * t + (side + 1) % 3];
  const Vector p = body.vertex(a), q = body.vertex(b);
  const std::int32_t middle = shapes::add_vertex(
      body, {p[0] + share * (q[0] - p[0]), p[1] + share * (q[1] - p[1]), p[2] + share * (q[2] - p[2])});
  const std::size_t count = body.triangles.size();
  for (std::size_t s = 0; s < count; s += 3)
    for (std::size_t c = 0; c < 3; ++c) {
      const std::int32_t from = body.triangles[s + c], to = body.triangles[s + (c + 1) % 3],
                         third = body.triangles[s + (c + 2) % 3];
      if (!((from == a && to == b) || (from == b && to == a))) continue;
      body.triangles[s] = from, body.triangles[s + 1] = middle, body.triangles[s + 2] = third;
      body.triangles.insert(body.triangles.end(), {middle, to, third});
      break;
    }
  body.rest();
}

Shape some_body(std::mt19937& random) {
  const auto kind = random() % 3;
  Shape body = kind == 0 ? shapes::sphere(1) : kind == 1 ? shapes::cylinder(8) : shapes::box(2);
  shapes::scale_and_move(body, {0.45, 0.4, 0.35}, {0, 0, 0});
  shapes::rotate_randomly(body, random);
  std::uniform_real_distribution<double> shift(-0.2, 0.2);
  shapes::scale_and_move(body, {1, 1, 1}, {shift(random), shift(random), shift(random)});
  return body;
}

}  // namespace

TEST(DegenerateCuts, BoxesThatTouchPlanesLinesCornersAndWallsTakeTheProductOfLengths) {
  std::mt19937 random(61);
  for (int trial = 0; trial < 4000; ++trial) {
    Vector low, high;
    for (std::size_t d = 0; d < 3; ++d) {
      do {
        low[d] = on_lattice(random), high[d] = on_lattice(random);
        if (low[d] > high[d]) std::swap(low[d], high[d]);
      } while (high[d] - low[d] < 0.1 * h);
    }
    Shape body = shapes::box(1 + trial % 3);
    body.transform([&](Vector p) {
      for (std::size_t d = 0; d < 3; ++d)
        p[d] = p[d] == -1 ? low[d] : p[d] == 1 ? high[d] : low[d] + 0.5 * (p[d] + 1) * (high[d] - low[d]);
      return p;
    });
    const CutCells cut = cut_of(body);
    expect_closed(cut);
    expect_box(cut, low, high);
    if (::testing::Test::HasFailure())
      FAIL() << "trial " << trial << " low " << low[0] << ' ' << low[1] << ' ' << low[2] << " high " << high[0] << ' '
             << high[1] << ' ' << high[2];
  }
}

TEST(DegenerateCuts, CornersOnNodesAndFacesThroughThemGiveTheExactVolume) {
  std::mt19937 random(67);
  std::uniform_int_distribution<int> place(-3, 3);
  for (int trial = 0; trial < 2000; ++trial) {
    // An octahedron or a tetrahedron between nodes: sides run along diagonals of cells and through their corners.
    Shape body;
    const Vector centre{h * place(random), h * place(random), h * place(random)};
    const double r = h * (1 + trial % 3);
    if (trial % 2) {
      for (std::size_t d = 0; d < 3; ++d)
        for (const double sign : {-1.0, 1.0}) {
          Vector p = centre;
          p[d] += sign * r;
          shapes::add_vertex(body, p);
        }
      body.triangles = {1, 3, 5, 3, 0, 5, 0, 2, 5, 2, 1, 5, 3, 1, 4, 0, 3, 4, 2, 0, 4, 1, 2, 4};
    } else {
      for (const Vector& p : std::vector<Vector>{{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}})
        shapes::add_vertex(body, {centre[0] + r * p[0], centre[1] + r * p[1], centre[2] + r * p[2]});
      body.triangles = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    }
    if (shapes::volume(body) < 0)
      for (std::size_t t = 0; t < body.triangles.size(); t += 3) std::swap(body.triangles[t], body.triangles[t + 1]);
    body.rest();
    const CutCells cut = cut_of(body);
    expect_closed(cut);
    expect_exact_somewhere(cut, body, random, 2);
    if (::testing::Test::HasFailure()) FAIL() << "trial " << trial;
  }
}

TEST(DegenerateCuts, NeedlesAndSliversDoNotChangeTheSolid) {
  std::mt19937 random(71);
  std::uniform_real_distribution<double> exponent(-17, -1);
  for (int trial = 0; trial < 2000; ++trial) {
    const Shape plain = some_body(random);
    Shape body = plain;
    for (int n = 0; n < 8; ++n) split_edge(body, std::pow(10.0, exponent(random)), random);
    const CutCells cut = cut_of(body);
    expect_closed(cut);
    expect_same_solid(cut, cut_of(plain));
    if (::testing::Test::HasFailure()) FAIL() << "trial " << trial;
  }
}

TEST(DegenerateCuts, DoubledCornersAndTrianglesBackToBackDoNotChangeTheSolid) {
  std::mt19937 random(73);
  for (int trial = 0; trial < 1000; ++trial) {
    const Shape plain = some_body(random);
    Shape body;
    for (std::size_t t = 0; t < plain.triangles.size(); ++t)  // every triangle has corners of its own
      body.triangles.push_back(shapes::add_vertex(body, plain.vertex(plain.triangles[t])));
    for (int n = 0; n < 5; ++n) {  // a leaf of no thickness
      const std::size_t t = 3 * (random() % (plain.triangles.size() / 3));
      const std::int32_t a = body.triangles[t], b = body.triangles[t + 1], c = body.triangles[t + 2];
      body.triangles.insert(body.triangles.end(), {a, b, c, c, b, a});
    }
    body.rest();
    const CutCells cut = cut_of(body);
    expect_closed(cut);
    expect_same_solid(cut, cut_of(plain));
    if (::testing::Test::HasFailure()) FAIL() << "trial " << trial;
  }
}

TEST(DegenerateCuts, CornersRoundedToTheLatticeGiveTheExactVolume) {
  // Rounding may fold a body or turn it inside out in places; volumes are signed then, and still exact.
  std::mt19937 random(79);
  for (int trial = 0; trial < 1000; ++trial) {
    Shape body = some_body(random);
    const double unit = trial % 2 ? h : 0.5 * h;
    body.transform([&](Vector p) {
      for (double& x : p) x = unit * std::round(x / unit);
      return p;
    });
    const CutCells cut = cut_of(body);
    expect_closed(cut);
    double sum = 0;
    for (const double volume : cut.body_volume) sum += volume;
    EXPECT_NEAR(sum, shapes::volume(body), 1e-13);
    expect_exact_somewhere(cut, body, random, 2);
    if (::testing::Test::HasFailure()) FAIL() << "trial " << trial;
  }
}
