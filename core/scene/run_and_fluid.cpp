// End of the run, resolution, extent of the fluid: what depends on several parts of the scene.
#include <algorithm>
#include <cmath>

#include "core/scene/parts.hpp"
#include "core/scene/vehicle_shape.hpp"

namespace polynya::scene {
namespace {

constexpr double reserve = 1.5;           // of the expected duration
constexpr double plug_factor = 2.6;       // thicknesses travelled until the broken plug lets go of the head
constexpr double frames = 30;             // of a run, by default
constexpr int open_water_diameters = 20;  // lateral extent without ice
constexpr int open_water_bodies = 10;     // lateral extent around bodies alone
constexpr int cells_above_nose = 2;
constexpr int cells_below_tail = 6;
constexpr double largest_cells_across = 20000;  // per direction: more is a slip of units

std::string default_end(const Values& values, const Scene& scene) {
  if (!scene.vehicle) return "time";
  return scene.ice ? "ice_passed" : values.has("water") ? "exited" : "time";
}

/// Distance (m) the nose travels until the expected end.
double expected_way(const Scene& scene, double surface, const std::string& end) {
  const auto& v = *scene.vehicle;
  const double thickness = scene.ice ? scene.ice->thickness : 0;
  const double gap = std::max((scene.ice ? scene.ice->lower_face : surface) - v.nose_position, 0.0);
  return end == "exited" ? gap + thickness + v.length : gap + v.head_length + plug_factor * thickness;
}

double end_time(const Values& values, const Scene& scene, double surface) {
  if (const auto given = values.given("run.end_time")) return *given;
  if (!scene.vehicle || scene.vehicle->speed == 0 || scene.run.end == "time")
    values.fail("run.end_time",
                "missing; must be a time such as \"1.5 ms\" (it is only worked out for a moving vehicle and an end "
                "other than time)");
  const double rise = scene.vehicle->speed * std::cos(scene.vehicle->angle);
  return reserve * expected_way(scene, surface, scene.run.end) / rise;
}

void check_end(const Values& values, const Scene& scene) {
  const auto& end = scene.run.end;
  if (end == "ice_passed" && !(scene.vehicle && scene.ice))
    values.fail("run.end", "needs [vehicle] and [ice]; allowed here is time");
  if (end == "exited" && !(scene.vehicle && (scene.ice || values.has("water"))))
    values.fail("run.end", "needs [vehicle] with [ice] or [water]; allowed here is time");
}

/// Farthest (m) that the nose comes from the z axis until it is through the ice or the waterline.
double way_aside(const Scene& scene) {
  const auto& v = *scene.vehicle;
  const double end = scene.ice ? scene.ice->lower_face + scene.ice->thickness : v.nose_position;
  const double x = v.offset_x + std::max(0.0, end - v.nose_position) * std::tan(v.angle);
  return std::hypot(std::max(std::abs(v.offset_x), std::abs(x)), v.offset_y);
}

}  // namespace

double waterline(const Values& values, const Scene& scene) {
  if (const auto surface = values.given("water.surface")) return *surface;
  if (!scene.ice || !values.has("water")) return 0;
  const double ratio = scene.material(scene.ice->material).value("density") /
                       scene.material(values.text("water.material")).value("density");
  if (ratio >= 1) values.fail("ice.material", "ice denser than the water does not float; give water.surface");
  return scene.ice->lower_face + ratio * scene.ice->thickness;
}

void read_run(const Values& values, Scene& scene) {
  auto& run = scene.run;
  run.end = values.text("run.end");
  if (run.end == "auto") run.end = default_end(values, scene);
  check_end(values, scene);
  run.end_time = end_time(values, scene, waterline(values, scene));
  run.frame_interval = values.number("run.frame_interval", run.end_time / frames);
  run.step_factor = values.number("run.step_factor");
  run.fluid_step_factor = values.number("run.fluid_step_factor");
  run.filter_frequency = values.number("run.filter_frequency");
  run.join_timeout = values.number("run.join_timeout");
  run.gravity = values.number("run.gravity");
  run.seed = std::lround(values.number("run.seed"));
  scene.checkpoint = {values.number("checkpoint.interval"), values.number("checkpoint.wall_interval")};
}

void read_resolution(const Values& values, Scene& scene) {
  auto& r = scene.resolution;
  const double diameter = scene.vehicle ? scene.vehicle->diameter : 10 * values.number("resolution.cell");
  r.cell = values.number("resolution.cell");
  r.ice_element = values.number("resolution.ice_element", r.cell);
  r.vehicle_element = values.number("resolution.vehicle_element", std::min(r.cell, 0.1 * diameter));
  const double aside = scene.vehicle ? way_aside(scene) : 0;
  const bool bodies = scene.fluid && scene.fluid->bodies;
  r.fine_radius = values.number("resolution.fine_radius", bodies ? reach_of_bodies(scene) : 2 * diameter + aside);
  r.ice_fine_radius = values.number("resolution.ice_fine_radius", 3 * diameter + aside);
  r.growth = values.number("resolution.growth");
  r.largest_ice_element = values.number("resolution.largest_ice_element");
  if (scene.vehicle && r.vehicle_element > scene.vehicle->length)
    values.fail("resolution.vehicle_element", "must not exceed vehicle.length");
  if (scene.vehicle && 2 * r.fine_radius < scene.vehicle->diameter)
    values.fail("resolution.fine_radius", "must be at least the vehicle's radius");
  const std::string element = values.given("resolution.ice_element") ? "resolution.ice_element" : "resolution.cell";
  if (scene.ice && scene.ice->mesh) return;
  if (scene.ice && r.ice_element > scene.ice->thickness)
    values.fail(element, "the ice element must not exceed ice.thickness");
  if (scene.ice && scene.ice->thickness / r.ice_element > largest_cells_across)
    values.fail(element, "gives more than 20000 layers of ice");
}

Tube read_tube(const Values& values) {
  const auto state = [&](const std::string& path) {
    return TubeState{values.text(path + ".material"), values.number(path + ".density", 0),
                     values.number(path + ".velocity"), values.number(path + ".pressure", 0)};
  };
  Tube tube;
  tube.length = values.number("tube.length", 0);
  tube.diaphragm = values.number("tube.diaphragm", 0.5 * tube.length);
  tube.left = state("tube.left"), tube.right = state("tube.right");
  if (tube.diaphragm >= tube.length) values.fail("tube.diaphragm", "must be below tube.length");
  if (tube.length / values.number("resolution.cell") > 1e6)
    values.fail("tube.length", "more than a million cells; enlarge resolution.cell");
  return tube;
}

void read_dam(const Values& values, Scene& scene) {
  auto& f = *scene.fluid;
  f.dam = Dam{values.number("dam.length", 0), values.number("dam.height", 0)};
  f.length = values.number("dam.tank_length", 0);
  f.top = values.number("dam.tank_height", 1.25 * f.dam->height);
  f.width = scene.resolution.cell;
  f.waterline = f.dam->height;
  f.water = values.text("water.material"), f.air = values.text("air.material");
  f.atmospheric_pressure = values.number("air.pressure");
  const auto& water = scene.material(f.water);
  f.vapour_pressure = water.has("vapour_pressure") ? water.value("vapour_pressure") : 0;
  f.start = "impulsive", f.outer_boundary = "wall", f.grid_follows = "none";
  f.shock_viscosity = values.text("fluid.shock_viscosity"), f.sweeps = values.text("fluid.sweeps");
  f.sleeping_threshold = values.number("fluid.sleeping_threshold");
  if (f.dam->length >= f.length) values.fail("dam.length", "must be below dam.tank_length");
  if (f.dam->height >= f.top) values.fail("dam.height", "must be below dam.tank_height");
  if (f.length / f.width * (f.top / f.width) > 1e7)
    values.fail("dam.tank_length", "more than ten million cells; enlarge resolution.cell");
}

/// The flow about a vehicle that moves from the start presses on the ice with what no plate has come to rest under.
void choose_ice_start(const Values& values, Scene& scene) {
  Ice& ice = *scene.ice;
  const bool at_rest = !scene.vehicle || scene.vehicle->speed == 0 || scene.fluid->start == "impulsive";
  if (ice.start == "equilibrium" && !at_rest)
    values.fail("ice.start", "the vehicle's flow presses on the ice from the start; must be auto or unloaded");
  const bool floats = (ice.sides == "free" || ice.sides == "non_reflecting") && ice.held_rim == 0;
  if (values.text("ice.start") == "auto" && at_rest && floats) ice.start = "equilibrium";
  if (ice.start != "equilibrium" && ice.equilibrium != "auto")
    values.fail("ice.equilibrium", "this ice starts unloaded; must be auto, or ice.start equilibrium");
}

void read_fluid(const Values& values, Scene& scene) {
  if (!scene.fluid) scene.fluid.emplace();
  auto& f = *scene.fluid;
  const auto& v = scene.vehicle;
  const double cell = scene.resolution.cell;
  const double open_water =
      f.bodies ? open_water_bodies * largest_body(scene) : (v ? v->diameter : 10 * cell) * open_water_diameters;
  f.length = values.number("fluid.length", scene.ice ? scene.ice->length : open_water);
  f.width = values.number("fluid.width", scene.ice ? scene.ice->width : open_water);
  f.water = values.text("water.material"), f.air = values.text("air.material");
  f.waterline = waterline(values, scene);
  f.atmospheric_pressure = values.number("air.pressure");
  const auto& water = scene.material(f.water);
  f.vapour_pressure = water.has("vapour_pressure") ? water.value("vapour_pressure") : 0;
  f.start = values.text("fluid.start"), f.outer_boundary = values.text("fluid.outer_boundary");
  if (scene.ice) choose_ice_start(values, scene);
  f.grid_follows = values.text("fluid.grid_follows");
  f.shock_viscosity = values.text("fluid.shock_viscosity"), f.sweeps = values.text("fluid.sweeps");
  f.sleeping_threshold = values.number("fluid.sleeping_threshold");
  f.bottom = (scene.ice ? scene.ice->lower_face : f.waterline) - values.number("water.depth");
  f.top = (scene.ice ? scene.ice->lower_face + scene.ice->thickness : f.waterline) + values.number("air.height");
  if (values.number("water.depth") == 0 &&
      (!scene.ice || v || scene.ice->sides == "non_reflecting" || scene.ice->sides == "free"))
    values.fail("water.depth",
                "0 makes the ice the floor of the water: it needs [ice] with clamped sides or ends, and no [vehicle]");
  if (v) {
    f.bottom = std::min(f.bottom, v->nose_position - lowest_below_nose(*v) - cells_below_tail * cell);
    const double way = f.grid_follows == "vehicle" ? 0.0 : v->speed * scene.run.end_time;
    f.top = std::max(f.top, v->nose_position + way + cells_above_nose * cell);
  }
  if (scene.ice && (f.length < scene.ice->length * (1 - 1e-12) || f.width < scene.ice->width * (1 - 1e-12)))
    values.fail(f.length < scene.ice->length ? "fluid.length" : "fluid.width", "must not be below that of the ice");
  if (v && 2 * v->diameter > std::min(f.length, f.width))
    values.fail("fluid.length", "must be at least two vehicle diameters");
  if (v) {
    const double tail = v->offset_x - v->length * std::sin(v->angle);
    const double end = v->offset_x + v->speed * scene.run.end_time * std::sin(v->angle);
    const double x = std::max({std::abs(v->offset_x), std::abs(tail), std::abs(end)}) + v->diameter;
    if (2 * x > f.length || 2 * (std::abs(v->offset_y) + v->diameter) > f.width)
      values.fail(2 * x > f.length ? "fluid.length" : "fluid.width",
                  "the vehicle would leave the fluid sideways; enlarge it, or lessen vehicle.angle or offset");
  }
  if (f.waterline <= f.bottom || f.waterline >= f.top)
    values.fail("water.surface", "must lie between bottom and top of the fluid");
  if ((f.top - f.bottom) / cell > largest_cells_across)
    values.fail("resolution.cell", "gives more than 20000 cells along z");
}

}  // namespace polynya::scene
