#pragma once
#include <array>
#include <cstddef>

#include "core/compute/pack.hpp"
#include "core/continuum/explicit_solid.hpp"
#include "core/continuum/hexahedron.hpp"
#include "core/continuum/hourglass.hpp"
#include "core/continuum/law.hpp"

/// One step of the elements of one pack (T a pack) or of one of its lanes (T double).
namespace polynya::continuum {

/// Where a pack, or one lane of it, begins in the arrays of a solid.
struct Place {
  std::size_t pack, lane;
  std::size_t element() const { return pack * compute::pack_width + lane; }
  /// Start of a row of an array [pack][rows][W].
  std::size_t row(std::size_t rows, std::size_t index) const {
    return (pack * rows + index) * compute::pack_width + lane;
  }
};

template <class T>
POLYNYA_INLINE NodalVectors<T> nodal_vectors(const ExplicitSolid& solid, const std::vector<double>& values,
                                             Place place) {
  NodalVectors<T> result;
  for (std::size_t a = 0; a < 8; ++a) {
    const std::int32_t* index = &solid.connectivity[place.row(8, a)];
    for (std::size_t i = 0; i < 3; ++i) result[a][i] = gather<T>(values.data() + i, index);
  }
  return result;
}

template <class T>
POLYNYA_INLINE PointState<T> load_state(const ElementState& element, std::size_t e) {
  PointState<T> state;
  for (int c = 0; c < 6; ++c) state.stress[c] = load<T>(&element.stress[c][e]);
  state.damage = load<T>(&element.damage[e]);
  state.plastic_strain = load<T>(&element.plastic_strain[e]);
  state.bulking_pressure = load<T>(&element.bulking_pressure[e]);
  return state;
}

/// Bulk viscosity of von Neumann, Richtmyer and Landshoff, only in compression.
template <class T>
struct BulkViscosity {
  T pressure;  ///< Pa
  T speed;     ///< m/s, by which it shortens the stable step
};
template <class T>
POLYNYA_INLINE BulkViscosity<T> bulk_viscosity(const Numerics& numerics, const T& expansion, const T& length,
                                               const T& wave_speed, const T& density) {
  const T compression = maximum(T(-expansion), T(0.0));
  const T speed =
      select(expansion < T(0.0),
             T(numerics.quadratic_viscosity * length * compression + numerics.linear_viscosity * wave_speed), T(0.0));
  return {density * length * compression * speed, speed};
}

/// Largest stable step of an element, s. Modes in which an element and few neighbours breathe are stiffer than plane
/// waves by up to 3 K / (K + 4 G/3); exposure (0..1) says how much of that its surroundings allow.
template <class T>
POLYNYA_INLINE T element_step(const T& bulk, double shear, const T& exposure, const T& density, const T& length,
                              const T& viscous_speed) {
  const T excess = maximum(T(2.0 * bulk - 4.0 / 3.0 * shear), T(0.0));
  const T square = (bulk + 4.0 / 3.0 * shear + exposure * excess) / density;
  return length / (viscous_speed + square_root(T(viscous_speed * viscous_speed + square)));
}

template <class T>
POLYNYA_INLINE HourglassInput<T> hourglass_input(const ExplicitSolid& solid, std::size_t e, const T& damage,
                                                 const T& flow, const T& area, const T& length, const T& wave_speed) {
  const T rate = load<T>(&solid.element.mass[e]) * wave_speed / (64.0 * length);
  return {load<T>(&solid.hourglass_stiffness[e]) * (1.0 - damage), solid.numerics.hourglass_viscosity * rate,
          solid.numerics.hourglass_floor * rate, flow * area * (1.0 / 12.0)};
}

/// Work of the old and the new nodal forces over the step, by the trapezoidal rule: what central differences take from
/// the kinetic energy, to the last digit. Replaces the old forces by the new ones.
template <class T>
POLYNYA_INLINE T exchange_forces(ExplicitSolid& solid, Place place, const NodalVectors<T>& velocity,
                                 const NodalVectors<T>& force, double dt) {
  T power = T(0.0);
  for (std::size_t a = 0; a < 8; ++a)
    for (std::size_t i = 0; i < 3; ++i) {
      double* slot = &solid.element_force[place.row(24, 3 * a + i)];
      power += (load<T>(slot) + force[a][i]) * velocity[a][i];
      store(force[a][i], slot);
    }
  return -0.5 * dt * power;
}

template <class T>
POLYNYA_INLINE Tensor<T> full_tensor(const SymmetricTensor<T>& s) {
  return {s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2]};
}

/// Stores `value` in the living lanes, or everywhere.
template <class T, class Mask>
POLYNYA_INLINE void store_living(const T& value, std::vector<double>& array, std::size_t e, bool all_live,
                                 const Mask& lives) {
  double* to = &array[e];
  store(all_live ? value : select(lives, value, load<T>(to)), to);
}
template <class T, class Mask>
POLYNYA_INLINE void add_living(const T& value, std::vector<double>& array, std::size_t e, bool all_live,
                               const Mask& lives) {
  double* to = &array[e];
  const T old = load<T>(to);
  store(T(old + (all_live ? value : select(lives, value, T(0.0)))), to);
}

/// False if a living element is inverted or its stress is not finite.
template <class LawType, class T>
bool advance_elements(ExplicitSolid& solid, const LawType& law, Place place, double dt) {
  ElementState& element = solid.element;
  const std::size_t e = place.element();
  const auto lives = load<T>(&element.alive[e]) > T(0.5);
  const bool all_live = !any(!lives);
  const Numerics& numerics = solid.numerics;

  const auto velocity = nodal_vectors<T>(solid, solid.velocities, place);
  const Modes<T> v = modes_of(velocity);
  const Modes<T> x = modes_of(nodal_vectors<T>(solid, solid.positions, place));
  Modes<T> middle;
  for (int m = 1; m < 8; ++m)
    for (int i = 0; i < 3; ++i) middle[m][i] = x[m][i] - 0.5 * dt * v[m][i];

  // The law, over the configuration at mid-step.
  const Geometry<T> half_way = geometry(middle);
  const Tensor<T> gradient = mean_gradient(v, half_way);
  const Geometry<T> now = geometry(x);
  PointState<T> state = load_state<T>(element, e);
  state.relative_volume = now.volume / load<T>(&element.reference_volume[e]);
  state.stress = rotated(state.stress, hughes_winget_rotation(gradient, T(dt)));
  const T flow = advance_stress(law, state, strain_increment(gradient, T(dt)), T(dt));

  // Viscosity, hourglass control and the nodal forces, at the end of the step.
  const T length = shortest_length(now);
  const T density = load<T>(&element.mass[e]) / now.volume;
  const T bulk = tangent_bulk_modulus(law, state);
  const T speed = wave_speed(law, state);
  const T expansion = gradient[0] + gradient[4] + gradient[8];
  const auto viscous = bulk_viscosity(numerics, expansion, length, speed, density);
  const auto control = hourglass_input(solid, e, state.damage, flow, T(now.volume / length), length, speed);

  std::array<std::array<T, 3>, 4> natural;
  const bool irregular = solid.irregular[place.pack] != 0;
  if (irregular)
    for (std::size_t m = 0; m < 4; ++m)
      for (std::size_t j = 0; j < 3; ++j) natural[m][j] = load<T>(&solid.natural_hourglass[place.row(12, 3 * m + j)]);

  Modes<T> hourglass_force{};
  const T stiff_power = add_hourglass_stiffness(control, x, v, T(dt), irregular ? &natural : nullptr, hourglass_force);
  Tensor<T> stress = full_tensor(state.stress);
  for (int i = 0; i < 9; i += 4) stress[i] -= viscous.pressure;
  const T viscous_power = add_hourglass_viscosity(control, x, middle, v, gradient, now.volume, hourglass_force, stress);
  Modes<T> force = stress_forces(stress, now);
  for (int m = 1; m < 8; ++m)
    for (int i = 0; i < 3; ++i) force[m][i] += hourglass_force[m][i];
  NodalVectors<T> nodal_force = nodal_values(force);
  if (!all_live)
    for (auto& node : nodal_force)
      for (T& component : node) component = select(lives, component, T(0.0));

  // Energies: the law's share is what the total leaves, so that the sum is exact.
  const T total = exchange_forces(solid, place, velocity, nodal_force, dt);
  const T hourglass = select(lives, T(dt * (stiff_power + viscous_power)), T(0.0));
  const T shock = select(lives, T(-dt * viscous.pressure * expansion * half_way.volume), T(0.0));
  store(T(load<T>(&element.internal_energy[e]) + total - hourglass - shock), &element.internal_energy[e]);
  add_living(hourglass, element.hourglass_energy, e, all_live, lives);
  add_living(shock, element.viscous_energy, e, all_live, lives);

  for (int c = 0; c < 6; ++c) store_living(state.stress[c], element.stress[c], e, all_live, lives);
  store_living(now.volume, element.volume, e, all_live, lives);
  if constexpr (!std::is_same_v<LawType, Elastic>) {
    store_living(state.damage, element.damage, e, all_live, lives);
    store_living(state.plastic_strain, element.plastic_strain, e, all_live, lives);
    store_living(state.bulking_pressure, element.bulking_pressure, e, all_live, lives);
  }
  const T step = element_step(bulk, law.shear_modulus, load<T>(&solid.exposure[e]), density, length, viscous.speed);
  store(select(lives, step, T(1e300)), &element.step_limit[e]);

  const T trace = state.stress[0] + state.stress[1] + state.stress[2];
  const auto good = (now.volume > T(0.0)) && (half_way.volume > T(0.0)) && (trace * trace < T(1e300));
  return !any(lives && !good);
}

}  // namespace polynya::continuum
