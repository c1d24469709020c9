#include "geometry/hull/check_hull.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include "geometry/error.hpp"
#include "geometry/hull/solid_properties.hpp"

namespace polynya::geometry {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Place = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Place>;
namespace processing = CGAL::Polygon_mesh_processing;

constexpr double weld_of_diagonal = 1e-6;  // above the rounding of single precision, below any detail
constexpr double flat = 1e-12;             // height over longest edge of a triangle without area

std::string near(const Point& p) {
  std::ostringstream text;
  text.precision(6);
  text << "near (" << p[0] << ", " << p[1] << ", " << p[2] << ")";
  return text.str();
}

Point middle(const Point& a, const Point& b) {
  return {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.5 * (a[2] + b[2])};
}

/// What was done so far; refuses instead where nothing may be done.
class Repairs {
 public:
  explicit Repairs(bool allowed) : allowed_(allowed) {}
  void add(std::size_t count, const std::string& what) {
    if (count == 0) return;
    if (!allowed_) throw GeometryError(std::to_string(count) + " " + what);
    note_ += (note_.empty() ? "Repaired: " : ", ") + std::to_string(count) + " " + what;
  }
  std::string note() const { return note_.empty() ? "" : note_ + "."; }

 private:
  bool allowed_;
  std::string note_;
};

double diagonal_of(const std::vector<Point>& points) {
  Point low = points.front(), high = low;
  for (const Point& p : points)
    for (std::size_t d = 0; d < 3; ++d) low[d] = std::min(low[d], p[d]), high[d] = std::max(high[d], p[d]);
  return std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
}

/// Points closer than a millionth of the diagonal become the first of them.
std::size_t weld(TriangleSoup& soup) {
  const double reach = weld_of_diagonal * diagonal_of(soup.points);
  std::map<std::array<long, 3>, std::vector<std::size_t>> cells;
  std::vector<std::size_t> number(soup.points.size());
  std::vector<Point> kept;
  const auto cell = [&](double x) { return static_cast<long>(std::floor(x / reach)); };
  for (std::size_t v = 0; v < soup.points.size(); ++v) {
    const Point& p = soup.points[v];
    const std::array<long, 3> here{cell(p[0]), cell(p[1]), cell(p[2])};
    number[v] = kept.size();
    for (long n = 0; n < 27; ++n) {
      const auto found = cells.find({here[0] + n % 3 - 1, here[1] + n / 3 % 3 - 1, here[2] + n / 9 - 1});
      if (found == cells.end()) continue;
      for (const std::size_t k : found->second)
        if (std::hypot(kept[k][0] - p[0], kept[k][1] - p[1], kept[k][2] - p[2]) <= reach)
          number[v] = std::min(number[v], k);
    }
    if (number[v] < kept.size()) continue;
    cells[here].push_back(kept.size());
    kept.push_back(p);
  }
  const std::size_t welded = soup.points.size() - kept.size();
  soup.points = std::move(kept);
  for (Triangle& t : soup.triangles)
    for (std::size_t& v : t) v = number[v];
  return welded;
}

std::size_t drop_collapsed(TriangleSoup& soup) {
  return std::erase_if(soup.triangles, [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
}

/// Triangles with the same three corners, whichever way round.
std::size_t drop_doubles(TriangleSoup& soup) {
  std::set<Triangle> seen;
  return std::erase_if(soup.triangles, [&](Triangle t) {
    std::sort(t.begin(), t.end());
    return !seen.insert(t).second;
  });
}

void refuse_flat(const TriangleSoup& soup) {
  for (const Triangle& t : soup.triangles) {
    const Place a(soup.points[t[0]][0], soup.points[t[0]][1], soup.points[t[0]][2]),
        b(soup.points[t[1]][0], soup.points[t[1]][1], soup.points[t[1]][2]),
        c(soup.points[t[2]][0], soup.points[t[2]][1], soup.points[t[2]][2]);
    const double longest =
        std::max({CGAL::squared_distance(a, b), CGAL::squared_distance(b, c), CGAL::squared_distance(c, a)});
    if (std::sqrt(CGAL::cross_product(b - a, c - a).squared_length()) <= flat * longest)
      throw GeometryError("a triangle has no area " + near(soup.points[t[0]]));
  }
}

/// Every edge must have two triangles.
void refuse_bad_edges(const TriangleSoup& soup) {
  std::map<std::pair<std::size_t, std::size_t>, int> edges;
  for (const Triangle& t : soup.triangles)
    for (std::size_t e = 0; e < 3; ++e) ++edges[std::minmax(t[e], t[(e + 1) % 3])];
  std::size_t crowded = 0, open = 0;
  Point at_crowded{}, at_open{};
  for (const auto& [edge, count] : edges) {
    const Point place = middle(soup.points[edge.first], soup.points[edge.second]);
    if (count > 2 && crowded++ == 0) at_crowded = place;
    if (count == 1 && open++ == 0) at_open = place;
  }
  if (crowded > 0)
    throw GeometryError("the surface is not manifold: " + std::to_string(crowded) +
                        " edge(s) with more than two triangles, the first " + near(at_crowded));
  if (open > 0)
    throw GeometryError("the surface is open: " + std::to_string(open) + " edge(s) with one triangle, the first " +
                        near(at_open));
}

Mesh make_mesh(const TriangleSoup& soup, std::vector<Triangle>& oriented) {
  std::vector<Place> points;
  for (const Point& p : soup.points) points.emplace_back(p[0], p[1], p[2]);
  oriented = soup.triangles;
  processing::orient_polygon_soup(points, oriented);
  Mesh mesh;
  processing::polygon_soup_to_polygon_mesh(points, oriented, mesh);
  if (!CGAL::is_closed(mesh)) throw GeometryError("the surface has one side only: it cannot be oriented");
  return mesh;
}

void refuse_intersections(const Mesh& mesh) {
  std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> pairs;
  processing::self_intersections(mesh, std::back_inserter(pairs));
  if (pairs.empty()) return;
  const auto corner = mesh.point(mesh.source(mesh.halfedge(pairs.front().first)));
  throw GeometryError("the surface meets itself: " + std::to_string(pairs.size()) +
                      " pair(s) of triangles, the first " + near({corner.x(), corner.y(), corner.z()}));
}

/// Of as many triangles that bound the same body, how many run the other way round than in the file.
std::size_t count_turned(const Mesh& mesh, const std::vector<Triangle>& before, std::size_t points) {
  std::size_t turned = 0, t = 0;
  for (const auto f : mesh.faces()) {
    std::vector<std::size_t> corners;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) corners.push_back(v.idx());
    // Points that were doubled at pinched vertices stand behind the others; one that is not tells the way round.
    const Triangle& old = before[t++];
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k)
        if (old[i] == corners[k] && old[i] < points && old[(i + 1) % 3] == corners[(k + 2) % 3]) {
          ++turned;
          i = k = 3;
        }
  }
  return turned;
}

std::vector<TriangleSoup> parts_of(const Mesh& mesh) {
  auto part = mesh.property_map<Mesh::Face_index, std::size_t>("f:part").first;
  std::vector<TriangleSoup> parts;
  std::vector<std::map<std::size_t, std::size_t>> numbers;
  for (const auto f : mesh.faces()) {
    const std::size_t p = part[f];
    if (p >= parts.size()) parts.resize(p + 1), numbers.resize(p + 1);
    Triangle triangle{};
    std::size_t corner = 0;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) {
      const auto [found, fresh] = numbers[p].try_emplace(v.idx(), parts[p].points.size());
      if (fresh) parts[p].points.push_back({mesh.point(v).x(), mesh.point(v).y(), mesh.point(v).z()});
      triangle[corner++] = found->second;
    }
    parts[p].triangles.push_back(triangle);
  }
  return parts;
}

}  // namespace

BodyBoundary make_boundary(TriangleSoup soup, bool repair) {
  Repairs repairs(repair);
  repairs.add(weld(soup), "double points");
  repairs.add(drop_collapsed(soup), "triangles without area");
  repairs.add(drop_doubles(soup), "double triangles");
  refuse_flat(soup);
  refuse_bad_edges(soup);
  std::vector<Triangle> oriented;
  Mesh mesh = make_mesh(soup, oriented);
  refuse_intersections(mesh);
  processing::orient_to_bound_a_volume(mesh);
  repairs.add(count_turned(mesh, soup.triangles, soup.points.size()), "triangles the wrong way round");
  auto part = mesh.add_property_map<Mesh::Face_index, std::size_t>("f:part").first;
  processing::connected_components(mesh, part);

  BodyBoundary boundary;
  std::size_t bodies = 0;
  for (TriangleSoup& surface : parts_of(mesh)) {
    if (solid_properties(surface).volume < 0) {
      boundary.cavities.push_back(std::move(surface));
    } else if (++bodies == 1) {
      boundary.outer = std::move(surface);
    }
  }
  if (bodies != 1)
    throw GeometryError("the file holds " + std::to_string(bodies) + " bodies apart from each other, a hull is one");
  boundary.note = repairs.note();
  return boundary;
}

}  // namespace polynya::geometry
