#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "ice_solver/ice_body.hpp"

namespace polynya::ice {

/// What others can touch and wet: nodes of outer faces, then all particles in the order of their birth.
struct IceSurface {
  std::vector<std::int32_t> nodes;      ///< mesh nodes of the first vertices, ascending
  std::vector<std::int64_t> ids;        ///< [v]; a node keeps its number, a particle has nodes + its element's number
  std::vector<std::int32_t> triangles;  ///< [t][3], outward oriented, none on symmetry planes
  std::vector<std::int32_t> elements;   ///< [t], the element a triangle belongs to
  std::vector<double> masses;           ///< [v], kg
  std::vector<double> radii;            ///< [v], m: 0 for nodes, V^(1/3)/2 for particles
  std::vector<double> volumes;          ///< [v], m^3: 0 for nodes
  std::size_t vertex_count() const { return ids.size(); }

  POLYNYA_STATE(nodes, ids, triangles, elements, masses, radii, volumes)
};

/// The surface of the elements that live now and the particles there are.
IceSurface surface_of(const IceBody& ice);

/// Positions and velocities of these nodes, then of all particles, [v][3].
void vertex_motion(const IceBody& ice, std::span<const std::int32_t> nodes, std::vector<double>& positions,
                   std::vector<double>& velocities);

/// Adds loads on vertices to those of the nodes ([nodes][3], zeros so far) and gives them to particles
/// ([particles][3]). Throws std::invalid_argument if a vertex does not exist.
void distribute_loads(const IceBody& ice, const IceSurface& surface, std::span<const std::int64_t> vertices,
                      std::span<const double> forces, std::vector<double>& node_loads,
                      std::vector<double>& particle_loads);

/// Leaves zeros where the loads on these vertices were: most nodes are inside and never have any.
void take_back_loads(const IceSurface& surface, std::span<const std::int64_t> vertices,
                     std::vector<double>& node_loads);

}  // namespace polynya::ice
