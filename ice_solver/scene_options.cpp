#include "ice_solver/scene_options.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/continuum/fracture_energy.hpp"
#include "core/scene/graded_line.hpp"

namespace polynya::ice {

namespace {

Debris debris_from_name(const std::string& name) {
  if (name == "element_centre") return Debris::particles;
  if (name == "free_masses") return Debris::free_masses;
  if (name == "none") return Debris::none;
  throw std::invalid_argument("ice.particles is \"" + name + "\"; it must be element_centre, free_masses or none");
}

continuum::Integration integration_from_name(const std::string& name) {
  if (name == "one_point") return continuum::Integration::one_point;
  if (name == "full") return continuum::Integration::full;
  throw std::invalid_argument("ice.integration is \"" + name + "\"; it must be one_point or full");
}

continuum::EquilibriumMethod equilibrium_from_name(const std::string& name) {
  if (name == "auto") return continuum::EquilibriumMethod::automatic;
  if (name == "newton") return continuum::EquilibriumMethod::newton;
  if (name == "relaxation") return continuum::EquilibriumMethod::relaxation;
  throw std::invalid_argument("ice.equilibrium is \"" + name + "\"; it must be auto, newton or relaxation");
}

/// Of the elements about the axis, m: cracks run between elements along any axis, so the cube root of the volume.
double element_size(const scene::GridLines& lines) {
  const auto at_axis = [](const std::vector<double>& line) {
    const auto right = std::upper_bound(line.begin(), line.end() - 1, 1e-9);
    return *right - *(right - 1);
  };
  return std::cbrt(at_axis(lines.x) * at_axis(lines.y) * (lines.z[1] - lines.z[0]));
}

/// Of a mesh from a file, m: that of its mean element.
double mean_element_size(const scene::IceMesh& mesh) {
  return std::cbrt(mesh.volume / static_cast<double>(mesh.elements));
}

}  // namespace

IceOptions options_from_scene(const scene::Scene& scene) {
  if (!scene.ice) throw std::invalid_argument("the scene has no ice: nothing to do for the ice solver");
  const scene::Ice& ice = *scene.ice;
  const scene::MaterialCard& card = scene.material(ice.material);
  const scene::GridLines lines = ice.mesh ? scene::GridLines{} : scene::ice_grid_lines(scene);
  IceOptions options;
  options.x = lines.x, options.y = lines.y, options.z = lines.z;
  options.law = continuum::law_from_card(card.name, card.law, card.values);
  if (!scene.effect("ice_failure")) options.law = continuum::elastic_part(options.law);
  if (scene.effect("damage_regularisation"))
    options.law = continuum::regularised(std::get<continuum::JohnsonHolmquist2>(options.law),
                                         ice.mesh ? mean_element_size(*ice.mesh) : element_size(lines));
  options.planes.x = scene.symmetry == scene::Symmetry::quarter;
  options.planes.y = scene.symmetry != scene::Symmetry::full;
  options.sides = ice.bending ? Sides::free : sides_from_name(ice.sides);
  options.damping = ice.damping;
  options.held_rim = ice.held_rim;
  if (ice.ball) {
    options.sides = Sides::free;
    options.ball = {0.5 * ice.ball->diameter, scene.resolution.ice_element, ice.lower_face, ice.ball->speed};
  }
  options.numerics.integration = integration_from_name(ice.integration);
  options.equilibrium = equilibrium_from_name(ice.equilibrium);
  options.debris = debris_from_name(ice.particles);
  options.conversion = scene.effect("conversion");
  options.critical_strain = ice.critical_strain;
  if (scene.effect("ice_failure")) options.flaws = ice.flaws;
  options.seed = static_cast<std::uint64_t>(scene.run.seed);
  options.own_contact = scene.effect("debris_contact");
  options.contact_friction = scene.contact.friction;
  options.contact_stiffness_factor = scene.contact.stiffness_factor;
  options.gravity = scene.run.gravity;
  options.sleeping_threshold = ice.sleeping_threshold;
  return options;
}

double multiplicity(const scene::Scene& scene) {
  if (scene.symmetry == scene::Symmetry::full) return 1;
  return scene.symmetry == scene::Symmetry::half ? 2 : 4;
}

}  // namespace polynya::ice
