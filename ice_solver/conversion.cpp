// Elements that become particles: one particle at the centre of each.
#include <algorithm>
#include <cmath>

#include "core/compute/pack.hpp"
#include "ice_solver/ice_body.hpp"

namespace polynya::ice {
namespace {

using Vector = std::array<double, 3>;

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Angular momentum of an element's eighths about its centre, which one particle cannot carry.
Vector angular_momentum_about_centre(const continuum::ExplicitSolid& solid, std::size_t e, const Vector& centre) {
  Vector sum{};
  for (std::size_t a = 0; a < 8; ++a) {
    const std::size_t n = 3 * static_cast<std::size_t>(solid.mesh.elements[8 * e + a]);
    Vector arm, velocity;
    for (std::size_t c = 0; c < 3; ++c) {
      arm[c] = solid.positions[n + c] - centre[c];
      velocity[c] = solid.velocities[n + c];
    }
    const Vector moment = cross(arm, velocity);
    for (std::size_t c = 0; c < 3; ++c) sum[c] += solid.element.mass[e] / 8 * moment[c];
  }
  return sum;
}

void convert(IceBody& ice, std::size_t e) {
  auto& solid = ice.solid;
  ParticleBirth birth;
  birth.element = static_cast<std::int64_t>(e);
  birth.position = continuum::element_centre(solid, e);
  birth.velocity_gradient = continuum::velocity_gradient(solid, e);
  birth.state = continuum::point_state(solid, e);
  birth.smoothing_length = smoothing_length_of(solid.element.volume[e]);
  birth.origin = reference_centre(solid, e);
  birth.bond_reach = smoothing_length_of(solid.element.reference_volume[e]);
  const Vector spin = angular_momentum_about_centre(solid, e, birth.position);

  const continuum::RemovedElement removed = continuum::remove_element(solid, e);
  birth.mass = removed.mass;
  double square = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    birth.velocity[c] = removed.momentum[c] / removed.mass;
    square += birth.velocity[c] * birth.velocity[c];
    ice.books.angular_momentum_defect[c] += spin[c];
  }
  ice.books.removed_since_step += removed.kinetic_energy;
  ice.books.broken_mass += birth.mass;
  if (ice.options.debris == Debris::none) {
    ice.books.lost_kinetic += removed.kinetic_energy;
    ice.books.lost_mass += birth.mass;
    // Its momentum leaves as if through the boundary, so that the balance of momentum holds.
    for (std::size_t c = 0; c < 3; ++c) ice.books.boundary_impulse[c] -= removed.momentum[c];
    return;
  }
  const double kinetic = 0.5 * birth.mass * square;
  ice.books.conversion_heat += removed.kinetic_energy - kinetic;
  ice.books.particle_kinetic += kinetic;
  if (ice.options.debris == Debris::free_masses) birth.state.stress = {};
  add_particle(ice.particles, solid.law, birth);
}

std::vector<std::int32_t> collapsed_elements(const IceBody& ice) {
  std::vector<std::int32_t> list;
  const auto& element = ice.solid.element;
  const std::size_t chunk_elements = ice.solid.chunks.packs_per_chunk * compute::pack_width;
  for (std::size_t c = 0; c < ice.solid.chunks.chunk_count(); ++c) {
    if (ice.solid.sleeping.chunk_sleeps(c)) continue;
    for (std::size_t e = c * chunk_elements; e < std::min(ice.first_step.size(), (c + 1) * chunk_elements); ++e)
      if (element.alive[e] != 0 && element.step_limit[e] < ice.options.collapsed_step * ice.first_step[e])
        list.push_back(static_cast<std::int32_t>(e));
  }
  return list;
}

}  // namespace

void convert_elements(IceBody& ice, std::span<const std::int32_t> elements) {
  for (const std::int32_t e : elements) convert(ice, static_cast<std::size_t>(e));
  if (elements.empty()) return;
  ice.list_is_stale = true;
  ice.own_contact.stale = true;
  ice.topology_changed = true;
}

std::size_t convert_failed_elements(IceBody& ice) {
  const auto lap = ice.watch.lap("conversion");
  ice.topology_changed = false;
  if (!ice.options.conversion) return 0;
  const auto strained = continuum::elements_above_strain(ice.solid, ice.options.critical_strain);
  convert_elements(ice, strained);
  ice.books.converted.strained += static_cast<std::int64_t>(strained.size());
  const auto collapsed = collapsed_elements(ice);
  convert_elements(ice, collapsed);
  ice.books.converted.collapsed += static_cast<std::int64_t>(collapsed.size());
  return strained.size() + collapsed.size();
}

}  // namespace polynya::ice
