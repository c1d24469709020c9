#include "ice_solver/particles.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/compute/pack.hpp"
#include "core/compute/parallel.hpp"

namespace polynya::ice {
namespace {

using compute::Pack;
using compute::pack_width;
using continuum::PointState;
using continuum::Tensor;

constexpr double largest_relative_volume = 100;
constexpr std::size_t chunk = 32 * pack_width;

/// Lane k is values[stride * (first + k) + column]; lanes beyond the end repeat the last point.
struct Lanes {
  std::size_t first, last;
  Pack load(const std::vector<double>& values, std::size_t stride = 1, std::size_t column = 0) const {
    return Pack([&](auto k) { return values[stride * std::min(first + k, last) + column]; });
  }
  void store(std::vector<double>& values, const Pack& pack, std::size_t stride = 1, std::size_t column = 0) const {
    for (std::size_t k = 0; k < pack_width && first + k <= last; ++k) values[stride * (first + k) + column] = pack[k];
  }
};

PointState<Pack> load_state(const Particles& p, const Lanes& lanes) {
  PointState<Pack> state;
  for (std::size_t c = 0; c < 6; ++c) state.stress[c] = lanes.load(p.points.stress, 6, c);
  state.relative_volume = lanes.load(p.relative_volume);
  state.damage = lanes.load(p.damage);
  state.plastic_strain = lanes.load(p.plastic_strain);
  state.bulking_pressure = lanes.load(p.bulking_pressure);
  return state;
}

void store_state(Particles& p, const Lanes& lanes, const PointState<Pack>& state, double reference_density) {
  for (std::size_t c = 0; c < 6; ++c) lanes.store(p.points.stress, state.stress[c], 6, c);
  lanes.store(p.relative_volume, state.relative_volume);
  lanes.store(p.points.density, reference_density / state.relative_volume);
  lanes.store(p.damage, state.damage);
  lanes.store(p.plastic_strain, state.plastic_strain);
  lanes.store(p.bulking_pressure, state.bulking_pressure);
}

/// sigma : L times V / V0
Pack stress_power(const PointState<Pack>& state, const Tensor<Pack>& l) {
  const auto& s = state.stress;
  return state.relative_volume *
         (s[0] * l[0] + s[1] * l[4] + s[2] * l[8] + s[3] * (l[1] + l[3]) + s[4] * (l[5] + l[7]) + s[5] * (l[2] + l[6]));
}

template <class L>
void update(Particles& p, const L& law, double dt) {
  compute::for_chunks(p.count(), chunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; i += pack_width) {
      const Lanes lanes{i, end - 1};
      PointState<Pack> state = load_state(p, lanes);
      Tensor<Pack> gradient;
      for (std::size_t c = 0; c < 9; ++c) gradient[c] = lanes.load(p.velocity_gradient, 9, c);
      // A newborn's first half step of work was the element's, which books it itself.
      const Pack settled([&](auto k) { return i + k < p.settled ? 1.0 : 0.0; });
      Pack power = settled * stress_power(state, gradient);
      continuum::update_stress(law, state, gradient, Pack(dt));
      state.relative_volume = min(state.relative_volume, Pack(largest_relative_volume));
      power += stress_power(state, gradient);
      const Pack reference_volume = lanes.load(p.points.mass) / law.density;
      lanes.store(p.stress_work, lanes.load(p.stress_work) + 0.5 * dt * reference_volume * power);
      store_state(p, lanes, state, law.density);
    }
  });
  p.settled = p.count();
  for (std::size_t i = 0; i < p.count(); ++i)
    if (p.relative_volume[i] >= largest_relative_volume) p.steps_at_bound += 1;
}

template <class L>
double stable_step_of(const Particles& p, const L& law) {
  return compute::ordered_minimum(p.count(), chunk, 1e300, [&](std::size_t i) {
    PointState<double> state;
    // Rubble that has come apart bears no shear, though its law keeps the modulus: it is no stiffer than when it
    // closes.
    state.relative_volume = p.damage[i] >= 1 ? std::min(p.relative_volume[i], 1.0) : p.relative_volume[i];
    return 0.3 * p.points.smoothing_length[i] / (continuum::wave_speed(law, state) + p.approach_speed[i]);
  });
}

}  // namespace

void add_particle(Particles& p, const continuum::Law& law, const ParticleBirth& birth) {
  const auto append = [](std::vector<double>& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  append(p.points.position, birth.position);
  append(p.points.velocity, birth.velocity);
  append(p.points.origin, birth.origin);
  append(p.points.stress, birth.state.stress);
  append(p.points.force, std::array{0.0, 0.0, 0.0});
  p.points.mass.push_back(birth.mass);
  p.points.density.push_back(continuum::density(law) / birth.state.relative_volume);
  p.points.smoothing_length.push_back(birth.smoothing_length);
  p.points.bond_reach.push_back(birth.bond_reach);
  append(p.points.viscous_force, std::array{0.0, 0.0, 0.0});
  p.element.push_back(birth.element);
  p.relative_volume.push_back(birth.state.relative_volume);
  p.damage.push_back(birth.state.damage);
  p.plastic_strain.push_back(birth.state.plastic_strain);
  p.bulking_pressure.push_back(birth.state.bulking_pressure);
  p.stress_work.push_back(0);
  append(p.velocity_gradient, birth.velocity_gradient);
  p.approach_speed.push_back(0);
  append(p.acceleration, std::array{0.0, 0.0, 0.0});
}

void update_particle_stress(Particles& particles, const continuum::Law& law, double dt) {
  std::visit([&](const auto& each) { update(particles, each, dt); }, law);
}

double particle_stable_step(const Particles& particles, const continuum::Law& law) {
  return std::visit([&](const auto& each) { return stable_step_of(particles, each); }, law);
}

}  // namespace polynya::ice
