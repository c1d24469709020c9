#include "geometry/exact_cut.hpp"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include "geometry/placed_surface.hpp"

namespace polynya::geometry {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Number = Kernel::FT;
using Point = Kernel::Point_3;
using Triangle = Kernel::Triangle_3;
using Box = Kernel::Iso_cuboid_3;
using Vector = Kernel::Vector_3;

/// The nearest double; the conversion of a number not yet evaluated is only good to 1e-5.
double rounded(const Number& x) {
  return CGAL::to_double(CGAL::exact(x));
}

/// The corners of triangle ∩ box; fewer than three when they only touch.
std::vector<Point> intersect(const Triangle& triangle, const Box& box) {
  const auto result = CGAL::intersection(triangle, box);
  if (!result) return {};
  if (const Triangle* piece = boost::get<Triangle>(&*result))
    return {piece->vertex(0), piece->vertex(1), piece->vertex(2)};
  if (const std::vector<Point>* polygon = boost::get<std::vector<Point>>(&*result)) return *polygon;
  return {};
}

/// Sums of a convex polygon in the plane of a triangle with normal n (any length).
struct PolygonSums {
  Vector area{0, 0, 0};      ///< along n
  Number height_moment = 0;  ///< integral of (z - floor) n_z dA
};

PolygonSums sums_of(const std::vector<Point>& polygon, const Vector& normal, const Number& floor) {
  PolygonSums sums;
  for (std::size_t c = 2; c < polygon.size(); ++c) {
    Vector area = CGAL::cross_product(polygon[c - 1] - polygon[0], polygon[c] - polygon[0]) / Number(2);
    if (area * normal < 0) area = -area;
    sums.area = sums.area + area;
    const Number mean_height = (polygon[0].z() + polygon[c - 1].z() + polygon[c].z()) / Number(3) - floor;
    sums.height_moment += mean_height * area.z();
  }
  return sums;
}

/// The corners of one body, placed on a grid, and the exact cut of any of its cells.
class ExactBody {
 public:
  ExactBody(const GridLines& grid, const BodySurface& surface) : grid_(grid), triangles_(surface.triangles) {
    std::array<LineLocator, 3> locators;
    for (std::size_t axis = 0; axis < 3; ++axis) locators[axis] = LineLocator(grid.lines[axis]);
    placed_.place(surface, locators);
    for (const Corner& corner : placed_.corners()) highest_ = std::max(highest_, corner.x[2]);
  }

  ExactCell cut(std::int64_t cell) const {
    const auto p = grid_.cell_position(cell);
    std::array<double, 3> low, high;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = grid_.lines[axis][static_cast<std::size_t>(p[axis])];
      high[axis] = grid_.lines[axis][static_cast<std::size_t>(p[axis]) + 1];
    }
    const Box inside(Point(low[0], low[1], low[2]), Point(high[0], high[1], high[2]));
    const double ceiling = std::max(highest_, high[2]) + 1.0;
    const Box above(Point(low[0], low[1], high[2]), Point(high[0], high[1], ceiling));
    const Number floor(low[2]), height = Number(high[2]) - floor;
    Number volume = 0;
    Vector area(0, 0, 0);
    for (std::size_t t = 0; t < triangles_.size(); t += 3) {
      if (misses(t, low, high)) continue;
      const Triangle triangle(point(t), point(t + 1), point(t + 2));
      const Vector normal =
          CGAL::cross_product(triangle.vertex(1) - triangle.vertex(0), triangle.vertex(2) - triangle.vertex(0));
      if (normal == CGAL::NULL_VECTOR) continue;
      const PolygonSums wall = sums_of(intersect(triangle, inside), normal, floor);
      area = area + wall.area;
      volume += wall.height_moment;
      const bool in_ceiling = lowest(t) == high[2] && highest(t) == high[2];  // then both boxes hold it
      if (!in_ceiling) volume += height * sums_of(intersect(triangle, above), normal, floor).area.z();
    }
    return {rounded(volume), {rounded(area.x()), rounded(area.y()), rounded(area.z())}};
  }

 private:
  const Corner& corner(std::size_t c) const { return placed_.corners()[static_cast<std::size_t>(triangles_[c])]; }
  Point point(std::size_t c) const { return {corner(c).x[0], corner(c).x[1], corner(c).x[2]}; }

  double lowest(std::size_t t) const { return std::min({corner(t).x[2], corner(t + 1).x[2], corner(t + 2).x[2]}); }
  double highest(std::size_t t) const { return std::max({corner(t).x[2], corner(t + 1).x[2], corner(t + 2).x[2]}); }

  bool misses(std::size_t t, const std::array<double, 3>& low, const std::array<double, 3>& high) const {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double a = corner(t).x[axis], b = corner(t + 1).x[axis], c = corner(t + 2).x[axis];
      if (std::max({a, b, c}) < low[axis]) return true;
      if (axis < 2 && std::min({a, b, c}) > high[axis]) return true;
    }
    return false;
  }

  const GridLines& grid_;
  std::span<const std::int32_t> triangles_;
  PlacedSurface placed_;
  double highest_ = -1e300;
};

}  // namespace

ExactCell exact_cut(const GridLines& grid, std::int64_t cell, const BodySurface& body) {
  return ExactBody(grid, body).cut(cell);
}

double verify_sample(const CutCells& cut, std::span<const BodySurface> bodies, const GridLines& grid,
                     std::uint64_t seed, std::size_t count) {
  std::vector<std::int64_t> entries;
  for (const WallPiece& piece : cut.pieces) entries.push_back(piece.entry);
  std::ranges::sort(entries);
  entries.erase(std::ranges::unique(entries).begin(), entries.end());
  std::mt19937_64 random(seed);
  std::vector<std::int64_t> chosen;
  std::ranges::sample(entries, std::back_inserter(chosen), static_cast<std::ptrdiff_t>(count), random);
  double worst = 0;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const ExactBody body(grid, bodies[b]);
    for (std::int64_t entry : chosen) {
      const std::int64_t cell = cut.cell[static_cast<std::size_t>(entry)];
      const double difference =
          body.cut(cell).volume - cut.body_volume[static_cast<std::size_t>(entry) * bodies.size() + b];
      worst = std::max(worst, std::abs(difference) / grid.cell_volume(cell));
    }
  }
  return worst;
}

std::size_t recut_uncertain(CutCells& cut, std::span<const BodySurface> bodies, const GridLines& grid) {
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    std::optional<ExactBody> body;
    for (const UncertainVolume& doubt : cut.uncertain) {
      if (doubt.body != static_cast<std::int32_t>(b)) continue;
      if (!body) body.emplace(grid, bodies[b]);
      const auto entry = static_cast<std::size_t>(doubt.entry);
      double& volume = cut.body_volume[entry * cut.bodies + b];
      const double exact = body->cut(cut.cell[entry]).volume;
      cut.solid_volume[entry] += exact - volume;  // what two bodies have in common stays
      volume = exact;
    }
  }
  for (const UncertainVolume& doubt : cut.uncertain) {
    const auto entry = static_cast<std::size_t>(doubt.entry);
    cut.solid_volume[entry] = std::clamp(cut.solid_volume[entry], 0.0, grid.cell_volume(cut.cell[entry]));
  }
  return cut.uncertain.size();
}

}  // namespace polynya::geometry
