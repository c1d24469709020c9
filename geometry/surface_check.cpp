#include "geometry/surface_check.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <array>
#include <vector>

namespace polynya::geometry {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
namespace processing = CGAL::Polygon_mesh_processing;

void describe(SurfaceCheck& check) {
  const auto say = [&](bool wrong, const char* sentence) {
    if (!wrong) return;
    if (!check.text.empty()) check.text += ' ';
    check.text += sentence;
  };
  say(!check.manifold,
      "An edge belongs to more than two triangles, or neighbouring triangles are oriented differently.");
  say(check.manifold && !check.closed, "The surface has open edges.");
  say(check.self_intersects, "Triangles intersect each other.");
  say(check.closed && !check.outward, "The normals point into the body; reverse the order of the vertices.");
}

}  // namespace

SurfaceCheck check_surface(std::span<const double> positions, std::span<const std::int32_t> triangles) {
  SurfaceCheck check;
  const std::size_t vertices = positions.size() / 3;
  std::vector<Kernel::Point_3> points;
  for (std::size_t v = 0; v < vertices; ++v)
    points.emplace_back(positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]);
  std::vector<std::array<std::size_t, 3>> faces;
  for (std::size_t t = 0; t < triangles.size(); t += 3) {
    std::array<std::size_t, 3> face;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::int32_t vertex = triangles[t + c];
      if (vertex < 0 || static_cast<std::size_t>(vertex) >= vertices) {
        check.text =
            "Triangle " + std::to_string(t / 3) + " names vertex " + std::to_string(vertex) + ", which does not exist.";
        return check;
      }
      face[c] = static_cast<std::size_t>(vertex);
    }
    faces.push_back(face);
  }
  check.manifold = processing::is_polygon_soup_a_polygon_mesh(faces);
  if (check.manifold) {
    Mesh mesh;
    processing::polygon_soup_to_polygon_mesh(points, faces, mesh);
    check.self_intersects = processing::does_self_intersect(mesh);
    check.closed = CGAL::is_closed(mesh);
    if (check.closed) {
      check.volume = CGAL::to_double(processing::volume(mesh));
      check.outward = check.self_intersects ? check.volume > 0 : processing::is_outward_oriented(mesh);
    }
  }
  describe(check);
  return check;
}

}  // namespace polynya::geometry
