#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/intersection.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Surface_mesh.h>

#include "geometry/hull/simple_bodies.hpp"

namespace polynya::geometry {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

Mesh mesh_of(const TriangleSoup& surface) {
  Mesh mesh;
  std::vector<Mesh::Vertex_index> vertices;
  for (const Point& p : surface.points) vertices.push_back(mesh.add_vertex({p[0], p[1], p[2]}));
  for (const Triangle& t : surface.triangles) mesh.add_face(vertices[t[0]], vertices[t[1]], vertices[t[2]]);
  return mesh;
}

}  // namespace

bool bodies_meet(const TriangleSoup& a, const TriangleSoup& b) {
  return CGAL::Polygon_mesh_processing::do_intersect(mesh_of(a), mesh_of(b),
                                                     CGAL::parameters::do_overlap_test_of_bounded_sides(true),
                                                     CGAL::parameters::do_overlap_test_of_bounded_sides(true));
}

}  // namespace polynya::geometry
