#include "structure_solver/build_vehicle.hpp"

#include <cstdio>
#include <numeric>
#include <stdexcept>

#include "structure_solver/deformable_vehicle.hpp"
#include "structure_solver/rigid_vehicle.hpp"

namespace polynya::structure {
namespace {

geometry::Portion portion_of(scene::Symmetry symmetry) {
  switch (symmetry) {
    case scene::Symmetry::quarter:
      return geometry::Portion::quarter;
    case scene::Symmetry::half:
      return geometry::Portion::half;
    case scene::Symmetry::full:
      break;
  }
  return geometry::Portion::full;
}

continuum::Law material_of(const scene::Scene& scene) {
  const scene::MaterialCard& card = scene.material(scene.vehicle->material);
  if (card.law != "elastic" && card.law != "j2_plastic")
    throw std::invalid_argument("vehicle.material = \"" + scene.vehicle->material + "\" follows the law \"" + card.law +
                                "\"; the structure solver has \"elastic\" and \"j2_plastic\"");
  return continuum::law_from_card(card.name, card.law, card.values);
}

/// Volume of the material of the exact shape, m^3.
double exact_volume(const geometry::Meridian& outline, double wall_thickness) {
  const double outer = geometry::enclosed_volume(outline);
  return wall_thickness > 0 ? outer - geometry::enclosed_volume(geometry::InnerOutline(outline, wall_thickness))
                            : outer;
}

std::string in_words(const char* format, double value) {
  char text[200];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

}  // namespace

BuiltVehicle build_vehicle(const scene::Scene& scene) {
  if (!scene.vehicle) throw std::invalid_argument("the scene has no [vehicle]");
  const scene::Vehicle& v = *scene.vehicle;
  continuum::Law material = material_of(scene);
  const double density = continuum::density(material);
  const geometry::Meridian outline(geometry::head_shape(v.head), v.head_length, v.diameter, v.length);
  geometry::VehicleMeshOptions options;
  options.element_size = scene.resolution.vehicle_element;
  options.portion = portion_of(scene.symmetry);
  options.nose_position = v.nose_position;
  options.wall_thickness = v.interior == "hollow" ? v.wall_thickness : 0;
  const int portions = geometry::portions_in_whole(options.portion);

  BuiltVehicle built;
  built.nominal_density = density;
  const bool wall_from_mass = v.interior == "hollow" && v.mass > 0;
  if (wall_from_mass) {
    options.wall_thickness = geometry::wall_thickness_for_volume(outline, options, v.mass / density / portions);
    built.mass_note =
        in_words("The wall is %.4f mm thick so that the mesh has the requested mass.", options.wall_thickness * 1e3);
  }
  built.mesh = geometry::make_vehicle_mesh(outline, options);
  built.quality = geometry::measure_quality(built.mesh.hexahedra);
  if (!wall_from_mass) {
    const double whole = v.mass > 0 ? v.mass : density * exact_volume(outline, options.wall_thickness);
    continuum::set_density(material, whole / portions / built.quality.volume);
    built.mass_note = in_words(v.mass > 0 ? "The density is scaled by %.6f (ballast) to meet the requested mass."
                                          : "The density is scaled by %.6f because the mesh is inscribed in the shape.",
                               continuum::density(material) / built.nominal_density);
  }
  built.density = continuum::density(material);

  const Launch launch{v.speed, scene.run.gravity, v.nose_position, v.length, options.element_size};
  auto deformable = std::make_unique<DeformableVehicle>(built.mesh, material, launch);
  built.node_masses = deformable->solid().masses;
  built.mass = std::accumulate(built.node_masses.begin(), built.node_masses.end(), 0.0);
  built.whole_mass = portions * built.mass;
  if (v.deformable) {
    built.body = std::move(deformable);
  } else {
    built.body = std::make_unique<RigidVehicle>(built.mesh, built.node_masses, options.portion, launch);
  }
  return built;
}

}  // namespace polynya::structure
