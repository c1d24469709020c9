#pragma once
#include <cstdint>
#include <vector>

#include "core/continuum/law.hpp"
#include "ice_solver/points.hpp"

namespace polynya::ice {

/// Particles in the order of their birth: what the sums need, and what the law remembers.
struct Particles {
  Points points;
  std::vector<std::int64_t> element;      ///< [n], the element it was
  std::vector<double> relative_volume;    ///< [n], rho0 / rho
  std::vector<double> damage;             ///< [n], 0..1
  std::vector<double> plastic_strain;     ///< [n]
  std::vector<double> bulking_pressure;   ///< [n], Pa
  std::vector<double> stress_work;        ///< [n], J, work of its stress since its birth
  std::vector<double> velocity_gradient;  ///< [n][9], 1/s
  std::vector<double> approach_speed;     ///< [n], m/s, of the neighbour that approaches fastest
  std::vector<double> acceleration;       ///< [n][3], m/s^2
  std::size_t settled = 0;                ///< particles from here on were born in this step
  std::size_t steps_at_bound = 0;         ///< how often a particle's density was kept at its lower bound

  std::size_t count() const { return points.count(); }

  POLYNYA_STATE(points, element, relative_volume, damage, plastic_strain, bulking_pressure, stress_work,
                velocity_gradient, approach_speed, acceleration, settled, steps_at_bound)
};

/// What a particle starts with: the state of its element.
struct ParticleBirth {
  std::int64_t element = 0;
  double mass = 0, smoothing_length = 0, bond_reach = 0;
  std::array<double, 3> position{}, velocity{}, origin{};
  continuum::Tensor<double> velocity_gradient{};
  continuum::PointState<double> state;
};

void add_particle(Particles& particles, const continuum::Law& law, const ParticleBirth& birth);

/// Stress, damage, density and stress work over one step of dt from the velocity gradients, by the law of the elements.
/// The work is the mean of the powers of the old and the new stress. A particle far from all others keeps a hundredth
/// of its density at least; every step in which one does counts in steps_at_bound.
void update_particle_stress(Particles& particles, const continuum::Law& law, double dt);

/// 0.3 h / (c + approach speed), the least of all particles; 1e300 if there is none. Loose rubble (fully damaged and
/// expanded) counts with the wave speed that it has when it closes.
double particle_stable_step(const Particles& particles, const continuum::Law& law);

}  // namespace polynya::ice
