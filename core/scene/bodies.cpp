// Bodies whose motion is prescribed: reading, what they sweep, and what they must not do.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include "core/scene/body_motion.hpp"
#include "core/scene/parts.hpp"
#include "core/scene/rows.hpp"
#include "core/scene/units.hpp"
#include "geometry/error.hpp"
#include "geometry/hull/simple_bodies.hpp"
#include "geometry/hull/solid_properties.hpp"

namespace polynya::scene {
namespace {

constexpr int instants = 100;            // at which places are looked at, besides those of tables
constexpr double edges_per_size = 0.05;  // of round bodies, where only their outline matters
constexpr double room_of_size = 0.5;     // of fine cells about a body

const std::map<std::string, std::set<std::string>> keys_of_shapes{{"sphere", {"diameter"}},
                                                                  {"cylinder", {"diameter", "height"}},
                                                                  {"box", {"length", "width", "height"}},
                                                                  {"wedge", {"length", "width", "height"}},
                                                                  {"file", {"file", "file_unit"}}};

void read_shape(const Values& values, const std::string& path, Body& body) {
  body.shape = values.text(path + "shape");
  const std::set<std::string>& needed = keys_of_shapes.at(body.shape);
  for (const std::string key : {"diameter", "length", "width", "height", "file", "file_unit"}) {
    if (!needed.contains(key) && values.is_given(path + key))
      values.fail(path + key, "has no meaning for a body of shape " + body.shape + "; leave it out");
    if (needed.contains(key) && !values.is_given(path + key)) {
      if (key == std::string("file_unit"))
        values.fail(path + key, "missing; a file of a surface does not say its unit; must be m, cm, mm, um, in or ft");
      values.fail(path + key, "missing; a body of shape " + body.shape + " needs it");
    }
  }
  body.diameter = values.number(path + "diameter", 0), body.length = values.number(path + "length", 0);
  body.width = values.number(path + "width", 0), body.height = values.number(path + "height", 0);
  if (body.shape != "file") return;
  body.file = std::filesystem::absolute(values.folder() / values.text(path + "file")).lexically_normal().string();
  body.unit = file_unit(values, path + "file_unit");
}

Body read_body(const Values& values, const std::string& path) {
  Body body;
  read_shape(values, path, body);
  body.position =
      row_in(values, path + "position", values.text(path + "position"), 3, dimension::length, "0, 0, -30 mm");
  body.angles = row_in(values, path + "angles", values.text(path + "angles"), 3, dimension::none, "0, 20 deg, 0");
  read_table(values, path + "velocity", 3, dimension::speed, "0, 0, 0 at 0; 0, 0, 1 m/s at 1 ms", body.times,
             body.velocity);
  read_table(values, path + "rotation_rate", 1, dimension::frequency, "0 at 0; 100 rad/s at 1 ms", body.rotation_times,
             body.rotation_rate);
  body.rotation_axis = values.text(path + "rotation_axis");
  return body;
}

geometry::TriangleSoup outline(const Values& values, const std::string& path, const Body& body) {
  const double size = body.diameter > 0 ? body.diameter : 1;
  try {
    return body_surface(body, edges_per_size * size);
  } catch (const geometry::GeometryError& error) {
    values.fail(path + "file", error.what());
  }
}

std::vector<double> moments_of(const Scene& scene) {
  std::vector<double> times;
  for (int n = 0; n <= instants; ++n) times.push_back(scene.run.end_time * n / instants);
  for (const auto& [name, body] : *scene.fluid->bodies)
    for (const auto* table : {&body.times, &body.rotation_times})
      for (const double time : *table)
        if (time < scene.run.end_time) times.push_back(time);
  std::ranges::sort(times);
  return times;
}

geometry::TriangleSoup at(const Body& body, const geometry::TriangleSoup& surface, double time) {
  geometry::TriangleSoup moved = surface;
  const Pose pose = pose_at(body, time);
  for (geometry::Point& p : moved.points) p = placed(body, pose, p);
  return moved;
}

struct Box {
  Vector low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  void add(const geometry::Point& p) {
    for (std::size_t d = 0; d < 3; ++d) low[d] = std::min(low[d], p[d]), high[d] = std::max(high[d], p[d]);
  }
  bool apart(const Box& other) const {
    for (std::size_t d = 0; d < 3; ++d)
      if (low[d] > other.high[d] || high[d] < other.low[d]) return true;
    return false;
  }
};
Box box_of(const geometry::TriangleSoup& surface) {
  Box box;
  for (const geometry::Point& p : surface.points) box.add(p);
  return box;
}

std::string key(const std::string& name, const char* last) {
  return "body." + name + "." + last;
}

/// Everything a body passes through during the run.
void find_reach(const Scene& scene, const geometry::TriangleSoup& surface, Body& body) {
  Box box;
  for (const double time : moments_of(scene))
    for (const geometry::Point& p : at(body, surface, time).points) box.add(p);
  body.low.assign(box.low.begin(), box.low.end());
  body.high.assign(box.high.begin(), box.high.end());
}

/// A body and its motion are their own image in the plane normal to the axis.
bool symmetric(const Body& body, std::size_t axis) {
  if (body.shape == "file" || body.position[axis] != 0) return false;
  for (const double angle : body.angles)
    if (angle != 0) return false;
  for (const double rate : body.rotation_rate)
    if (rate != 0) return false;
  for (std::size_t n = axis; n < body.velocity.size(); n += 3)
    if (body.velocity[n] != 0) return false;
  return true;
}

std::string millimetres(double length) {
  std::ostringstream text;
  text.precision(4);
  text << length * 1e3 << " mm";
  return text.str();
}

void check_apart(const Values& values, const Scene& scene) {
  std::map<std::string, geometry::TriangleSoup> surfaces;
  for (const auto& [name, body] : *scene.fluid->bodies) surfaces[name] = outline(values, "body." + name + ".", body);
  for (const double time : moments_of(scene))
    for (auto a = surfaces.begin(); a != surfaces.end(); ++a)
      for (auto b = surfaces.begin(); b != a; ++b) {
        const auto first = at(scene.fluid->bodies->at(a->first), a->second, time),
                   second = at(scene.fluid->bodies->at(b->first), b->second, time);
        if (box_of(first).apart(box_of(second)) || !geometry::bodies_meet(first, second)) continue;
        std::ostringstream when;
        when << time;
        values.fail(key(a->first, time == 0 ? "position" : "velocity"),
                    "the body meets '" + b->first + "' " + (time == 0 ? "at the start" : "at " + when.str() + " s") +
                        "; bodies must stay apart");
      }
}

}  // namespace

void read_bodies(const Values& values, Scene& scene) {
  auto& bodies = scene.fluid->bodies.emplace();
  for (const std::string& name : values.tables_below("body")) bodies[name] = read_body(values, "body." + name + ".");
  if (bodies.empty()) values.fail("body", "must be named tables such as [body.sphere]");
  for (auto& [name, body] : bodies) {
    const geometry::TriangleSoup surface = outline(values, "body." + name + ".", body);
    body.volume = geometry::solid_properties(surface).volume;
    const Box box = box_of(surface);
    for (std::size_t d = 0; d < 3; ++d) body.size = std::max(body.size, box.high[d] - box.low[d]);
    find_reach(scene, surface, body);
  }
}

double largest_body(const Scene& scene) {
  double size = 0;
  for (const auto& [name, body] : *scene.fluid->bodies) size = std::max(size, body.size);
  return size;
}

double reach_of_bodies(const Scene& scene) {
  double reach = 0;
  for (const auto& [name, body] : *scene.fluid->bodies)
    for (std::size_t d = 0; d < 2; ++d) reach = std::max({reach, std::abs(body.low[d]), std::abs(body.high[d])});
  return reach + room_of_size * largest_body(scene);
}

Symmetry symmetry_of_bodies(const Values& values) {
  bool x = true, y = true;
  for (const std::string& name : values.tables_below("body")) {
    const Body body = read_body(values, "body." + name + ".");
    x = x && symmetric(body, 0), y = y && symmetric(body, 1);
  }
  return x && y ? Symmetry::quarter : y ? Symmetry::half : Symmetry::full;
}

void check_bodies(const Values& values, const Scene& scene) {
  const auto& fluid = *scene.fluid;
  const Vector low{-0.5 * fluid.length, -0.5 * fluid.width, fluid.bottom},
      high{0.5 * fluid.length, 0.5 * fluid.width, fluid.top};
  constexpr const char* axes[] = {"x", "y", "z"};
  for (const auto& [name, body] : *fluid.bodies) {
    for (std::size_t d = 0; d < 3; ++d) {
      const bool closed = fluid.outer_boundary == "wall";
      const bool outside =
          closed ? body.high[d] <= low[d] || body.low[d] >= high[d] : body.low[d] < low[d] || body.high[d] > high[d];
      if (outside)
        values.fail(key(name, "position"),
                    std::string(closed ? "the body lies" : "the body reaches or moves") + " outside the fluid: along " +
                        axes[d] + " it goes from " + millimetres(body.low[d]) + " to " + millimetres(body.high[d]) +
                        " during the run, the fluid from " + millimetres(low[d]) + " to " + millimetres(high[d]));
      const bool plane = d == 0 ? scene.symmetry == Symmetry::quarter : d == 1 && scene.symmetry != Symmetry::full;
      if (plane && body.low[d] < 0 && !symmetric(body, d))
        values.fail(key(name, "position"), std::string("the body lies across the plane ") + axes[d] +
                                               " = 0 and is not its own image in it, with its motion; set symmetry = "
                                               "\"full\"");
    }
  }
  check_apart(values, scene);
}

}  // namespace polynya::scene
