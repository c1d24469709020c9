#include "ice_solver/ice_body.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/compute/parallel.hpp"
#include "ice_solver/ball.hpp"
#include "ice_solver/flaws.hpp"

namespace polynya::ice {
namespace {

// Elements outside the background are not watched; at this interval nothing slower than c/75 can enter unseen.
constexpr int longest_list_life = 25;
constexpr double skin_in_smoothing_lengths = 0.2;
constexpr double background_smoothing_limit =
    1.5;  // of the largest particle's: keeps coarse elements from ruling the cells

/// A particle that crosses a symmetry plane meets its mirror image, which enters on this side.
void reflect_at_planes(Points& points, std::span<const std::size_t> axes) {
  for (const std::size_t axis : axes)
    for (std::size_t i = 0; i < points.count(); ++i) {
      if (points.position[3 * i + axis] >= 0) continue;
      points.position[3 * i + axis] *= -1;
      points.velocity[3 * i + axis] *= -1;
      points.stress[6 * i + 3] *= -1;                    // xy
      points.stress[6 * i + (axis == 0 ? 5 : 4)] *= -1;  // zx or yz
    }
}

void renew_list(IceBody& ice) {
  const auto& h = ice.particles.points.smoothing_length;
  const double largest = *std::max_element(h.begin(), h.end());
  const double skin = skin_in_smoothing_lengths * largest;
  const double limit = background_smoothing_limit * largest;
  select_background(ice.background, ice.solid, ice.particles.points, largest + limit + skin, limit);
  ice.list.build(ice.particles.points, ice.background.points, ice.options.planes, skin, ice.own_contact.active);
  ice.list_is_stale = false;
  ice.steps_since_build = 0;
}

continuum::HexMesh mesh_of(const IceOptions& options) {
  if (options.mesh) return *options.mesh;
  if (!options.ball) return plate_mesh(options.x, options.y, options.z);
  const BallOptions& ball = *options.ball;
  return ball_mesh(ball.radius, ball.element, ball.lowest + ball.radius, options.planes);
}

PairViscosity viscosity_of(const IceBody& ice) {
  return {ice.options.viscosity_linear, ice.options.viscosity_quadratic,
          continuum::longitudinal_wave_speed(ice.solid.law)};
}

}  // namespace

IceBody make_ice(const IceOptions& options) {
  IceBody ice;
  ice.options = options;
  ice.solid = continuum::make_solid("ice", mesh_of(options), options.law, options.numerics);
  if (options.flaws > 0) sow_flaws(ice.solid, options.flaws, options.seed);
  hold_supports(ice.solid, options.supports);
  ice.solid.sleeping.threshold = options.sleeping_threshold;
  constrain_plate(ice.solid, options.planes, options.sides);
  release_waves(ice.solid, options.supports);
  if (options.damping > 0) continuum::add_mass_damping(ice.solid, options.damping);
  if (options.held_rim > 0) hold_rim(ice.solid, options.planes, options.held_rim);
  const double velocity = options.ball ? -options.ball->speed : options.velocity;
  for (std::size_t n = 0; n < ice.solid.node_count(); ++n) ice.solid.velocities[3 * n + 2] = velocity;
  // As the account of the start has it, before the first step sums it.
  for (const double mass : ice.solid.masses) {
    ice.solid.kinetic_energy += 0.5 * mass * velocity * velocity;
    ice.books.momentum[2] += mass * velocity;
  }
  ice.face_neighbours = continuum::face_neighbours(ice.solid.mesh);
  ice.set_loads = SetLoads(ice.solid, ice.face_neighbours, options.loads);
  if (options.own_contact) {
    // The size of the smallest elements sets how far candidates are looked for.
    const auto& volume = ice.solid.element.reference_volume;
    const double size = std::cbrt(
        *std::min_element(volume.begin(), volume.begin() + static_cast<std::ptrdiff_t>(ice.solid.element_count())));
    contact::ContactLaw law;
    law.friction = options.contact_friction;
    law.stiffness_factor = options.contact_stiffness_factor;
    law.depth_limit = law.skin = 0.25 * size;
    law.mirror = {options.planes.x, options.planes.y};
    ice.own_contact.active = true;
    ice.own_contact.contact = contact::SelfContact(law);
  }
  continuum::internal_forces(ice.solid, 0);
  ice.first_step.assign(ice.solid.element.step_limit.begin(),
                        ice.solid.element.step_limit.begin() + static_cast<std::ptrdiff_t>(ice.solid.element_count()));
  ice.pair_force.assign(3 * ice.solid.node_count(), 0.0);
  ice.nodal_force.assign(3 * ice.solid.node_count(), 0.0);
  return ice;
}

continuum::EquilibriumReport settle(IceBody& ice, std::span<const double> node_loads) {
  std::vector<double> loads(node_loads.begin(), node_loads.end());
  for (std::size_t n = 0; n < ice.solid.node_count(); ++n)
    loads[3 * n + 2] -= ice.options.gravity * ice.solid.masses[n];
  const auto on_sets = ice.set_loads.at(ice.solid);
  for (std::size_t k = 0; k < on_sets.size(); ++k) loads[k] += on_sets[k];
  return continuum::bring_into_equilibrium(ice.solid, loads, ice.options.equilibrium);
}

void advance_positions(IceBody& ice, double dt) {
  const auto lap = ice.watch.lap("positions");
  continuum::advance_positions(ice.solid, dt);
  Points& points = ice.particles.points;
  compute::for_chunks(points.position.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) points.position[k] += dt * points.velocity[k];
  });
  std::vector<std::size_t> axes;
  if (ice.options.planes.x) axes.push_back(0);
  if (ice.options.planes.y) axes.push_back(1);
  reflect_at_planes(points, axes);
}

void internal_forces(IceBody& ice, double dt) {
  {
    const auto lap = ice.watch.lap("elements");
    continuum::internal_forces(ice.solid, dt);
  }
  const auto lap = ice.watch.lap("particles");
  std::fill(ice.pair_force.begin(), ice.pair_force.end(), 0.0);
  Particles& particles = ice.particles;
  if (particles.count() == 0 || ice.options.debris != Debris::particles) return;

  refresh_background(ice.background, ice.solid);
  ++ice.steps_since_build;
  if (ice.list_is_stale || ice.steps_since_build > longest_list_life ||
      ice.list.outdated(particles.points, ice.background.points))
    renew_list(ice);
  Points& background = ice.background.points;
  ice.sums.velocity_gradients(ice.list, particles.points, background, particles.velocity_gradient,
                              particles.approach_speed);
  update_particle_stress(particles, ice.solid.law, dt);
  ice.sums.forces(ice.list, particles.points, background, viscosity_of(ice));
  spread_background_forces(ice.background, ice.solid, ice.pair_force);
  add_own_contact(ice, dt);
}

double stable_step(const IceBody& ice) {
  if (ice.options.debris != Debris::particles) return continuum::stable_step(ice.solid);
  return std::min(continuum::stable_step(ice.solid), particle_stable_step(ice.particles, ice.solid.law));
}

}  // namespace polynya::ice
