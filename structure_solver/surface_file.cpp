#include "structure_solver/surface_file.hpp"

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace polynya::structure {
namespace {

template <class T>
nlohmann::json rows_of_three(const std::vector<T>& values) {
  nlohmann::json rows = nlohmann::json::array();
  for (std::size_t i = 0; i + 2 < values.size(); i += 3) rows.push_back({values[i], values[i + 1], values[i + 2]});
  return rows;
}

}  // namespace

void write_surface(const std::string& path, const BuiltVehicle& vehicle) {
  std::vector<double> positions, masses;
  for (const std::int32_t node : vehicle.mesh.hull_nodes) {
    masses.push_back(vehicle.node_masses[node]);
    for (int c = 0; c < 3; ++c) positions.push_back(vehicle.mesh.hexahedra.nodes[3 * node + c]);
  }
  nlohmann::json surface;
  surface["positions"] = rows_of_three(positions);
  surface["ids"] = vehicle.mesh.hull_nodes;
  surface["masses"] = masses;
  surface["triangles"] = rows_of_three(vehicle.mesh.hull_triangles);
  surface["mass"] = vehicle.mass;
  surface["centre_of_mass"] = vehicle.centre;
  surface["inertia"] = vehicle.inertia;
  std::ofstream file(path);
  file << surface.dump() << '\n';
  file.close();
  if (!file) throw std::runtime_error(path + ": cannot be written");
}

}  // namespace polynya::structure
