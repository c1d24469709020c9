#pragma once
#include <array>
#include <memory>
#include <string>

#include "core/scene/scene.hpp"
#include "geometry/hull/triangle_soup.hpp"
#include "geometry/vehicle/mesh_quality.hpp"
#include "geometry/vehicle/vehicle_mesh.hpp"
#include "structure_solver/vehicle_body.hpp"

namespace polynya::structure {

/// A vehicle and what is known about it from the start.
struct BuiltVehicle {
  geometry::VehicleMesh mesh;
  geometry::MeshQuality quality;
  std::vector<double> node_masses;                 ///< kg
  double density = 0;                              ///< kg/m^3 that the mesh carries
  double nominal_density = 0;                      ///< kg/m^3 of the material
  double mass = 0;                                 ///< kg of the modelled part
  double whole_mass = 0;                           ///< kg of the whole body
  geometry::Point centre{};                        ///< m, of mass, at the start
  std::array<std::array<double, 3>, 3> inertia{};  ///< kg m^2, about it, of the modelled part
  std::string mass_note;                           ///< how the mass came about, a whole sentence
  std::unique_ptr<VehicleBody> body;
};

/// Meshes the scene's vehicle and puts it at its start. The whole body's mass is
/// - hollow with a mass: met by the wall thickness, to rounding of the mesh's own volume;
/// - solid with a mass: met by scaling the density (ballast spread through the body);
/// - without a mass: density times the exact volume of the shape. The mesh is inscribed in the shape, so its density is
///   scaled by a few per cent on coarse meshes: the mass does not depend on the resolution.
/// A hull from a file is a rigid body: its surface alone is the mesh, its mass properties are exact.
/// std::invalid_argument: no such vehicle, or a material that is not elastic.
BuiltVehicle build_vehicle(const scene::Scene& scene);

}  // namespace polynya::structure
