#include "ice_solver/scene_options.hpp"

#include <stdexcept>

#include "core/scene/graded_line.hpp"

namespace polynya::ice {

IceOptions options_from_scene(const scene::Scene& scene) {
  if (!scene.ice) throw std::invalid_argument("the scene has no ice: nothing to do for the ice solver");
  const scene::Ice& ice = *scene.ice;
  if (ice.particles != "element_centre")
    throw std::invalid_argument("ice.particles is \"" + ice.particles + "\"; it must be element_centre");
  const scene::MaterialCard& card = scene.material(ice.material);
  const scene::GridLines lines = scene::ice_grid_lines(scene);
  IceOptions options;
  options.x = lines.x, options.y = lines.y, options.z = lines.z;
  options.law = continuum::law_from_card(card.name, card.law, card.values);
  if (!scene.effect("ice_failure")) options.law = continuum::elastic_part(options.law);
  options.planes.x = scene.symmetry == scene::Symmetry::quarter;
  options.planes.y = scene.symmetry != scene::Symmetry::full;
  options.sides = ice.bending ? Sides::free : sides_from_name(ice.sides);
  options.conversion = scene.effect("conversion");
  options.critical_strain = ice.critical_strain;
  options.own_contact = scene.effect("debris_contact");
  options.contact_friction = scene.contact.friction;
  options.contact_stiffness_factor = scene.contact.stiffness_factor;
  options.gravity = scene.run.gravity;
  return options;
}

double multiplicity(const scene::Scene& scene) {
  if (scene.symmetry == scene::Symmetry::full) return 1;
  return scene.symmetry == scene::Symmetry::half ? 2 : 4;
}

}  // namespace polynya::ice
