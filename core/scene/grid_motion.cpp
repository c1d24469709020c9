// How the planes of the fluid's grid move.
#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "core/scene/parts.hpp"
#include "core/scene/units.hpp"

namespace polynya::scene {
namespace {

/// "0, 1 ms, 3 ms" in SI; empty for "none".
std::vector<double> numbers(const Values& values, const std::string& key, const Dimension& dimension) {
  std::vector<double> list;
  const std::string text = values.text(key);
  if (text == "none") return list;
  std::istringstream words(text);
  for (std::string word; std::getline(words, word, ',');) {
    try {
      const Quantity quantity = parse_quantity(word);
      if (!quantity.bare && quantity.dimension != dimension) throw std::invalid_argument("of another dimension");
      list.push_back(quantity.value);
    } catch (const std::invalid_argument&) {
      values.fail(key, "'" + word + "' is not " + describe(dimension) + "; must be a list with commas, from 0 on");
    }
  }
  if (list.empty() || list.front() != 0) values.fail(key, "must be a list with commas that begins with 0");
  return list;
}

AxisMotion read_axis(const Values& values, const std::string& path) {
  AxisMotion axis;
  const double speed = values.number(path + "speed");
  axis.lower_speed = values.number(path + "lower_speed", speed);
  axis.upper_speed = values.number(path + "upper_speed", speed);
  axis.times = numbers(values, path + "times", dimension::time);
  axis.lower_displacement = numbers(values, path + "lower_displacement", dimension::length);
  axis.upper_displacement = numbers(values, path + "upper_displacement", dimension::length);
  if (std::adjacent_find(axis.times.begin(), axis.times.end(), std::greater_equal<>()) != axis.times.end())
    values.fail(path + "times", "must ascend");
  for (const auto& [name, list] :
       {std::pair{"lower_displacement", &axis.lower_displacement}, {"upper_displacement", &axis.upper_displacement}}) {
    if (list->empty()) list->assign(axis.times.size(), 0.0);
    if (list->size() != axis.times.size())
      values.fail(path + name, "must have one entry for each of " + path + "times");
  }
  return axis;
}

bool at_rest(double speed, const std::vector<double>& displacement) {
  return speed == 0 && std::all_of(displacement.begin(), displacement.end(), [](double d) { return d == 0; });
}
bool lower_rests(const AxisMotion& axis) {
  return at_rest(axis.lower_speed, axis.lower_displacement);
}
bool rests(const AxisMotion& axis) {
  return lower_rests(axis) && at_rest(axis.upper_speed, axis.upper_displacement);
}

/// A grid that follows the vehicle.
void check_following(const Values& values, const Scene& scene) {
  if (scene.fluid->grid_follows != "vehicle") return;
  if (!scene.vehicle || scene.ice)
    values.fail("fluid.grid_follows",
                scene.ice ? "the grid follows no vehicle beside [ice] in this version; must be none, or leave out [ice]"
                          : "there is no [vehicle] to follow; must be none");
  if (scene.fluid->outer_boundary != "non_reflecting")
    values.fail("fluid.outer_boundary",
                "walls of a grid that follows the vehicle would push the water as pistons do; "
                "must be non_reflecting, or fluid.grid_follows none");
  if (scene.fluid->sweeps == "all_orders")
    values.fail("fluid.sweeps",
                "a grid that moves is remapped in alternating orders; must be alternating, or fluid.grid_follows none");
}

}  // namespace

void read_grid_motion(const Values& values, Scene& scene) {
  GridMotion motion;
  for (const auto& [name, axis] : {std::pair{"x", &motion.x}, {"y", &motion.y}, {"z", &motion.z}}) {
    const std::string path = std::string("fluid.grid_motion.") + name + ".";
    *axis = read_axis(values, path);
    if (rests(*axis)) continue;
    if (scene.vehicle || scene.ice || scene.fluid->bodies)
      values.fail(path + "speed",
                  "the grid moves by prescription only with [tube], or with [water] and [air] around no solid; with a "
                  "vehicle fluid.grid_follows lets it go along");
    if (scene.fluid->sweeps == "all_orders")
      values.fail(
          "fluid.sweeps",
          "a grid that moves is remapped in alternating orders; leave out fluid.grid_motion, or set alternating");
    const bool symmetric = *name == 'x'   ? scene.symmetry == Symmetry::quarter
                           : *name == 'y' ? scene.symmetry != Symmetry::full
                                          : false;
    if (symmetric && !lower_rests(*axis))
      values.fail(path + "lower_speed",
                  "the lower end is a plane of symmetry and must stay; set 0, or symmetry = \"full\"");
  }
  check_following(values, scene);
  if (!rests(motion.x) || !rests(motion.y) || !rests(motion.z)) scene.fluid->grid_motion = motion;
}

}  // namespace polynya::scene
