#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/alpha_wrap_3.h>

#include <algorithm>
#include <cmath>

#include "geometry/hull/check_hull.hpp"

namespace polynya::geometry {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Place = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Place>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Tree =
    CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>>>;

Triangles triangles_of(const TriangleSoup& soup) {
  Triangles triangles;
  const auto place = [&](std::size_t v) { return Place(soup.points[v][0], soup.points[v][1], soup.points[v][2]); };
  for (const Triangle& t : soup.triangles) {
    const Kernel::Triangle_3 triangle(place(t[0]), place(t[1]), place(t[2]));
    if (!triangle.is_degenerate()) triangles.push_back(triangle);
  }
  return triangles;
}

/// Farthest distance of corners, edge middles and centres of one side's triangles from the other side.
double farthest(const Triangles& from, const Triangles& to) {
  Tree tree(to.begin(), to.end());
  tree.accelerate_distance_queries();
  double square = 0;
  for (const auto& t : from)
    for (const Place& p : {t[0], t[1], t[2], CGAL::midpoint(t[0], t[1]), CGAL::midpoint(t[1], t[2]),
                           CGAL::midpoint(t[2], t[0]), CGAL::centroid(t)})
      square = std::max(square, tree.squared_distance(p));
  return std::sqrt(square);
}

}  // namespace

Wrap wrap_soup(const TriangleSoup& soup, double alpha, double offset) {
  std::vector<Place> points;
  for (const Point& p : soup.points) points.emplace_back(p[0], p[1], p[2]);
  Mesh mesh;
  CGAL::alpha_wrap_3(points, soup.triangles, alpha, offset, mesh);
  Wrap wrap;
  for (const auto v : mesh.vertices())
    wrap.surface.points.push_back({mesh.point(v).x(), mesh.point(v).y(), mesh.point(v).z()});
  for (const auto f : mesh.faces()) {
    Triangle triangle{};
    std::size_t corner = 0;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) triangle[corner++] = v.idx();
    wrap.surface.triangles.push_back(triangle);
  }
  const Triangles file = triangles_of(soup), around = triangles_of(wrap.surface);
  wrap.farthest = std::max(farthest(file, around), farthest(around, file));
  return wrap;
}

}  // namespace polynya::geometry
