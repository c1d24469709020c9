// The second half of a step: velocities from forces, and the books of energy and momentum.
#include <algorithm>
#include <array>
#include <vector>

#include "core/compute/parallel.hpp"
#include "ice_solver/ice_body.hpp"

namespace polynya::ice {
namespace {

using compute::ordered_sum;

double product(std::span<const double> a, std::span<const double> b) {
  if (a.empty() || b.empty()) return 0;
  return ordered_sum(a.size(), 4096, [&](std::size_t k) { return a[k] * b[k]; });
}

/// Work of the weight per second: - g sum m v_z.
double gravity_power(const std::vector<double>& mass, const std::vector<double>& velocity, double gravity) {
  if (gravity == 0) return 0;
  return -gravity * ordered_sum(mass.size(), 4096, [&](std::size_t i) { return mass[i] * velocity[3 * i + 2]; });
}

struct Powers {
  double node_pair, viscous, node_gravity, particle_gravity, particle_load, set_load;
};

/// Powers of the forces at t(n+1) with the present velocities.
Powers powers(const IceBody& ice, std::span<const double> set_forces, std::span<const double> particle_loads) {
  const Points& points = ice.particles.points;
  Powers p{};  // nothing to sum before there are particles or weight
  if (points.count() > 0 && ice.options.debris == Debris::particles) {
    p.node_pair = product(ice.pair_force, ice.solid.velocities);
    p.viscous = -product(points.viscous_force, points.velocity) -
                product(ice.background.points.viscous_force, ice.background.points.velocity);
  }
  p.node_gravity = gravity_power(ice.solid.masses, ice.solid.velocities, ice.options.gravity);
  p.particle_gravity = gravity_power(points.mass, points.velocity, ice.options.gravity);
  p.particle_load = product(particle_loads, points.velocity);
  p.set_load = product(set_forces, ice.solid.velocities);
  return p;
}

void collect_nodal_force(IceBody& ice, std::span<const double> set_forces, std::span<const double> node_loads) {
  std::vector<double>& force = ice.nodal_force;
  compute::for_chunks(ice.solid.node_count(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      for (std::size_t k = 3 * n; k < 3 * n + 3; ++k)
        force[k] = ice.pair_force[k] + (node_loads.empty() ? 0.0 : node_loads[k]) +
                   (set_forces.empty() ? 0.0 : set_forces[k]);
      force[3 * n + 2] -= ice.solid.masses[n] * ice.options.gravity;
    }
  });
}

void advance_particles(IceBody& ice, std::span<const double> loads, double dt_previous, double dt_next) {
  Particles& p = ice.particles;
  const double dt = 0.5 * (dt_previous + dt_next);
  compute::for_chunks(p.count(), 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t k = 3 * i + c;
        const double force = p.points.force[k] + (loads.empty() ? 0.0 : loads[k]);
        p.acceleration[k] = force / p.points.mass[i] - (c == 2 ? ice.options.gravity : 0.0);
        p.points.velocity[k] += dt * p.acceleration[k];
      }
  });
  // Kinetic energy at t(n) as in continuum::EnergyAccount: the product of the half-step velocities, re-read when the
  // step changes.
  double kinetic = 0, half_square = 0;
  for (std::size_t k = 0; k < p.acceleration.size(); ++k) {
    const double a = p.acceleration[k], m = p.points.mass[k / 3], v = p.points.velocity[k] - 0.5 * dt_next * a;
    kinetic += 0.5 * m * v * v;
    half_square += 0.125 * m * a * a;
  }
  ice.books.particle_kinetic = kinetic - half_square * dt_previous * dt_previous;
  ice.books.particle_step_change.add(0, half_square * (dt_previous * dt_previous - dt_next * dt_next));
}

/// Per component, N and N s.
struct MomentumBalance {
  std::array<double, 3> boundary{};  ///< what planes, held and damped nodes push with
  std::array<double, 3> momentum{};  ///< with the velocities after the step
  void add(const MomentumBalance& other) {
    for (std::size_t c = 0; c < 3; ++c) {
      boundary[c] += other.boundary[c];
      momentum[c] += other.momentum[c];
    }
  }
};

/// A free node feels the damped boundary through its internal force, whose sum would else be zero; a held one, or one
/// that sleeps, has its other forces taken by what holds it. Pair forces are internal, but for those of mirror images.
void add_node(const IceBody& ice, std::size_t n, MomentumBalance& sum) {
  const auto& solid = ice.solid;
  const double mass = solid.masses[n];
  for (std::size_t c = 0; c < 3; ++c) {
    const std::size_t k = 3 * n + c;
    const bool is_free = mass > 0 && !solid.sleeping.node_sleeps(n) && (solid.fixed[n] >> c & 1) == 0;
    sum.boundary[c] += ice.pair_force[k] + (is_free ? solid.internal_force[k] : -ice.nodal_force[k]);
    sum.momentum[c] += mass * solid.velocities[k];
  }
}

void add_particle(const Particles& p, std::size_t i, MomentumBalance& sum) {
  for (std::size_t c = 0; c < 3; ++c) {
    const std::size_t k = 3 * i + c;
    sum.boundary[c] += p.points.force[k];
    sum.momentum[c] += p.points.mass[i] * p.points.velocity[k];
  }
}

MomentumBalance momentum_balance(const IceBody& ice) {
  constexpr std::size_t chunk = 2048;
  const std::size_t nodes = ice.solid.node_count();
  std::vector<MomentumBalance> partial((nodes + chunk - 1) / chunk);
  compute::for_chunks(nodes, chunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) add_node(ice, n, partial[begin / chunk]);
  });
  MomentumBalance total;
  for (std::size_t i = 0; i < ice.particles.count(); ++i) add_particle(ice.particles, i, total);
  for (const MomentumBalance& part : partial) total.add(part);
  return total;
}

/// Of the velocities at t(n+1/2), which hold the impulse of every force so far: momentum and impulses balance to
/// rounding.
void book_momentum(IceBody& ice, std::span<const double> set_forces, double dt_previous, double dt_next) {
  const MomentumBalance balance = momentum_balance(ice);
  const double acting_time = 0.5 * (dt_previous + dt_next);
  for (std::size_t c = 0; c < 3; ++c) {
    ice.books.boundary_impulse[c] += acting_time * balance.boundary[c];
    ice.books.momentum[c] = balance.momentum[c];
  }
  for (std::size_t k = 0; k < set_forces.size(); ++k) ice.books.boundary_impulse[k % 3] += acting_time * set_forces[k];
  if (ice.options.gravity == 0) return;
  const auto sum = [](const std::vector<double>& mass) {
    return ordered_sum(mass.size(), 4096, [&](std::size_t i) { return mass[i]; });
  };
  const double weight = -ice.options.gravity * (sum(ice.solid.masses) + sum(ice.particles.points.mass));
  ice.books.gravity_impulse += acting_time * weight;
}

}  // namespace

void advance_velocities(IceBody& ice, std::span<const double> node_loads, std::span<const double> particle_loads,
                        double dt_previous, double dt_next) {
  const auto lap = ice.watch.lap("velocities");
  const std::span<const double> set_forces = ice.set_loads.at(ice.solid);
  collect_nodal_force(ice, set_forces, node_loads);
  if (dt_previous == 0) continuum::let_sleep(ice.solid, ice.nodal_force, dt_next);
  const Powers closing = powers(ice, set_forces, particle_loads);
  continuum::advance_velocities(ice.solid, ice.nodal_force, dt_previous, dt_next);
  advance_particles(ice, particle_loads, dt_previous, dt_next);
  if (ice.particles.count() > 0 && ice.options.debris == Debris::particles)
    refresh_background(ice.background, ice.solid);  // its velocities
  const Powers opening = powers(ice, set_forces, particle_loads);
  const auto book = [&](Trapezoid& account, double Powers::*which) {
    account.add(0.5 * dt_previous * closing.*which, 0.5 * dt_next * opening.*which);
  };
  book(ice.books.node_pair_work, &Powers::node_pair);
  book(ice.books.particle_heat, &Powers::viscous);
  book(ice.books.node_gravity_work, &Powers::node_gravity);
  book(ice.books.particle_gravity_work, &Powers::particle_gravity);
  book(ice.books.particle_load_work, &Powers::particle_load);
  book(ice.books.set_load_work, &Powers::set_load);
  book_momentum(ice, set_forces, dt_previous, dt_next);
  ice.books.removed_since_step = 0;
}

}  // namespace polynya::ice
