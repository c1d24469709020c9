#pragma once
#include <cstdint>
#include <vector>

#include "core/continuum/hex_mesh.hpp"
#include "geometry/vehicle/hull_net.hpp"
#include "geometry/vehicle/vehicle_profile.hpp"

namespace polynya::geometry {

/// Which part of the body is meshed: x >= 0 and y >= 0, y >= 0, or everything.
enum class Portion { quarter, half, full };

/// How many such portions make the whole body: 4, 2, 1.
int portions_in_whole(Portion portion);

struct VehicleMeshOptions {
  double element_size = 0;  ///< m, along and around the hull
  Portion portion = Portion::full;
  double wall_thickness = 0;  ///< m; 0: solid
  int layers = 0;             ///< elements through the wall; 0: from the element size
  double nose_position = 0;   ///< m, z of the nose; the body extends downwards from there
};

enum NodeFlag : std::uint8_t {
  on_hull = 1,     ///< on the outer surface
  in_head = 2,     ///< at or above the shoulder
  on_plane_x = 4,  ///< on the plane of symmetry x = 0 of this portion
  on_plane_y = 8   ///< on the plane of symmetry y = 0 of this portion
};

/// Hexahedra of a vehicle (nose up, axis = z axis) and the triangles of its outer hull.
struct VehicleMesh {
  continuum::HexMesh hexahedra;          ///< sorted from the nose to the base
  std::vector<std::uint8_t> node_flags;  ///< NodeFlag, per node
  std::vector<std::int32_t> hull_nodes;  ///< mesh node of each hull vertex
  std::vector<std::int32_t>
      hull_triangles;  ///< [t][3] into hull_nodes, outward; none on planes of symmetry or in the cavity
  std::vector<HullRegion> triangle_regions;  ///< per triangle
  double wall_thickness = 0;                 ///< m; 0: solid
  int layers = 0;                            ///< elements through the wall (solid: around the core)
};

/// std::invalid_argument when the options do not describe a body. Solid: layers around a core of square section that
/// ends below the nose; hollow: layers between the hull and its offset, with a closed base.
VehicleMesh make_vehicle_mesh(const Meridian& outline, const VehicleMeshOptions& options);

/// The wall thickness (m) at which the mesh of these options has this volume (m^3, of the portion), to rounding.
/// std::invalid_argument when no wall does.
double wall_thickness_for_volume(const Meridian& outline, VehicleMeshOptions options, double volume);

}  // namespace polynya::geometry
