#include "structure_solver/build_vehicle.hpp"

#include <cstdio>
#include <numeric>
#include <stdexcept>

#include "geometry/hull/import_hull.hpp"
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

constexpr double edges_per_element = 2;  // longest edge of a hull from a file

std::vector<double> shares_of_area(const geometry::VehicleMesh& mesh, double mass) {
  std::vector<double> shares(mesh.hull_nodes.size(), 0.0);
  double whole = 0;
  for (std::size_t t = 0; t < mesh.hull_triangles.size(); t += 3) {
    const auto corner = [&](int c) {
      return Eigen::Vector3d::Map(&mesh.hexahedra.nodes[3 * mesh.hull_triangles[t + c]]);
    };
    const double area = (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm();
    for (int c = 0; c < 3; ++c) shares[mesh.hull_triangles[t + c]] += area;
    whole += 3 * area;
  }
  for (double& share : shares) share *= mass / whole;
  return shares;
}

std::string in_words(const char* format, double value) {
  char text[200];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

Launch launch_of(const scene::Scene& scene) {
  const scene::Vehicle& v = *scene.vehicle;
  return {v.speed, scene.run.gravity, v.nose_position, v.length, scene.resolution.vehicle_element,
          v.angle, v.offset_x,        v.offset_y,      v.spin,   v.pitch_rate};
}

void note_mass_properties(BuiltVehicle& built, const RigidMotion& at_rest) {
  for (int c = 0; c < 3; ++c) {
    built.centre[c] = at_rest.centre[c];
    for (int d = 0; d < 3; ++d) built.inertia[c][d] = at_rest.inertia(c, d);
  }
}

/// The rigid body with its ballast, and what it says of itself.
void make_rigid(BuiltVehicle& built, const scene::Scene& scene, RigidMotion at_rest, geometry::Portion portion) {
  const Launch launch = launch_of(scene);
  const std::vector<double>& ballast = scene.vehicle->ballast;
  for (std::size_t i = 0; i + 3 < ballast.size(); i += 4) {
    std::array<double, 3> place{ballast[i + 1], ballast[i + 2], ballast[i + 3] + launch.nose_position};
    launch.place(place);
    add_point_mass(at_rest, {ballast[i] / geometry::portions_in_whole(portion), {place[0], place[1], place[2]}});
  }
  note_mass_properties(built, at_rest);
  built.mass = at_rest.mass;
  built.whole_mass = geometry::portions_in_whole(portion) * at_rest.mass;
  built.body =
      std::make_unique<RigidVehicle>(built.mesh.hexahedra.nodes, built.mesh.hull_nodes, at_rest, portion, launch);
}

/// The surface of a file as it stands at the start. Vertices share the mass by the areas around them: contact takes its
/// stiffness from that.
BuiltVehicle build_from_file(const scene::Scene& scene, double density) {
  const scene::Vehicle& v = *scene.vehicle;
  const geometry::Repair repair = v.surface->repair == "none"   ? geometry::Repair::none
                                  : v.surface->repair == "safe" ? geometry::Repair::safe
                                                                : geometry::Repair::wrap;
  geometry::ImportedHull hull = geometry::import_hull(
      v.surface->file, {v.surface->unit, v.surface->nose, repair, v.surface->wrap_alpha, v.surface->wrap_offset});
  geometry::split_long_edges(hull.outer, edges_per_element * scene.resolution.vehicle_element);
  const Launch launch = launch_of(scene);
  const auto into_place = [&](const geometry::Point& p) {
    std::array<double, 3> place{p[0], p[1], p[2] + v.nose_position};
    launch.place(place);
    return Eigen::Vector3d(place[0], place[1], place[2]);
  };

  BuiltVehicle built;
  built.nominal_density = density;
  built.density = v.mass > 0 ? v.mass / hull.solid.volume : density;
  built.quality.volume = hull.solid.volume;
  built.mass_note = hull.note + in_words(" Volume %.9g m^3.", hull.solid.volume) +
                    (v.mass > 0 ? in_words(" Its density is %.6g kg/m^3 to meet the requested mass.", built.density)
                                : std::string(" Its density is that of the material."));
  geometry::VehicleMesh& mesh = built.mesh;
  for (std::size_t i = 0; i < hull.outer.points.size(); ++i) {
    const Eigen::Vector3d p = into_place(hull.outer.points[i]);
    mesh.hexahedra.nodes.insert(mesh.hexahedra.nodes.end(), p.begin(), p.end());
    mesh.hull_nodes.push_back(static_cast<std::int32_t>(i));
  }
  for (const geometry::Triangle& t : hull.outer.triangles)
    for (const std::size_t corner : t) mesh.hull_triangles.push_back(static_cast<std::int32_t>(corner));
  mesh.triangle_regions.assign(hull.outer.triangles.size(), geometry::HullRegion::cylinder);

  RigidMotion at_rest;
  at_rest.mass = built.density * hull.solid.volume;
  at_rest.centre = into_place(hull.solid.centre);
  Eigen::Matrix3d upright;
  for (int c = 0; c < 3; ++c)
    for (int d = 0; d < 3; ++d) upright(c, d) = built.density * hull.solid.inertia[c][d];
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(v.angle, Eigen::Vector3d::UnitY()).toRotationMatrix();
  at_rest.inertia = turn * upright * turn.transpose();
  built.node_masses = shares_of_area(mesh, at_rest.mass);
  make_rigid(built, scene, at_rest, geometry::Portion::full);
  return built;
}

}  // namespace

BuiltVehicle build_vehicle(const scene::Scene& scene) {
  if (!scene.vehicle) throw std::invalid_argument("the scene has no [vehicle]");
  const scene::Vehicle& v = *scene.vehicle;
  continuum::Law material = material_of(scene);
  const double density = continuum::density(material);
  if (v.surface) return build_from_file(scene, density);
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

  const Launch launch = launch_of(scene);
  launch.place(built.mesh.hexahedra.nodes);
  auto deformable = std::make_unique<DeformableVehicle>(built.mesh, material, launch);
  built.node_masses = deformable->solid().masses;
  built.mass = std::accumulate(built.node_masses.begin(), built.node_masses.end(), 0.0);
  built.whole_mass = portions * built.mass;
  const RigidMotion at_rest = body_of_points(built.mesh.hexahedra.nodes, built.node_masses);
  note_mass_properties(built, at_rest);
  if (v.deformable) {
    built.body = std::move(deformable);
  } else {
    make_rigid(built, scene, at_rest, options.portion);
  }
  return built;
}

}  // namespace polynya::structure
