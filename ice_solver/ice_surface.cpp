#include "ice_solver/ice_surface.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace polynya::ice {

IceSurface surface_of(const IceBody& ice) {
  const auto& solid = ice.solid;
  const auto planes = excluded_planes(ice.options.planes);
  const std::span<const double> alive(solid.element.alive.data(), solid.element_count());
  auto boundary = continuum::boundary_surface(solid.mesh, ice.face_neighbours, alive, planes);
  IceSurface surface;
  surface.nodes = std::move(boundary.nodes);
  surface.triangles = std::move(boundary.triangles);
  surface.elements = std::move(boundary.elements);
  for (const std::int32_t node : surface.nodes) {
    surface.ids.push_back(node);
    surface.masses.push_back(solid.masses[static_cast<std::size_t>(node)]);
  }
  surface.radii.assign(surface.nodes.size(), 0.0);
  surface.volumes.assign(surface.nodes.size(), 0.0);
  const Particles& particles = ice.particles;
  const double density = continuum::density(solid.law);
  for (std::size_t i = 0; i < particles.count(); ++i) {
    // Its volume at rest: what is left when the density of scattered debris has fallen is not ice but the space
    // between.
    const double volume = particles.points.mass[i] / density;
    surface.ids.push_back(static_cast<std::int64_t>(solid.node_count()) + particles.element[i]);
    surface.masses.push_back(particles.points.mass[i]);
    surface.radii.push_back(0.5 * std::cbrt(volume));
    surface.volumes.push_back(volume);
  }
  return surface;
}

void vertex_motion(const IceBody& ice, std::span<const std::int32_t> nodes, std::vector<double>& positions,
                   std::vector<double>& velocities) {
  positions.resize(3 * (nodes.size() + ice.particles.count()));
  velocities.resize(positions.size());
  std::size_t to = 0;
  for (const std::int32_t node : nodes)
    for (std::size_t c = 0; c < 3; ++c, ++to) {
      const std::size_t from = 3 * static_cast<std::size_t>(node) + c;
      positions[to] = ice.solid.positions[from];
      velocities[to] = ice.solid.velocities[from];
    }
  const Points& points = ice.particles.points;
  std::copy(points.position.begin(), points.position.end(), positions.begin() + static_cast<std::ptrdiff_t>(to));
  std::copy(points.velocity.begin(), points.velocity.end(), velocities.begin() + static_cast<std::ptrdiff_t>(to));
}

void distribute_loads(const IceBody& ice, const IceSurface& surface, std::span<const std::int64_t> vertices,
                      std::span<const double> forces, std::vector<double>& node_loads,
                      std::vector<double>& particle_loads) {
  node_loads.resize(3 * ice.solid.node_count(), 0.0);
  particle_loads.assign(3 * ice.particles.count(), 0.0);
  const auto node_vertices = static_cast<std::int64_t>(surface.nodes.size());
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    const std::int64_t v = vertices[k];
    if (v < 0 || v >= static_cast<std::int64_t>(surface.vertex_count()))
      throw std::invalid_argument("a load acts on vertex " + std::to_string(v) + ", the surface of the ice has " +
                                  std::to_string(surface.vertex_count()));
    double* load = v < node_vertices
                       ? &node_loads[3 * static_cast<std::size_t>(surface.nodes[static_cast<std::size_t>(v)])]
                       : &particle_loads[3 * static_cast<std::size_t>(v - node_vertices)];
    for (std::size_t c = 0; c < 3; ++c) load[c] += forces[3 * k + c];
  }
}

void take_back_loads(const IceSurface& surface, std::span<const std::int64_t> vertices,
                     std::vector<double>& node_loads) {
  for (const std::int64_t v : vertices)
    if (v < static_cast<std::int64_t>(surface.nodes.size()))
      std::fill_n(&node_loads[3 * static_cast<std::size_t>(surface.nodes[static_cast<std::size_t>(v)])], 3, 0.0);
}

}  // namespace polynya::ice
