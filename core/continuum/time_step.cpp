#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "core/compute/pack.hpp"
#include "core/compute/parallel.hpp"
#include "core/continuum/boundary_traction.hpp"
#include "core/continuum/explicit_solid.hpp"
#include "core/continuum/exposure.hpp"

namespace polynya::continuum {
namespace {

constexpr std::size_t chunk = 4096;

/// What a step does to the energy account, J.
struct Work {
  double kinetic = 0, completed = 0, begun = 0, step_change = 0;
};

/// One velocity component of a node with mass. `before` and `after`: the steps behind and ahead.
void advance_component(double mass, double internal, double external, bool fixed, double before, double after,
                       double& velocity, Work& work) {
  const double old = velocity;
  const double a = fixed ? 0.0 : (internal + external) / mass;
  velocity = old + 0.5 * (before + after) * a;
  // A held component is moved by a reaction equal and opposite to all the rest.
  const double outer = fixed ? -internal : external;
  const double middle = old + 0.5 * before * a;
  work.kinetic += 0.5 * mass * (middle * middle - 0.25 * before * before * a * a);
  work.step_change += 0.125 * mass * (before * before - after * after) * a * a;
  work.completed += 0.5 * before * outer * old;
  work.begun += 0.5 * after * outer * velocity;
}

Work advance_nodes(ExplicitSolid& solid, std::span<const double> external, double before, double after) {
  std::vector<Work> partial((solid.node_count() + chunk - 1) / chunk);
  compute::for_chunks(solid.node_count(), chunk, [&](std::size_t begin, std::size_t end) {
    Work work;
    for (std::size_t n = begin; n < end; ++n) {
      if (!(solid.masses[n] > 0)) continue;
      for (std::size_t i = 0; i < 3; ++i)
        advance_component(solid.masses[n], solid.internal_force[3 * n + i], external[3 * n + i],
                          (solid.fixed[n] >> i & 1) != 0, before, after, solid.velocities[3 * n + i], work);
    }
    partial[begin / chunk] = work;
  });
  Work total;
  for (const Work& work : partial) {
    total.kinetic += work.kinetic;
    total.completed += work.completed;
    total.begun += work.begun;
    total.step_change += work.step_change;
  }
  return total;
}

}  // namespace

void advance_positions(ExplicitSolid& solid, double dt) {
  compute::for_chunks(solid.positions.size(), 2 * chunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) solid.positions[i] += dt * solid.velocities[i];
  });
  solid.time += dt;
}

void advance_velocities(ExplicitSolid& solid, std::span<const double> external_force, double dt_previous,
                        double dt_next) {
  if (external_force.size() != solid.positions.size())
    throw std::invalid_argument(solid.name + ": external forces must be [" + std::to_string(solid.node_count()) +
                                "][3]");
  solid.external_work += solid.pending_external_work;
  solid.boundary_flux += solid.pending_boundary_flux;
  solid.pending_external_work = solid.pending_boundary_flux = 0;
  solid.step_change += solid.pending_step_change;
  add_boundary_traction(solid, external_force, dt_previous, dt_next);
  const Work work = advance_nodes(solid, external_force, dt_previous, dt_next);
  solid.kinetic_energy = work.kinetic;
  solid.external_work += work.completed;
  solid.pending_external_work += work.begun;
  solid.pending_step_change = work.step_change;
}

double stable_step(const ExplicitSolid& solid) {
  return compute::ordered_minimum(solid.element_count(), 8 * chunk, 1e300,
                                  [&](std::size_t e) { return solid.element.step_limit[e]; });
}

EnergyAccount energies(const ExplicitSolid& solid) {
  const auto sum = [&](const std::vector<double>& energy) {
    return compute::ordered_sum(solid.element_count(), chunk, [&](std::size_t e) { return energy[e]; });
  };
  EnergyAccount account;
  account.kinetic = solid.kinetic_energy;
  account.internal = sum(solid.element.internal_energy);
  account.hourglass = sum(solid.element.hourglass_energy);
  account.viscous = sum(solid.element.viscous_energy);
  account.external_work = solid.external_work;
  account.boundary_flux = solid.boundary_flux;
  account.removed = solid.removed_energy;
  account.step_change = solid.step_change;
  return account;
}

void update_exposure(ExplicitSolid& solid, std::size_t element) {
  // By the largest number of living elements around one of the nodes. Measured: the highest eigenvalue of 2,500 random
  // sets of cubes (up to 5^3, filled 5 to 100 %, Poisson's ratio 0.2 to 0.45) never exceeds what this gives.
  constexpr double by_company[] = {1, 1, 1, 0.85, 0.75, 0.65, 0.5, 0.35, 0.25};
  int company = 0;
  for (std::size_t a = 0; a < 8; ++a)
    company = std::max<int>(company, solid.living_elements[solid.mesh.elements[8 * element + a]]);
  solid.exposure[element] = by_company[std::min(company, 8)];
}

RemovedElement remove_element(ExplicitSolid& solid, std::size_t element) {
  if (element >= solid.element_count() || solid.element.alive[element] == 0)
    throw std::invalid_argument(solid.name + ": element " + std::to_string(element) + " is not there to be removed");
  RemovedElement removed;
  solid.element.alive[element] = 0;
  solid.element.step_limit[element] = 1e300;
  const std::int32_t* nodes = &solid.mesh.elements[8 * element];
  for (std::size_t a = 0; a < 8; ++a) {
    const auto n = static_cast<std::size_t>(nodes[a]);
    const bool last = --solid.living_elements[n] == 0;
    const double mass = last ? solid.masses[n] : 0.125 * solid.element.mass[element];
    solid.masses[n] -= mass;
    removed.mass += mass;
    for (std::size_t i = 0; i < 3; ++i) {
      const double v = solid.velocities[3 * n + i];
      removed.momentum[i] += mass * v;
      removed.kinetic_energy += 0.5 * mass * v * v;
    }
  }
  constexpr std::int32_t w = compute::pack_width;
  for (std::size_t a = 0; a < 8; ++a)
    for (std::int32_t k = solid.gather_start[nodes[a]]; k < solid.gather_start[nodes[a] + 1]; ++k) {
      const std::int32_t slot = solid.gather_slot[k];
      update_exposure(solid, static_cast<std::size_t>(slot / (24 * w) * w + slot % w));
    }
  solid.removed_energy += removed.kinetic_energy;
  return removed;
}

}  // namespace polynya::continuum
