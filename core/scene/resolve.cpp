#include "core/scene/resolve.hpp"

#include <algorithm>

#include "core/scene/document.hpp"
#include "core/scene/effects.hpp"
#include "core/scene/material_cards.hpp"
#include "core/scene/parts.hpp"
#include "core/scene/scene_error.hpp"
#include "core/scene/values.hpp"

namespace polynya::scene {
namespace {

const std::vector<std::string> level_names{"quick", "standard", "fine"};

/// Takes the [level.*] tables out of the document, checks them all and merges the chosen one. Returns its name.
std::string apply_level(Document& document, const std::string& wanted) {
  const std::string level = wanted.empty() ? "quick" : wanted;
  const auto known = [&](const std::string& name) {
    return std::find(level_names.begin(), level_names.end(), name) != level_names.end();
  };
  if (!known(level)) throw SceneError("--level " + level + ": unknown level; one of quick, standard, fine");
  bool defined = false;
  Document levels = take_below(document, "level");
  for (const auto& name : level_names) {
    const bool here = levels.tables.contains(name);
    Document part = take_below(levels, name);
    check_keys(part);
    if (name == level) merge(document, part), defined = here;
  }
  for (const auto& [path, where] : levels.tables)
    throw SceneError(where + ": unknown level '" + path + "'; one of quick, standard, fine");
  for (const auto& [path, entry] : levels.values)
    throw SceneError(entry.where + ": unknown key 'level." + path + "'; a level is a table such as [level.quick]");
  if (!wanted.empty() && wanted != "quick" && !defined)
    throw SceneError("--level " + level + ": " + document.file.string() + " has no [level." + level + "]");
  return level;
}

struct MaterialUse {
  std::string key;  ///< "vehicle.material"
  std::vector<std::string> laws;
};

std::vector<MaterialUse> material_uses(const Values& values) {
  const std::vector<std::string> fluids{"mie_grueneisen", "linear_polynomial", "ideal_gas", "stiffened_gas", "tait"};
  if (values.has("tube")) return {{"tube.left.material", fluids}, {"tube.right.material", fluids}};
  std::vector<MaterialUse> uses;
  if (values.has("vehicle")) uses.push_back({"vehicle.material", {"elastic", "j2_plastic"}});
  if (values.has("ice")) uses.push_back({"ice.material", {"johnson_holmquist_2", "j2_plastic", "elastic"}});
  if (values.has("water")) uses.push_back({"water.material", {"mie_grueneisen", "stiffened_gas", "tait"}});
  if (values.has("air")) uses.push_back({"air.material", {"linear_polynomial", "ideal_gas"}});
  return uses;
}

std::string place_of(const Document& document, const std::string& key) {
  const auto found = document.values.find(key);
  return found == document.values.end() ? document.file.string() : found->second.where;
}

void load_materials(Document document, const Values& values, Scene& scene) {
  const std::vector<std::filesystem::path> folders{document.file.parent_path() / "materials", project_materials()};
  for (const MaterialUse& use : material_uses(values)) {
    const auto name = values.text(use.key);
    if (!scene.materials.contains(name)) {
      auto card = find_card(name, folders, place_of(document, use.key) + ": " + use.key + " = \"" + name + "\"");
      override_values(card, take_below(document, "materials." + name));
      try {
        check_card(card);
      } catch (const std::invalid_argument& error) {
        throw SceneError(place_of(document, use.key) + ": materials." + name + ": " + error.what());
      }
      scene.materials[name] = std::move(card);
    }
    const auto& law = scene.materials[name].law;
    if (std::find(use.laws.begin(), use.laws.end(), law) != use.laws.end()) continue;
    std::string list;
    for (const auto& possible : use.laws) list += (list.empty() ? "" : " or ") + possible;
    values.fail(use.key, "the card's law is " + law + "; it must be " + list);
  }
  for (const auto& [path, entry] : document.values)
    if (path.starts_with("materials."))
      throw SceneError(entry.where + ": " + path + ": the scene does not use such a card");
}

void check_dam(const Document& document, const Values& values) {
  for (const std::string solid : {"vehicle", "ice"})
    if (values.has(solid))
      throw SceneError(document.tables.at(solid) + ": [" + solid + "] cannot stand beside [dam]; remove one");
  if (!values.has("water")) throw SceneError(document.tables.at("dam") + ": [dam] needs [water] and [air]");
  const std::vector<std::string> known{"water.material",        "air.material", "air.pressure",
                                       "fluid.shock_viscosity", "fluid.sweeps", "fluid.sleeping_threshold"};
  for (const auto& [path, entry] : document.values) {
    const bool fluid = path.starts_with("water.") || path.starts_with("air.") || path.starts_with("fluid.");
    if (fluid && std::find(known.begin(), known.end(), path) == known.end())
      throw SceneError(entry.where + ": " + path +
                       " cannot stand beside [dam], whose tank has walls and its own sizes");
  }
}

void check_sections(const Document& document, const Values& values) {
  const auto& file = document.file.string();
  if (values.has("tube")) {
    for (const std::string other : {"vehicle", "ice", "water", "air", "body"})
      if (values.has(other))
        throw SceneError(document.tables.at(other) + ": [" + other + "] cannot stand beside [tube]; remove one");
    for (const auto& [path, entry] : document.values)
      if (path.starts_with("fluid.") && path != "fluid.shock_viscosity" && path != "fluid.sleeping_threshold" &&
          !path.starts_with("fluid.grid_motion.x."))
        throw SceneError(
            entry.where + ": " + path +
            " cannot stand beside [tube], which has only fluid.shock_viscosity, fluid.sleeping_threshold and "
            "fluid.grid_motion.x");
    for (const std::string side : {"tube.left", "tube.right"})
      if (!values.has(side)) throw SceneError(document.tables.at("tube") + ": [" + side + "] is missing");
    return;
  }
  if (values.has("dam")) check_dam(document, values);
  if (values.has("body"))
    for (const std::string other : {"vehicle", "ice", "dam"})
      if (values.has(other))
        throw SceneError(document.tables.at(other) + ": [" + other + "] cannot stand beside [body]; remove one");
  if (values.has("body") && !values.has("water"))
    throw SceneError(document.tables.at("body") + ": [body] needs [water] and [air] around it");
  if (values.has("water") != values.has("air"))
    throw SceneError(document.tables.at(values.has("water") ? "water" : "air") +
                     ": [water] and [air] come together; add [" + (values.has("water") ? "air" : "water") + "]");
  if (values.has("ice.ball") && values.has("water"))
    throw SceneError(document.tables.at("water") + ": [water] cannot stand beside [ice.ball]; remove one");
  if (values.has("fluid") && !values.has("water"))
    throw SceneError(document.tables.at("fluid") + ": [fluid] needs [water] and [air]");
  if (!values.has("vehicle") && !values.has("ice") && !values.has("water"))
    throw SceneError(file +
                     ": an empty scene; it needs [vehicle], [ice], [water] with [air], [water] with [air] and "
                     "[dam] or [body.NAME], or [tube]");
}

Symmetry symmetry_of(const Values& values, const std::string& wish_for_effect) {
  const auto name = values.text("symmetry");
  if (values.has("tube")) {
    if (name != "auto" && name != "full") values.fail("symmetry", "a tube is modelled whole; must be full");
    return Symmetry::full;
  }
  if (values.has("dam")) {
    if (name != "auto" && name != "full") values.fail("symmetry", "a tank is modelled whole; must be full");
    return Symmetry::full;
  }
  if (wish_for_effect == "off") return Symmetry::full;
  if (name == "auto" && values.has("body")) return symmetry_of_bodies(values);
  if (name == "auto" && values.is_given("ice.mesh")) return Symmetry::full;
  if (name == "auto") return values.has("vehicle") ? natural_symmetry(values) : Symmetry::quarter;
  return name == "full" ? Symmetry::full : name == "half" ? Symmetry::half : Symmetry::quarter;
}

EffectRequest effect_requests(const Values& values) {
  EffectRequest request;
  for (const auto& name : effect_names()) request.requested[name] = values.text("effects." + name);
  request.has_fluid_section = values.has("water") || values.has("tube");
  return request;
}

void read_participants(const Values& values, Scene& scene) {
  const auto add = [&](const std::string& name) {
    const auto path = "participants." + name;
    scene.participants[name] = {values.text(path + ".command"), values.text(path + ".launch"),
                                static_cast<int>(values.number(path + ".threads"))};
  };
  if (scene.vehicle) add("structure");
  if (scene.ice) add("ice");
  if (scene.fluid) add("fluid");
}

void read_parts(const Values& values, const ResolveOptions& options, Scene& scene) {
  scene.contact.friction = values.number("contact.friction");
  scene.contact.stiffness_factor = values.number("contact.stiffness_factor");
  scene.contact.damping = values.number("contact.damping");
  scene.contact.two_way = values.text("contact.two_way");
  scene.contact.edges = values.text("contact.edges");
  scene.overlap.method = values.text("overlap.method");
  if (values.has("vehicle")) scene.vehicle = read_vehicle(values);
  if (values.has("ice")) scene.ice = read_ice(values, options.mesh);
  if (scene.ice && scene.ice->flaws > 0 && scene.material(scene.ice->material).law != "johnson_holmquist_2")
    values.fail("ice.flaws", "needs a card of law johnson_holmquist_2; " + scene.ice->material + " is " +
                                 scene.material(scene.ice->material).law);
  if (scene.vehicle) check_hull(values, *scene.vehicle, scene.material(scene.vehicle->material));
  if (scene.vehicle) place_vehicle(values, scene);
  read_run(values, scene);
  if (values.has("body")) scene.fluid.emplace(), read_bodies(values, scene);
  read_resolution(values, scene);
  if (values.has("tube")) {
    scene.fluid.emplace().tube = read_tube(values);
    scene.fluid->grid_follows = "none";
    scene.fluid->shock_viscosity = values.text("fluid.shock_viscosity");
    scene.fluid->sleeping_threshold = values.number("fluid.sleeping_threshold");
  }
  if (values.has("dam"))
    scene.fluid.emplace(), read_dam(values, scene);
  else if (values.has("water"))
    read_fluid(values, scene);
  if (scene.fluid && scene.fluid->bodies) check_bodies(values, scene);
  if (scene.fluid) read_grid_motion(values, scene);
}

/// Cards of parts that the effects switched off are no longer part of the scene.
void drop_unused_materials(Scene& scene) {
  std::erase_if(scene.materials, [&](const auto& item) {
    const auto& name = item.first;
    const bool solid = (scene.vehicle && scene.vehicle->material == name) || (scene.ice && scene.ice->material == name);
    const auto& tube = scene.fluid ? scene.fluid->tube : std::nullopt;
    const bool wet = scene.fluid && (scene.fluid->water == name || scene.fluid->air == name);
    return !solid && !wet && !(tube && (tube->left.material == name || tube->right.material == name));
  });
}

std::string case_name(const std::filesystem::path& file) {
  const auto folder = std::filesystem::absolute(file).parent_path().filename().string();
  return file.filename() == "scene.toml" ? folder : file.stem().string();
}

/// The scene file with level and settings, and the level's name.
Document composed(const std::filesystem::path& path, const ResolveOptions& options, std::string& level) {
  Document document = read_document(std::filesystem::is_directory(path) ? path / "scene.toml" : path);
  level = apply_level(document, options.level);
  for (const auto& setting : options.settings) merge(document, read_setting(setting));
  return document;
}

}  // namespace

std::optional<WantedMesh> wanted_mesh(const std::filesystem::path& path, const ResolveOptions& options) {
  std::string level;
  const Document document = composed(path, options, level);
  const Values values(document);
  if (!values.is_given("ice.mesh") || !options.mesh.empty()) return std::nullopt;
  const Symmetry symmetry = symmetry_of(values, values.text("effects.symmetry"));
  WantedMesh wanted = read_wanted_mesh(values);
  if (symmetry == Symmetry::quarter) wanted.planes.push_back(0);
  if (symmetry != Symmetry::full) wanted.planes.push_back(1);
  return wanted;
}

Scene resolve(const std::filesystem::path& path, const ResolveOptions& options) {
  Scene scene;
  Document document = composed(path, options, scene.level);
  const Values values(document);
  check_sections(document, values);
  scene.name = case_name(document.file);
  scene.title = document.values.contains("title") ? values.text("title") : scene.name;
  load_materials(document, values, scene);
  const auto request = effect_requests(values);
  scene.symmetry = symmetry_of(values, request.requested.at("symmetry"));
  read_parts(values, options, scene);
  try {
    decide_effects(scene, request);
  } catch (const ImpossibleEffect& error) {
    values.fail("effects." + error.effect, error.what());
  }
  if (!scene.vehicle && !scene.ice && !scene.fluid)
    values.fail("effects.fluid", "without the fluid nothing is left of the scene; allowed here: auto, on");
  if (scene.vehicle) check_start(values, scene);
  drop_unused_materials(scene);
  read_participants(values, scene);
  read_record(values, scene);
  return scene;
}

}  // namespace polynya::scene
