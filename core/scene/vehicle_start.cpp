// How the vehicle starts: hull from a file, place, turning, ballast, and what the symmetry allows of it.
#include <cmath>
#include <map>
#include <sstream>

#include "core/scene/parts.hpp"
#include "core/scene/units.hpp"
#include "geometry/error.hpp"
#include "geometry/hull/import_hull.hpp"

namespace polynya::scene {
namespace {

const std::map<std::string, double> file_units{{"m", 1},     {"cm", 1e-2},   {"mm", 1e-3},
                                               {"um", 1e-6}, {"in", 0.0254}, {"ft", 0.3048}};

/// What a quarter (x >= 0, y >= 0) or a half (y >= 0) cannot mirror.
struct Askew {
  std::string key, reason;
  Symmetry most;  ///< the smallest model that holds it
};
const std::vector<Askew> askew_keys{
    {"vehicle.angle", "tilts the axis out of the plane x = 0", Symmetry::half},
    {"vehicle.offset_x", "moves the vehicle out of the plane x = 0", Symmetry::half},
    {"vehicle.pitch_rate", "turns the vehicle out of the plane x = 0", Symmetry::half},
    {"vehicle.offset_y", "moves the vehicle out of the plane y = 0", Symmetry::full},
    {"vehicle.spin", "turns with one hand, a mirror image with the other", Symmetry::full},
};

bool has_file(const Values& values) {
  return values.text("vehicle.surface_file") != "none";
}

double number_in(const Values& values, const std::string& text, const Dimension& dimension) {
  try {
    const Quantity quantity = parse_quantity(text);
    if (quantity.bare || quantity.dimension == dimension) return quantity.value;
  } catch (const std::invalid_argument&) {
  }
  values.fail("vehicle.ballast", "'" + text + "' is not " + describe(dimension) +
                                     "; must be point masses such as \"1 g at 0, 0, -30 mm; 2 g at 1 mm, 0, -50 mm\"");
}

std::vector<double> read_ballast(const Values& values) {
  std::vector<double> ballast;
  const std::string text = values.text("vehicle.ballast");
  if (text == "none") return ballast;
  std::istringstream points(text);
  for (std::string point; std::getline(points, point, ';');) {
    const auto at = point.find(" at ");
    ballast.push_back(number_in(values, point.substr(0, at), dimension::mass));
    if (ballast.back() <= 0) values.fail("vehicle.ballast", "a mass must be above 0");
    std::istringstream place(at == std::string::npos ? "" : point.substr(at + 4));
    int count = 0;
    for (std::string word; std::getline(place, word, ','); ++count)
      ballast.push_back(number_in(values, word, dimension::length));
    if (count != 3)
      values.fail("vehicle.ballast", "'" + point + "' has no place of three lengths; write \"1 g at 0, 0, -30 mm\"");
  }
  return ballast;
}

geometry::ImportedHull import(const Values& values, const HullFile& h) {
  const auto repair = h.repair == "none"   ? geometry::Repair::none
                      : h.repair == "safe" ? geometry::Repair::safe
                                           : geometry::Repair::wrap;
  try {
    return geometry::import_hull(h.file, {h.unit, h.nose, repair, h.wrap_alpha, h.wrap_offset});
  } catch (const geometry::GeometryError& error) {
    values.fail("vehicle.surface_file", error.what());
  }
}

}  // namespace

double file_unit(const Values& values, const std::string& key) {
  const std::string unit = values.text(key);
  if (unit == "none")
    values.fail(key, "missing; a file of a surface does not say its unit; must be m, cm, mm, um, in or ft");
  return file_units.at(unit);
}

Symmetry natural_symmetry(const Values& values) {
  if (has_file(values)) return Symmetry::full;
  Symmetry found = Symmetry::quarter;
  for (const Askew& askew : askew_keys)
    if (values.number(askew.key) != 0 && static_cast<int>(askew.most) < static_cast<int>(found)) found = askew.most;
  return found;
}

void read_hull_file(const Values& values, Vehicle& v) {
  v.ballast = read_ballast(values);
  if (!has_file(values)) {
    for (const std::string key : {"file_unit", "file_nose", "repair", "wrap_alpha", "wrap_offset"})
      if (values.is_given("vehicle." + key)) values.fail("vehicle." + key, "needs vehicle.surface_file");
    return;
  }
  for (const std::string key : {"head", "head_length", "diameter", "length", "interior", "wall_thickness"})
    if (values.is_given("vehicle." + key))
      values.fail("vehicle." + key, "cannot stand beside vehicle.surface_file, which gives the shape; leave it out");
  HullFile h;
  h.unit = file_unit(values, "vehicle.file_unit");
  h.file = std::filesystem::absolute(values.folder() / values.text("vehicle.surface_file")).lexically_normal().string();
  h.nose = values.text("vehicle.file_nose"), h.repair = values.text("vehicle.repair");
  h.wrap_alpha = values.number("vehicle.wrap_alpha", 0), h.wrap_offset = values.number("vehicle.wrap_offset", 0);
  const geometry::ImportedHull hull = import(values, h);
  h.volume = hull.solid.volume, h.note = hull.note;
  for (const geometry::Point& p : hull.outer.points) {
    v.diameter = std::max(v.diameter, 2 * std::hypot(p[0], p[1]));
    v.length = std::max(v.length, -p[2]);
  }
  v.head = "imported", v.interior = "solid", v.head_length = 0.5 * std::min(v.diameter, v.length), v.deformable = false;
  v.surface = h;
}

void check_start(const Values& values, const Scene& scene) {
  const Vehicle& v = *scene.vehicle;
  const char* model = scene.symmetry == Symmetry::quarter ? "quarter" : "half";
  for (const Askew& askew : askew_keys)
    if (values.number(askew.key) != 0 && static_cast<int>(askew.most) < static_cast<int>(scene.symmetry))
      values.fail(askew.key, askew.reason + ", which a " + model + " model cannot hold; set symmetry = \"" +
                                 (askew.most == Symmetry::half ? "half\" or \"full\"" : "full\""));
  if (v.surface && scene.symmetry != Symmetry::full)
    values.fail("vehicle.surface_file", "nothing is known of its symmetry; set symmetry = \"full\"");
  for (std::size_t i = 0; i + 3 < v.ballast.size(); i += 4)
    if ((v.ballast[i + 1] != 0 && scene.symmetry == Symmetry::quarter) ||
        (v.ballast[i + 2] != 0 && scene.symmetry != Symmetry::full))
      values.fail("vehicle.ballast", std::string("lies off a plane of symmetry of the ") + model +
                                         " model; set symmetry = \"full\", or put it on the axis");
  if (!v.deformable) return;
  for (const std::string key : {"vehicle.spin", "vehicle.pitch_rate"})
    if (values.number(key) != 0)
      values.fail(key,
                  "an elastic hull would start without the stress that turning gives it; set "
                  "effects.deformable_vehicle = \"off\"");
  if (!v.ballast.empty())
    values.fail("vehicle.ballast", "needs a rigid vehicle; set effects.deformable_vehicle = \"off\"");
}

}  // namespace polynya::scene
