#pragma once
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/IO/STL.h>
#include <gtest/gtest.h>

#include <sstream>

#include "geometry/exact_cut.hpp"
#include "geometry/surface_check.hpp"
#include "geometry/vehicle/vehicle_mesh.hpp"
#include "shapes.hpp"

/// Four kinds of bodies at random places in a graded grid, and how far their cut is from CGAL's exact one.
namespace random_bodies {

using namespace polynya::geometry;
using shapes::Shape;

inline const GridLines grid{
    {shapes::lines(-1.6, 1.7, 13), shapes::lines(-1.65, 1.6, 11, 0.9), shapes::lines(-1.7, 1.6, 15, 1.1)}};

/// The hull of the vehicle, closed by its base, of length 1.6.
inline Shape vehicle() {
  const Meridian outline(HeadShape::ogive, 0.01, 0.01, 0.1);
  VehicleMeshOptions options;
  options.element_size = 2.5e-3;
  const VehicleMesh mesh = make_vehicle_mesh(outline, options);
  Shape shape;
  for (const std::int32_t node : mesh.hull_nodes) {
    const double* x = mesh.hexahedra.nodes.data() + 3 * static_cast<std::size_t>(node);
    shape.positions.insert(shape.positions.end(), x, x + 3);
  }
  shape.triangles = mesh.hull_triangles;
  shape.rest();
  shapes::scale_and_move(shape, {16, 16, 16}, {0, 0, 0.8});
  return shape;
}

/// A body with bulges and hollows as a file brings it: written as STL text with six digits, read back, corners joined.
inline Shape imported() {
  Shape body = shapes::sphere(3);
  body.transform([](shapes::Vector p) {
    const double r = 0.75 + 0.25 * std::sin(4 * p[0]) * std::cos(3 * p[1]) + 0.1 * p[2] * p[2];
    return shapes::Vector{r * p[0], r * p[1], 0.8 * r * p[2]};
  });
  std::stringstream text;
  text << "solid bulges\n";
  for (std::size_t t = 0; t < body.triangles.size(); t += 3) {
    text << "facet normal 0 0 0\nouter loop\n";
    for (std::size_t c = 0; c < 3; ++c) {
      const shapes::Vector p = body.vertex(body.triangles[t + c]);
      text << "vertex " << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
    }
    text << "endloop\nendfacet\n";
  }
  text << "endsolid bulges\n";
  using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
  std::vector<Point> points;
  std::vector<std::array<std::size_t, 3>> triangles;
  EXPECT_TRUE(CGAL::IO::read_STL(text, points, triangles));
  Shape read;
  for (const Point& p : points) shapes::add_vertex(read, {p.x(), p.y(), p.z()});
  for (const auto& triangle : triangles)
    for (const std::size_t vertex : triangle) read.triangles.push_back(static_cast<std::int32_t>(vertex));
  read.rest();
  const SurfaceCheck check = check_surface(read.positions, read.triangles);
  EXPECT_TRUE(check.good()) << check.text;
  return read;
}

inline std::vector<Shape> bodies() {
  Shape ball = shapes::sphere(3), rod = shapes::cylinder(32);
  shapes::scale_and_move(ball, {0.9, 0.9, 0.9}, {0, 0, 0});
  shapes::scale_and_move(rod, {0.35, 0.35, 0.9}, {0, 0, 0});
  return {ball, rod, vehicle(), imported()};
}

inline Shape placed_at_random(const Shape& body, std::mt19937& random) {
  std::uniform_real_distribution<double> shift(-0.4, 0.4);
  Shape placed = body;
  shapes::rotate_randomly(placed, random);
  shapes::scale_and_move(placed, {1, 1, 1}, {shift(random), shift(random), shift(random)});
  return placed;
}

inline std::vector<std::size_t> cells_with_wall(const CutCells& cut) {
  std::vector<std::size_t> entries;
  for (std::size_t e = 0; e < cut.cell.size(); ++e)
    if (cut.walled[e]) entries.push_back(e);
  return entries;
}

/// Largest difference from the exact cut in one cell: of volume, and of area vector over the cell's smallest face.
inline double exact_difference(const CutCells& cut, std::size_t entry, const BodySurface& body) {
  const ExactCell exact = exact_cut(grid, cut.cell[entry], body);
  const auto p = grid.cell_position(cut.cell[entry]);
  const double volume = grid.cell_volume(cut.cell[entry]);
  const double face = volume / std::max({grid.width(0, p[0]), grid.width(1, p[1]), grid.width(2, p[2])});
  double worst = std::abs(cut.body_volume[entry] - exact.volume) / volume;
  for (std::size_t d = 0; d < 3; ++d)
    worst = std::max(worst, std::abs(cut.wall_area[3 * entry + d] + exact.area[d]) / face);
  return worst;
}

}  // namespace random_bodies
