// Vehicle and ice: reading and checking.
#include <cmath>
#include <sstream>

#include "core/scene/parts.hpp"
#include "core/scene/vehicle_shape.hpp"

namespace polynya::scene {
namespace {

constexpr double default_nose_gap = 4e-3;     // m, the paper's first stage: 0.1 ms at 40 m/s
constexpr double thinnest_wall = 0.01;        // of the radius: below it a mass is a slip of units
constexpr double solid_mass_tolerance = 0.2;  // between a given mass and the material's density

std::string in_units(double value, const char* unit) {
  std::ostringstream stream;
  stream.precision(3);
  stream << value << unit;
  return stream.str();
}

std::string grams(double mass) {
  return in_units(mass * 1e3, " g");
}

double head_length(const Values& values, const Vehicle& v) {
  const bool hemisphere = v.head == "hemisphere";
  const double length = values.number("vehicle.head_length", hemisphere ? 0.5 * v.diameter : v.diameter);
  if (hemisphere && std::abs(length - 0.5 * v.diameter) > 1e-9 * v.diameter)
    values.fail("vehicle.head_length",
                "a hemisphere is half a diameter long; leave the key out, or take head = \"ellipsoid\"");
  if (v.head == "ogive" && length < 0.5 * v.diameter)
    values.fail("vehicle.head_length",
                "a tangent ogive is at least half a diameter long; take head = \"ellipsoid\" for a blunter one");
  if (length >= v.length) values.fail("vehicle.head_length", "must be below vehicle.length");
  return length;
}

void read_start(const Values& values, Vehicle& v) {
  v.angle = values.number("vehicle.angle");
  v.offset_x = values.number("vehicle.offset_x"), v.offset_y = values.number("vehicle.offset_y");
  v.spin = values.number("vehicle.spin"), v.pitch_rate = values.number("vehicle.pitch_rate");
}

}  // namespace

Vehicle read_vehicle(const Values& values) {
  Vehicle v;
  v.speed = values.number("vehicle.speed");
  v.mass = values.number("vehicle.mass");
  v.material = values.text("vehicle.material");
  read_start(values, v);
  read_hull_file(values, v);
  if (v.surface) return v;
  v.head = values.text("vehicle.head");
  v.diameter = values.number("vehicle.diameter");
  v.length = values.number("vehicle.length");
  v.head_length = head_length(values, v);
  v.interior = values.text("vehicle.interior");
  v.wall_thickness = values.number("vehicle.wall_thickness");
  const bool hollow = v.interior == "hollow";
  if (!hollow && v.wall_thickness > 0)
    values.fail("vehicle.wall_thickness", "a solid vehicle has no wall; set interior = \"hollow\"");
  if (hollow && v.wall_thickness == 0 && v.mass == 0)
    values.fail("vehicle.interior", "a hollow vehicle needs vehicle.mass or vehicle.wall_thickness");
  if (hollow && v.wall_thickness > 0 && v.mass > 0)
    values.fail("vehicle.wall_thickness", "mass and wall_thickness exclude each other; set one of them to 0");
  if (v.wall_thickness > thickest_wall(v))
    values.fail("vehicle.wall_thickness",
                "leaves no cavity; at most " + in_units(thickest_wall(v) * 1e3, " mm") + " in this hull");
  return v;
}

void check_hull(const Values& values, const Vehicle& v, const MaterialCard& card) {
  if (v.mass == 0 || v.surface) return;
  const double density = card.value("density"), solid = density * hull_volume(v);
  if (v.interior == "solid") {
    if (std::abs(v.mass / solid - 1) > solid_mass_tolerance)
      values.fail("vehicle.mass", "a solid hull of this shape in " + card.name + " has " + grams(solid) +
                                      "; give about that, 0, or interior = \"hollow\"");
    return;
  }
  const double least = density * shell_volume(v, thinnest_wall * 0.5 * v.diameter);
  const double most = density * shell_volume(v, thickest_wall(v));
  if (v.mass > most || v.mass < least)
    values.fail("vehicle.mass", std::string(v.mass > most ? "too large" : "too small") +
                                    " for a hollow hull of this shape in " + card.name + "; allowed is " +
                                    grams(least) + " to " + grams(most));
}

void place_vehicle(const Values& values, Scene& scene) {
  auto& v = *scene.vehicle;
  const double ceiling = scene.ice ? scene.ice->lower_face : waterline(values, scene);
  const double rise = highest_above_nose(v);
  v.nose_position = values.number("vehicle.nose_position", ceiling - default_nose_gap - rise);
  if (scene.ice && v.nose_position + rise >= ceiling)
    values.fail("vehicle.nose_position", "the vehicle would start inside the ice; must be below ice.lower_face");
  if (!scene.ice) return;
  if (scene.ice->bending)
    values.fail("vehicle.speed", "a beam in bending has no vehicle; remove [vehicle] or [ice.bending]");
  if (scene.ice->ball) values.fail("vehicle.speed", "a ball of ice has no vehicle; remove [vehicle] or [ice.ball]");
  if (v.diameter >= std::min(scene.ice->length, scene.ice->width))
    values.fail("vehicle.diameter", "must be below ice.length and ice.width");
}

Ice read_ice(const Values& values, const std::string& mesh) {
  Ice ice;
  ice.length = values.number("ice.length"), ice.width = values.number("ice.width");
  ice.thickness = values.number("ice.thickness");
  ice.lower_face = values.number("ice.lower_face");
  read_ice_mesh(values, mesh, ice);
  ice.material = values.text("ice.material");
  ice.critical_strain = values.number("ice.critical_strain");
  ice.flaws = values.number("ice.flaws");
  ice.particles = values.text("ice.particles");
  ice.integration = values.text("ice.integration");
  ice.held_rim = values.number("ice.held_rim");
  ice.sleeping_threshold = values.number("ice.sleeping_threshold");
  if (2 * ice.held_rim > std::min(ice.length, ice.width))
    values.fail("ice.held_rim", "must be at most half of ice.length and ice.width");
  if (values.has("ice.ball")) {
    if (values.has("ice.bending")) values.fail("ice.ball.diameter", "a ball is not bent; remove [ice.bending]");
    if (ice.held_rim > 0) values.fail("ice.held_rim", "a ball has no rim; leave it out");
    ice.ball = {values.number("ice.ball.diameter", 0), values.number("ice.ball.speed", 0)};
    ice.length = ice.width = ice.thickness = ice.ball->diameter;
  }
  if (values.has("ice.bending")) {
    Bending b{values.number("ice.bending.support_span", 0), values.number("ice.bending.load_span", 0),
              values.number("ice.bending.speed", 0), values.number("ice.bending.ramp_time")};
    if (b.support_span >= ice.length) values.fail("ice.bending.support_span", "must be below ice.length");
    if (b.load_span >= b.support_span) values.fail("ice.bending.load_span", "must be below ice.bending.support_span");
    ice.bending = b;
  }
  ice.sides = values.text("ice.sides");
  if (ice.sides == "auto") ice.sides = ice.bending || ice.ball || ice.mesh ? "free" : "non_reflecting";
  ice.start = values.text("ice.start");
  ice.equilibrium = values.text("ice.equilibrium");
  if (ice.start == "equilibrium" && (!values.has("water") || ice.ball || ice.bending))
    values.fail("ice.start", "ice that meets no water starts without loads; must be auto or unloaded");
  if (ice.start == "auto") ice.start = "unloaded";
  if (ice.start == "unloaded" && ice.equilibrium != "auto" && !values.has("water"))
    values.fail("ice.equilibrium", "ice that meets no water starts without loads; must be auto");
  ice.damping = values.number("ice.damping");
  if (ice.damping > 0 && (values.has("vehicle") || ice.ball || ice.bending))
    values.fail("ice.damping",
                "is for a plate that comes to rest under water and weight; must be 0 beside [vehicle], "
                "[ice.ball] and [ice.bending]");
  if (ice.bending && ice.sides != "free")
    values.fail("ice.sides", "a beam between rollers is free; must be auto or free");
  if (ice.ball && ice.sides != "free") values.fail("ice.sides", "a ball has no sides; must be auto or free");
  return ice;
}

}  // namespace polynya::scene
