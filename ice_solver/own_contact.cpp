#include "ice_solver/own_contact.hpp"

#include <algorithm>

#include "ice_solver/ice_body.hpp"
#include "ice_solver/ice_surface.hpp"

namespace polynya::ice {
namespace {

void set_up(IceBody& ice) {
  OwnContact& own = ice.own_contact;
  IceSurface surface = surface_of(ice);
  own.nodes = std::move(surface.nodes);
  own.triangles = std::move(surface.triangles);
  own.ids = std::move(surface.ids);
  own.masses = std::move(surface.masses);
  own.radii = std::move(surface.radii);

  const Points& particles = ice.particles.points;
  own.point_origins.clear();
  for (const std::int32_t n : own.nodes)
    for (std::size_t c = 0; c < 3; ++c)
      own.point_origins.push_back(ice.solid.mesh.nodes[3 * static_cast<std::size_t>(n) + c]);
  own.point_origins.insert(own.point_origins.end(), particles.origin.begin(), particles.origin.end());
  // A node's own elements lie within their smoothing length of it, the other side of a gap does not.
  own.point_reaches.assign(own.nodes.size(), 0.0);
  own.point_reaches.insert(own.point_reaches.end(), particles.bond_reach.begin(), particles.bond_reach.end());
  own.triangle_origins.clear();
  own.triangle_reaches.clear();
  for (const std::int32_t e : surface.elements) {
    const auto element = static_cast<std::size_t>(e);
    const std::array<double, 3> centre = reference_centre(ice.solid, element);
    own.triangle_origins.insert(own.triangle_origins.end(), centre.begin(), centre.end());
    own.triangle_reaches.push_back(smoothing_length_of(ice.solid.element.reference_volume[element]));
  }
}

contact::Body body_of(const OwnContact& own) {
  return {own.positions, own.velocities, own.masses, own.radii, own.ids, own.triangles};
}

}  // namespace

void add_own_contact(IceBody& ice, double dt) {
  OwnContact& own = ice.own_contact;
  if (!own.active || ice.particles.count() == 0 || dt <= 0) return;
  const bool stale = own.stale;
  if (stale) set_up(ice);
  vertex_motion(ice, own.nodes, own.positions, own.velocities);
  if (stale) own.contact.set_topology(body_of(own));
  own.stale = false;
  const contact::Exclusion exclusion{.neighbours = true,
                                     .point_origins = own.point_origins,
                                     .point_reaches = own.point_reaches,
                                     .triangle_origins = own.triangle_origins,
                                     .triangle_reaches = own.triangle_reaches};
  const contact::ContactForces& forces = own.contact.evaluate(body_of(own), exclusion, dt);
  own.stored = forces.stored_energy;
  own.dissipated += forces.friction_loss + forces.damping_loss + forces.released_energy;
  for (std::size_t v = 0; v < own.nodes.size(); ++v)
    for (std::size_t c = 0; c < 3; ++c)
      ice.pair_force[3 * static_cast<std::size_t>(own.nodes[v]) + c] += forces.secondary[3 * v + c];
  std::vector<double>& on_particles = ice.particles.points.force;
  for (std::size_t k = 0; k < on_particles.size(); ++k) on_particles[k] += forces.secondary[3 * own.nodes.size() + k];
}

}  // namespace polynya::ice
