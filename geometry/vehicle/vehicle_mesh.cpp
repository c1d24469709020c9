#include "geometry/vehicle/vehicle_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "geometry/vehicle/mesh_quality.hpp"
#include "geometry/vehicle/quarter_mesh.hpp"

namespace polynya::geometry {
namespace {

/// Elements through the wall, or between hull and core of a solid body.
int choose_layers(const Meridian& outline, const VehicleMeshOptions& options) {
  if (options.layers > 0) return options.layers;
  const double relative_size = options.element_size / (2 * outline.radius());
  if (options.wall_thickness > 0) {
    // A thin wall sets the stable step, so a second layer is spent only where the rest of the mesh is fine as well.
    return relative_size >= 0.15 ? 1 : relative_size >= 0.05 ? 2 : 3;
  }
  return std::max(1, static_cast<int>(std::lround(0.4 / (2 * relative_size))));
}

QuarterMesh make_quarter(const Meridian& outline, const VehicleMeshOptions& options, int layers) {
  if (!(options.element_size > 0)) throw std::invalid_argument("vehicle: the element size must be positive");
  return options.wall_thickness > 0 ? make_hollow_quarter(outline, options.wall_thickness, options.element_size, layers)
                                    : make_solid_quarter(outline, options.element_size, layers);
}

continuum::HexMesh to_hexahedra(const QuarterMesh& mesh, double nose_position) {
  continuum::HexMesh hexahedra;
  hexahedra.nodes.reserve(3 * mesh.nodes.size());
  for (const auto& [x, y, depth] : mesh.nodes) {
    hexahedra.nodes.push_back(x);
    hexahedra.nodes.push_back(y);
    hexahedra.nodes.push_back(nose_position - depth);
  }
  hexahedra.elements.reserve(8 * mesh.elements.size());
  for (const auto& element : mesh.elements)
    hexahedra.elements.insert(hexahedra.elements.end(), element.begin(), element.end());
  return hexahedra;
}

std::vector<std::uint8_t> flag_nodes(const QuarterMesh& mesh, const Meridian& outline, Portion portion) {
  std::vector<std::uint8_t> flags(mesh.nodes.size(), 0);
  const double shoulder = outline.head_length() * (1 + 1e-12);
  for (std::size_t i = 0; i < flags.size(); ++i) {
    const auto& [x, y, depth] = mesh.nodes[i];
    if (depth <= shoulder) flags[i] |= in_head;
    if (portion == Portion::quarter && x == 0) flags[i] |= on_plane_x;
    if (portion != Portion::full && y == 0) flags[i] |= on_plane_y;
  }
  for (const auto& quad : mesh.hull)
    for (const std::int32_t node : quad) flags[node] |= on_hull;
  return flags;
}

void set_hull(VehicleMesh& vehicle, const QuarterMesh& mesh) {
  std::vector<std::int32_t> vertex(mesh.nodes.size(), -1);
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    if (!(vehicle.node_flags[i] & on_hull)) continue;
    vertex[i] = static_cast<std::int32_t>(vehicle.hull_nodes.size());
    vehicle.hull_nodes.push_back(static_cast<std::int32_t>(i));
  }
  for (std::size_t q = 0; q < mesh.hull.size(); ++q) {
    const auto& quad = mesh.hull[q];
    for (const int corner : {0, 1, 2, 0, 2, 3}) vehicle.hull_triangles.push_back(vertex[quad[corner]]);
    vehicle.triangle_regions.insert(vehicle.triangle_regions.end(), 2, mesh.regions[q]);
  }
}

}  // namespace

int portions_in_whole(Portion portion) {
  return portion == Portion::quarter ? 4 : portion == Portion::half ? 2 : 1;
}

VehicleMesh make_vehicle_mesh(const Meridian& outline, const VehicleMeshOptions& options) {
  VehicleMesh vehicle;
  vehicle.wall_thickness = options.wall_thickness;
  vehicle.layers = choose_layers(outline, options);
  QuarterMesh mesh = make_quarter(outline, options, vehicle.layers);
  if (options.portion != Portion::quarter) mirror(mesh, 0);
  if (options.portion == Portion::full) mirror(mesh, 1);
  sort_along_axis(mesh, options.element_size);
  vehicle.hexahedra = to_hexahedra(mesh, options.nose_position);
  vehicle.node_flags = flag_nodes(mesh, outline, options.portion);
  set_hull(vehicle, mesh);
  return vehicle;
}

double wall_thickness_for_volume(const Meridian& outline, VehicleMeshOptions options, double volume) {
  const double scale = portions_in_whole(options.portion) / 4.0;
  const double wanted = volume * scale;
  // The number of layers does not depend on the thickness that is sought.
  options.wall_thickness = 1;
  const int layers = choose_layers(outline, options);
  const auto excess = [&](double thickness) {
    options.wall_thickness = thickness;
    return mesh_volume(to_hexahedra(make_quarter(outline, options, layers), 0)) - wanted;
  };
  double low = 1e-3 * outline.radius();
  double high = 0.9 * std::min(outline.radius(), outline.least_curvature_radius());
  double excess_low = excess(low), excess_high = excess(high);
  if (excess_low > 0 || excess_high < 0) {
    throw std::invalid_argument("vehicle: no wall between " + std::to_string(low * 1e3) + " and " +
                                std::to_string(high * 1e3) +
                                " mm gives the wanted mass; change mass, material or interior");
  }
  // Illinois variant of the false position: keeps the bracket and converges faster than linearly.
  double thickness = low;
  for (int i = 0, side = 0; i < 100 && high - low > 0; ++i) {
    const double next = (low * excess_high - high * excess_low) / (excess_high - excess_low);
    if (next == thickness) break;
    thickness = next;
    const double value = excess(thickness);
    if (std::abs(value) <= 2e-15 * wanted) break;
    if (value > 0) {
      high = thickness;
      excess_high = value;
      if (side == 1) excess_low *= 0.5;
      side = 1;
    } else {
      low = thickness;
      excess_low = value;
      if (side == -1) excess_high *= 0.5;
      side = -1;
    }
  }
  return thickness;
}

}  // namespace polynya::geometry
