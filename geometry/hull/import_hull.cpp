#include "geometry/hull/import_hull.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <utility>

#include "geometry/error.hpp"
#include "geometry/hull/check_hull.hpp"
#include "geometry/hull/surface_reader.hpp"

namespace polynya::geometry {
namespace {

constexpr double alpha_of_diagonal = 0.02, offset_of_alpha = 1.0 / 30;

/// The point after the rotation that takes the file's nose to +z.
Point nose_up(const Point& p, const std::string& nose) {
  if (nose == "x") return {p[1], p[2], p[0]};
  if (nose == "-x") return {p[1], -p[2], -p[0]};
  if (nose == "y") return {p[2], p[0], p[1]};
  if (nose == "-y") return {p[2], -p[0], -p[1]};
  if (nose == "-z") return {p[0], -p[1], -p[2]};
  return p;
}

struct Box {
  Point low, high;
  double diagonal() const { return std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]); }
};

Box box_of(const std::vector<Point>& points) {
  Box box{points.front(), points.front()};
  for (const Point& p : points)
    for (std::size_t d = 0; d < 3; ++d)
      box.low[d] = std::min(box.low[d], p[d]), box.high[d] = std::max(box.high[d], p[d]);
  return box;
}

std::string in_words(double value) {
  std::ostringstream text;
  text.precision(3);
  text << value;
  return text.str();
}

}  // namespace

ImportedHull import_hull(const std::string& path, const HullOptions& options) {
  const TriangleSoup soup = read_surface(path);
  ImportedHull hull;
  BodyBoundary boundary;
  try {
    // Before it is turned and scaled: places in messages are those of the file.
    boundary = make_boundary(soup, options.repair != Repair::none);
  } catch (const GeometryError& error) {
    if (options.repair != Repair::wrap)
      throw GeometryError(path + ": " + error.what() + "; " +
                          (options.repair == Repair::none ? "repair it, or set vehicle.repair = \"safe\" or \"wrap\""
                                                          : "repair it, or set vehicle.repair = \"wrap\""));
    const double alpha = options.wrap_alpha > 0 ? options.wrap_alpha / options.scale
                                                : alpha_of_diagonal * box_of(soup.points).diagonal();
    const double offset = options.wrap_offset > 0 ? options.wrap_offset / options.scale : offset_of_alpha * alpha;
    Wrap wrap = wrap_soup(soup, alpha, offset);
    hull.wrapped_distance = options.scale * wrap.farthest;
    boundary = make_boundary(std::move(wrap.surface), true);
    boundary.note = std::string("Wrapped, as asked for, because: ") + error.what() + ". Surface and wrap are up to " +
                    in_words(hull.wrapped_distance * 1e3) + " mm apart.";
  }
  for (Point& p : boundary.outer.points) p = nose_up(p, options.nose);
  for (TriangleSoup& cavity : boundary.cavities)
    for (Point& p : cavity.points) p = nose_up(p, options.nose);
  const Box box = box_of(boundary.outer.points);
  const Point nose{0.5 * (box.low[0] + box.high[0]), 0.5 * (box.low[1] + box.high[1]), box.high[2]};
  const auto place = [&](TriangleSoup& part) {
    for (Point& p : part.points)
      for (std::size_t d = 0; d < 3; ++d) p[d] = options.scale * (p[d] - nose[d]);
  };
  place(boundary.outer);
  hull.outer_volume = solid_properties(boundary.outer).volume;
  TriangleSoup all = boundary.outer;
  for (TriangleSoup& cavity : boundary.cavities) {
    place(cavity);
    const std::size_t first = all.points.size();
    all.points.insert(all.points.end(), cavity.points.begin(), cavity.points.end());
    for (const Triangle& t : cavity.triangles) all.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  hull.solid = solid_properties(all);
  hull.cavities = boundary.cavities.size();
  hull.outer = std::move(boundary.outer);
  hull.note = boundary.note.empty() ? "The surface needed no repair." : boundary.note;
  if (hull.cavities > 0) hull.note += " Cavities inside: " + std::to_string(hull.cavities) + ".";
  return hull;
}

TriangleSoup import_body(const std::string& path, double scale) {
  const TriangleSoup soup = read_surface(path);
  try {
    TriangleSoup surface = make_boundary(soup, true).outer;
    for (Point& p : surface.points)
      for (double& c : p) c *= scale;
    return surface;
  } catch (const GeometryError& error) {
    throw GeometryError(path + ": " + error.what() + "; repair it");
  }
}

void split_long_edges(TriangleSoup& surface, double longest) {
  for (bool split = true; split;) {
    split = false;
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> middles;
    /// The point amid a long edge, made once; no_point for a short one.
    constexpr auto no_point = static_cast<std::size_t>(-1);
    const auto middle = [&](std::size_t a, std::size_t b) {
      const Point p = surface.points[a], q = surface.points[b];
      if (std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]) <= longest) return no_point;
      const auto [found, fresh] = middles.try_emplace({std::min(a, b), std::max(a, b)}, surface.points.size());
      if (fresh) surface.points.push_back({0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1]), 0.5 * (p[2] + q[2])});
      return found->second;
    };
    std::vector<Triangle> finer;
    for (const Triangle& t : surface.triangles) {
      std::size_t m[3];
      int count = 0, first = 0;
      for (std::size_t e = 0; e < 3; ++e) m[e] = middle(t[e], t[(e + 1) % 3]), count += m[e] != no_point;
      if (count == 0) {
        finer.push_back(t);
        continue;
      }
      split = true;
      // Turned so that edge 0 is split, and with two split edges edge 2 is not.
      while (m[first] == no_point || (count == 2 && m[(first + 2) % 3] != no_point)) ++first;
      const std::size_t a = t[first], b = t[(first + 1) % 3], c = t[(first + 2) % 3];
      const std::size_t ab = m[first], bc = m[(first + 1) % 3], ca = m[(first + 2) % 3];
      if (count == 1)
        finer.insert(finer.end(), {{a, ab, c}, {ab, b, c}});
      else if (count == 2)
        finer.insert(finer.end(), {{a, ab, c}, {ab, bc, c}, {ab, b, bc}});
      else
        finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    surface.triangles = std::move(finer);
  }
}

}  // namespace polynya::geometry
