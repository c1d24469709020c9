// The ice's mesh from a file: what the scene says of it, and the facts that the launcher found in it.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/scene/parts.hpp"
#include "core/scene/rows.hpp"

namespace polynya::scene {
namespace {

std::string support_of(const Values& values, const std::string& name) {
  const std::string key = "ice.supports." + name, held = values.text(key);
  if (held == "non_reflecting") return held;
  std::string components;
  for (const char axis : {'x', 'y', 'z'})
    if (std::count(held.begin(), held.end(), axis) == 1) components += axis;
  if (components.empty() || components.size() != held.size())
    values.fail(key, "must be components such as \"z\", \"xy\" or \"xyz\", or \"non_reflecting\"");
  return components;
}

/// The tables whose keys are names of sets.
const std::vector<std::string> tables_of_sets{"ice.supports", "ice.pressures", "ice.forces"};

std::map<std::string, Curve> curves_of(const Values& values, const std::string& table, std::size_t components,
                                       const Dimension& dimension, const std::string& example) {
  std::map<std::string, Curve> curves;
  for (const std::string& name : values.keys_below(table))
    read_table(values, table + "." + name, components, dimension, example, curves[name].times, curves[name].rows);
  return curves;
}

/// The box and the counts of the file; the size of the full plate is that of the box mirrored at the axes.
void take_facts(const nlohmann::json& facts, IceMesh& mesh, Ice& ice) {
  facts.at("low").get_to(mesh.low), facts.at("high").get_to(mesh.high);
  facts.at("elements").get_to(mesh.elements), facts.at("nodes").get_to(mesh.nodes);
  facts.at("boundary_faces").get_to(mesh.boundary_faces);
  facts.at("volume").get_to(mesh.volume), facts.at("thinnest").get_to(mesh.thinnest);
  ice.length = 2 * std::max(std::abs(mesh.low.at(0)), std::abs(mesh.high.at(0)));
  ice.width = 2 * std::max(std::abs(mesh.low.at(1)), std::abs(mesh.high.at(1)));
  ice.lower_face = mesh.low.at(2), ice.thickness = mesh.high.at(2) - mesh.low.at(2);
}

}  // namespace

nlohmann::json to_json(const WantedMesh& wanted) {
  return {{"file", wanted.file},
          {"unit", wanted.unit},
          {"pieces", wanted.pieces},
          {"planes", wanted.planes},
          {"sets", wanted.sets}};
}

WantedMesh read_wanted_mesh(const Values& values) {
  WantedMesh wanted;
  wanted.file = std::filesystem::absolute(values.folder() / values.text("ice.mesh")).lexically_normal();
  wanted.unit = values.text("ice.mesh_unit");
  if (wanted.unit == "none")
    values.fail("ice.mesh_unit", "missing; the unit of the file's coordinates must be m, cm, mm, um, in or ft");
  wanted.pieces = static_cast<long>(values.number("ice.mesh_pieces"));
  for (const std::string& table : tables_of_sets)
    for (const std::string& name : values.keys_below(table))
      if (std::find(wanted.sets.begin(), wanted.sets.end(), name) == wanted.sets.end()) wanted.sets.push_back(name);
  return wanted;
}

void read_ice_mesh(const Values& values, const std::string& facts, Ice& ice) {
  if (!values.is_given("ice.mesh")) {
    for (const std::string key : {"ice.mesh_unit", "ice.mesh_pieces", "ice.velocity"})
      if (values.is_given(key)) values.fail(key, "belongs to ice.mesh; give that as well or leave this out");
    for (const std::string& table : tables_of_sets)
      for (const auto& name : values.keys_below(table))
        values.fail(table + "." + name, "names a set of ice.mesh; give that as well or leave this out");
    return;
  }
  for (const std::string key : {"ice.length", "ice.width", "ice.thickness", "ice.lower_face"})
    if (values.is_given(key)) values.fail(key, "is that of ice.mesh; leave it out");
  if (values.has("ice.ball")) values.fail("ice.mesh", "cannot stand beside [ice.ball]; remove one");
  const WantedMesh wanted = read_wanted_mesh(values);
  if (facts.empty())
    values.fail("ice.mesh", "the file is read by ./polynya; resolve_scene alone needs --mesh with its facts");
  IceMesh& mesh = ice.mesh.emplace();
  mesh.file = wanted.file, mesh.unit = wanted.unit, mesh.pieces = wanted.pieces;
  mesh.velocity = values.number("ice.velocity");
  for (const auto& name : values.keys_below("ice.supports")) mesh.supports[name] = support_of(values, name);
  mesh.pressures = curves_of(values, "ice.pressures", 1, dimension::pressure, "0 at 0; 20 kPa at 1 ms");
  mesh.forces = curves_of(values, "ice.forces", 3, dimension::force, "0, 0, 0 at 0; 0, 0, -10 N at 1 ms");
  try {
    take_facts(nlohmann::json::parse(facts), mesh, ice);
  } catch (const std::exception& error) {
    values.fail("ice.mesh", std::string("--mesh is not what ./polynya finds in a file: ") + error.what());
  }
}

}  // namespace polynya::scene
