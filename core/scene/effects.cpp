#include "core/scene/effects.hpp"

#include <algorithm>
#include <cstdio>
#include <functional>

namespace polynya::scene {
namespace {

/// What `auto` decides, and whether "on" and "off" can be had: an impossible effect says why in `reason` and stays off,
/// one that cannot be left out stays on.
struct Decision {
  bool active;
  std::string reason;
  bool possible = true;
  bool optional = true;
};

Decision impossible(std::string reason) {
  return {false, std::move(reason), false};
}

struct Rule {
  std::string name;
  std::function<Decision(const Scene&)> decide;
  std::function<void(Scene&)> switch_off;
};

void nothing(Scene&) {}

Decision not_available(const Scene&) {
  return impossible("not available in this version");
}

Decision conversion(const Scene& scene) {
  if (!scene.ice) return impossible("the scene has no ice");
  if (scene.ice->bending) return {false, "a bending beam breaks without crushing; its elements stay elements"};
  if (!scene.vehicle && !scene.ice->ball) return {false, "nothing strikes the ice"};
  return {true, "ice elements strained beyond critical_strain become particles"};
}

Decision ice_failure(const Scene& scene) {
  if (!scene.ice) return impossible("the scene has no ice");
  if (scene.material(scene.ice->material).law == "elastic") return impossible("the law of the ice is elastic");
  return {true, "the law of the ice has damage"};
}

Decision damage_regularisation(const Scene& scene) {
  if (!scene.ice) return impossible("the scene has no ice");
  if (!scene.effect("ice_failure")) return impossible("the ice does not fail");
  if (!scene.material(scene.ice->material).has("fracture_energy"))
    return impossible("the card of the ice has no fracture_energy");
  if (scene.ice->bending) return {true, "a crack in the beam takes the card's fracture energy whatever the elements"};
  return {false, "crushing is not a crack; the card's ductility is that of its calibration"};
}

Decision interface_reconstruction(const Scene& scene) {
  if (!scene.fluid) return impossible("the scene has no fluid");
  return {true, "a plane parts the two materials of every cell that they share; the remap knows no other way", true,
          false};
}

Decision cavitation(const Scene& scene) {
  if (!scene.fluid) return impossible("the scene has no fluid");
  if (scene.fluid->tube) return impossible("a tube holds its states without vapour");
  return {true, "the pressure of the water is bounded below by its vapour pressure"};
}

Decision gravity(const Scene& scene) {
  if (scene.run.gravity == 0) return impossible("run.gravity is 0");
  if (scene.fluid && scene.fluid->tube) return impossible("a tube lies horizontal");
  if (scene.ice && scene.ice->ball) return {false, "a blow of milliseconds; the weight is far below its force"};
  if (scene.ice && scene.ice->bending)
    return {false, "a floating beam carries no weight between its rollers; only the rollers bend it"};
  if (scene.fluid && scene.fluid->bodies)
    return {true, "the water starts hydrostatic; forces on bodies have their buoyancy in them"};
  return {true,
          scene.fluid ? "weight acts on the solids and the water starts hydrostatic" : "weight acts on the solids"};
}

Decision friction(const Scene& scene) {
  if (!scene.vehicle || !scene.ice) return impossible("it needs a vehicle and ice");
  if (scene.contact.friction == 0) return impossible("contact.friction is 0");
  return {true, "vehicle and ice slide on each other"};
}

Decision debris_contact(const Scene& scene) {
  if (!scene.effect("conversion")) return impossible("no particles arise without conversion");
  if (scene.ice->particles != "element_centre")
    return impossible("ice.particles is not element_centre: what broke meets no ice");
  return {true, "particles and faces of broken ice meet intact ice by contact where they were not part of it"};
}

Decision debris_displacement(const Scene& scene) {
  if (!scene.fluid) return impossible("the scene has no fluid");
  if (!scene.effect("conversion")) return impossible("no particles arise without conversion");
  return {false, "particles do not feel the water they would push: room of broken ice goes to the water at once"};
}

/// Whether waves leave through named faces of a mesh from a file.
bool has_open_faces(const Ice& ice) {
  return ice.mesh && std::any_of(ice.mesh->supports.begin(), ice.mesh->supports.end(),
                                 [](const auto& support) { return support.second == "non_reflecting"; });
}

Decision non_reflecting(const Scene& scene) {
  const bool ice = scene.ice && (scene.ice->sides == "non_reflecting" || has_open_faces(*scene.ice));
  const bool fluid = scene.fluid && !scene.fluid->tube && scene.fluid->outer_boundary == "non_reflecting";
  if (ice && fluid) return {true, "waves leave through the sides of the ice and the bounds of the fluid"};
  if (ice) return {true, "waves leave through the sides of the ice"};
  if (fluid) return {true, "waves leave through the bounds of the fluid"};
  return impossible("none of ice.sides, ice.supports and fluid.outer_boundary is non_reflecting");
}

void make_reflecting(Scene& scene) {
  if (scene.ice && scene.ice->sides == "non_reflecting") scene.ice->sides = "free";
  if (scene.ice && scene.ice->mesh)
    std::erase_if(scene.ice->mesh->supports, [](const auto& support) { return support.second == "non_reflecting"; });
  if (scene.fluid) scene.fluid->outer_boundary = "wall";
}

Decision symmetry(const Scene& scene) {
  if (scene.symmetry == Symmetry::full) return impossible("symmetry is full");
  return {true, scene.symmetry == Symmetry::half ? "one of two mirrored halves is modelled"
                                                 : "one of four mirrored quarters is modelled"};
}

/// Only fluid at rest sleeps, so it is worth looking for where a scene starts with some.
Decision sleeping(const Scene& scene) {
  if (!scene.fluid) return impossible("the scene has no fluid");
  if (scene.fluid->sweeps == "all_orders") return impossible("the mean of all orders of sweeps goes over every cell");
  if (scene.fluid->grid_motion || scene.fluid->grid_follows == "vehicle")
    return impossible("fluid passes through every cell of a grid that moves");
  char bound[80];
  std::snprintf(bound, sizeof bound, "disturbances below %g of sound speed and bulk modulus are dropped",
                scene.fluid->sleeping_threshold);
  const auto moves = [](const auto& item) {
    return std::any_of(item.second.velocity.begin(), item.second.velocity.begin() + 3, [](double u) { return u != 0; });
  };
  const auto& bodies = scene.fluid->bodies;
  if (bodies && scene.fluid->start == "potential_flow" && std::any_of(bodies->begin(), bodies->end(), moves))
    return {false, "the flow around a body that moves from the start fills the water: nothing is at rest"};
  if (scene.vehicle && scene.fluid->start == "potential_flow")
    return {false, "the flow around the moving vehicle fills the water from the start: nothing is at rest"};
  return {true, std::string("the fluid starts at rest; ") + bound};
}

/// Only ice that is at rest under forces that balance sleeps.
Decision ice_sleeping(const Scene& scene) {
  if (!scene.ice) return impossible("the scene has no ice");
  if (scene.ice->ball) return impossible("all of a ball moves from the start");
  if (scene.ice->mesh && scene.ice->mesh->velocity != 0) return impossible("all of the mesh moves from the start");
  if (scene.ice->bending) return {false, "rollers bend all of the beam"};
  if (scene.fluid && scene.vehicle && scene.fluid->start == "potential_flow")
    return {false, "the flow around the moving vehicle presses on all of the ice from the start"};
  if (scene.run.gravity != 0 && scene.ice->start != "equilibrium")
    return {false, "its weight sets all of the ice in motion from the start"};
  char reason[120];
  std::snprintf(reason, sizeof reason,
                "the ice starts at rest; what would move nodes by less than %g of wave speed is dropped",
                scene.ice->sleeping_threshold);
  return {true, reason};
}

/// In the order of the decisions: later rules look at what earlier ones decided (fluid is decided before).
const std::vector<Rule>& rules() {
  static const std::vector<Rule> list{
      {"deformable_vehicle",
       [](const Scene& s) {
         if (!s.vehicle) return impossible("the scene has no vehicle");
         if (s.vehicle->surface) return impossible("a hull from a file is rigid in this version");
         return Decision{true, "the hull is modelled by finite elements"};
       },
       [](Scene& s) {
         if (s.vehicle) s.vehicle->deformable = false;
       }},
      {"ice_failure", ice_failure, nothing},
      {"damage_regularisation", damage_regularisation, nothing},
      {"conversion", conversion, nothing},
      {"gradient_correction", not_available, nothing},
      {"artificial_stress", not_available, nothing},
      {"interface_reconstruction", interface_reconstruction, nothing},
      {"cavitation", cavitation, nothing},
      {"gravity", gravity, [](Scene& s) { s.run.gravity = 0; }},
      {"friction", friction, [](Scene& s) { s.contact.friction = 0; }},
      {"debris_contact", debris_contact, nothing},
      {"debris_displacement", debris_displacement, nothing},
      {"debris_drag", not_available, nothing},
      {"non_reflecting_boundaries", non_reflecting, make_reflecting},
      {"symmetry", symmetry, [](Scene& s) { s.symmetry = Symmetry::full; }},
      {"sleeping", sleeping,
       [](Scene& s) {
         if (s.fluid) s.fluid->sleeping_threshold = 0;
       }},
      {"ice_sleeping", ice_sleeping,
       [](Scene& s) {
         if (s.ice) s.ice->sleeping_threshold = 0;
       }},
  };
  return list;
}

std::string wish(const EffectRequest& request, const std::string& name) {
  const auto found = request.requested.find(name);
  return found == request.requested.end() ? "auto" : found->second;
}

Effect settle(const std::string& name, const std::string& requested, const Decision& decision) {
  if (requested == "on" && !decision.possible)
    throw ImpossibleEffect(name, decision.reason + "; allowed here: auto, off");
  if (requested == "off" && !decision.optional)
    throw ImpossibleEffect(name, decision.reason + "; allowed here: auto, on");
  if (requested == "on") return {requested, true, decision.active ? decision.reason : "asked for"};
  if (requested == "off") return {requested, false, decision.possible ? "switched off in the scene" : decision.reason};
  return {requested, decision.active, decision.reason};
}

Decision fluid(const Scene& scene, bool has_section) {
  if (!has_section) return impossible("the scene has no [water] and [air] section");
  return {true, scene.fluid->tube ? "the scene is a tube" : "the scene has water and air"};
}

}  // namespace

const std::vector<std::string>& effect_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list{"fluid"};
    for (const Rule& rule : rules()) list.push_back(rule.name);
    return list;
  }();
  return names;
}

void decide_effects(Scene& scene, const EffectRequest& request) {
  scene.effects["fluid"] = settle("fluid", wish(request, "fluid"), fluid(scene, request.has_fluid_section));
  if (!scene.effects["fluid"].active) scene.fluid.reset();
  for (const Rule& rule : rules()) {
    scene.effects[rule.name] = settle(rule.name, wish(request, rule.name), rule.decide(scene));
    if (!scene.effects[rule.name].active) rule.switch_off(scene);
  }
}

}  // namespace polynya::scene
