#pragma once
#include <algorithm>
#include <array>
#include <cstddef>

#include "core/compute/pack.hpp"
#include "core/continuum/explicit_solid.hpp"
#include "core/continuum/exposure.hpp"
#include "core/continuum/hexahedron.hpp"
#include "core/continuum/hourglass.hpp"
#include "core/continuum/law.hpp"
#include "core/continuum/nodal_lanes.hpp"

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

/// Motion of the nodes of a chunk, an eighth of it (exactly: so its sums are the modes), and what its elements give
/// them.
struct ChunkNodes {
  std::vector<NodeRecord> position, velocity, force;
};

template <class T>
POLYNYA_INLINE NodalVectors<T> nodal_vectors(const std::vector<NodeRecord>& nodes, const ElementChunks& chunks,
                                             Place place) {
  NodalVectors<T> result;
#pragma GCC unroll 8
  for (std::size_t a = 0; a < 8; ++a)
    result[a] = gather_vectors<T>(nodes.data(), &chunks.connectivity[place.row(8, a)]);
  return result;
}

/// arrays: ElementState or PointArrays.
template <class T, class Arrays>
POLYNYA_INLINE PointState<T> load_state(const Arrays& element, std::size_t e) {
  PointState<T> state;
  for (int c = 0; c < 6; ++c) state.stress[c] = load<T>(&element.stress[c][e]);
  state.damage = load<T>(&element.damage[e]);
  state.plastic_strain = load<T>(&element.plastic_strain[e]);
  state.bulking_pressure = load<T>(&element.bulking_pressure[e]);
  return state;
}

/// Asks for the state that comes up some packs later: the processor's own look-ahead ends with every page.
template <class LawType>
POLYNYA_INLINE void prefetch_state(const ExplicitSolid& solid, std::size_t pack) {
  constexpr std::size_t ahead = 12;
  const ElementState& element = solid.element;
  const std::size_t e = std::min(pack + ahead, solid.idle.size() - 1) * compute::pack_width;
  const auto fetch = [&](const auto& array, std::size_t index) { __builtin_prefetch(&array[index]); };
  for (const auto& component : element.stress) fetch(component, e);
  fetch(element.reference_volume, e), fetch(element.volume, e), fetch(element.step_limit, e);
  for (const auto& mode : solid.hourglass_stiffness) fetch(mode, e);
  fetch(solid.chunks.connectivity, 8 * e), fetch(solid.chunks.connectivity, 8 * e + 32);
  if constexpr (!std::is_same_v<LawType, Elastic>)
    fetch(element.damage, e), fetch(element.plastic_strain, e), fetch(element.bulking_pressure, e);
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
POLYNYA_INLINE T element_step(const T& bulk, double shear, const T& exposure, const T& specific_volume, const T& length,
                              const T& viscous_speed) {
  const T excess = maximum(T(2.0 * bulk - 4.0 / 3.0 * shear), T(0.0));
  const T square = (bulk + 4.0 / 3.0 * shear + exposure * excess) * specific_volume;
  return length / (viscous_speed + square_root(T(viscous_speed * viscous_speed + square)));
}

/// What damage and plastic flow leave of the hourglass stiffness.
template <class LawType, class T>
POLYNYA_INLINE T hourglass_share(const Numerics& numerics, const LawType& law, const PointState<T>& state,
                                 const T& flow) {
  if constexpr (std::is_same_v<LawType, Elastic>) return T(1.0);
  if (!any(state.plastic_strain > T(0.0))) return 1.0 - state.damage;
  const T yields = maximum(flow, T(1e-290));  // plastic strain is measured by Y / 3 G
  const T lost = minimum(T(1.0), T(3.0 * law.shear_modulus * state.plastic_strain / yields));
  return (1.0 - state.damage) * (1.0 - (1.0 - numerics.hourglass_flowed) * lost);
}

/// Hourglass stiffness of the undamaged elements, N/m, of the modes 4..7.
template <class T>
POLYNYA_INLINE std::array<T, 4> undamaged_stiffness(const ExplicitSolid& solid, std::size_t e) {
  std::array<T, 4> k;
  for (std::size_t m = 0; m < 3; ++m) k[m] = load<T>(&solid.hourglass_stiffness[m][e]);
  k[3] = (1.0 / 3.0) * minimum(minimum(k[0], k[1]), k[2]);
  return k;
}

/// What the modes mean as bending: fibres whose strain has the mean square 64 sum_m k_m |G_m|^2/(E V) (hourglass.hpp),
/// of the shape elastic stress, what damage leaves of it, of the rate strain of the step. Nothing without stiffness.
template <class LawType, class T>
POLYNYA_INLINE Spread<T> spread_about_mean(const Numerics& numerics, const LawType& law, const std::array<T, 4>& k,
                                           const HourglassModes<T>& shape, const HourglassModes<T>& rate,
                                           const T& inverse_volume, const T& damage, const T& dt) {
  if (!(numerics.hourglass_stiffness > 0)) return {};
  const double young = 9 * law.bulk_modulus * law.shear_modulus / (3 * law.bulk_modulus + law.shear_modulus);
  const T per_stiffness = 64.0 / (young * numerics.hourglass_stiffness) * inverse_volume;
  return {(1.0 - damage) * young * square_root(T(per_stiffness * weighted_square(k, shape))),
          dt * square_root(T(per_stiffness * weighted_square(k, rate)))};
}

/// Laws that see how stress and strain vary about the mean.
template <class LawType, class T>
concept SeesSpread = requires(const LawType& law, PointState<T>& state, SymmetricTensor<T> strain, T dt,
                              Spread<T> spread) { advance_stress(law, state, strain, dt, spread); };

/// One step of the law; spread() is asked for by laws that see more than the mean.
template <class LawType, class T, class SpreadFunction>
POLYNYA_INLINE T advance_mean_stress(const LawType& law, PointState<T>& state, const SymmetricTensor<T>& strain, T dt,
                                     const SpreadFunction& spread) {
  if constexpr (SeesSpread<LawType, T>)
    return advance_stress(law, state, strain, dt, spread());
  else
    return advance_stress(law, state, strain, dt);
}

template <class LawType, class T>
POLYNYA_INLINE HourglassInput<T> hourglass_input(const Numerics& numerics, const LawType& law,
                                                 const std::array<T, 4>& undamaged, const T& mass,
                                                 const PointState<T>& state, const T& flow, const T& area,
                                                 const T& inverse_length, const T& wave_speed) {
  const T rate = (1.0 / 64.0) * mass * wave_speed * inverse_length;
  const double floor = SeesSpread<LawType, T> ? 0.0 : numerics.hourglass_floor;
  HourglassInput<T> in{undamaged, numerics.hourglass_viscosity * rate, floor * rate, flow * area * (1.0 / 12.0)};
  const T share = hourglass_share(numerics, law, state, flow);
  for (T& stiffness : in.stiffness) stiffness *= share;
  return in;
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
/// The same for what seldom changes: memory that is not written need not be written back.
template <class T, class Mask>
POLYNYA_INLINE void store_changed(const T& value, std::vector<double>& array, std::size_t e, const Mask& lives) {
  double* to = &array[e];
  const T old = load<T>(to);
  if (any(lives && value != old)) store(select(lives, value, old), to);
}

/// What the elements of a chunk add up, lane by lane.
template <class T>
struct ElementSums {
  T hourglass{0.0}, viscous{0.0};  ///< J
  T step_limit{1e300};             ///< s
};

/// One step of the elements at `place`: state, forces on the chunk's nodes, sums. False if a living element is inverted
/// or its stress is not finite.
template <class LawType, class T>
POLYNYA_INLINE bool advance_elements(ExplicitSolid& solid, const LawType& law, Place place, double dt,
                                     ChunkNodes& nodes, ElementSums<T>& sums) {
  ElementState& element = solid.element;
  const std::size_t e = place.element();
  const bool all_live = solid.complete[place.pack] != 0;
  const auto lives = all_live ? T(1.0) > T(0.5) : load<T>(&element.alive[e]) > T(0.5);
  const Numerics& numerics = solid.numerics;

  const Modes<T> v = mode_sums_of(nodal_vectors<T>(nodes.velocity, solid.chunks, place));
  const Modes<T> x = mode_sums_of(nodal_vectors<T>(nodes.position, solid.chunks, place));
  Modes<T> middle;
  for (int m = 1; m < 8; ++m)
    for (int i = 0; i < 3; ++i) middle[m][i] = x[m][i] - 0.5 * dt * v[m][i];

  // The law, over the configuration at mid-step.
  const Geometry<T> half_way = geometry(middle);
  const Tensor<T> gradient = mean_gradient(v, half_way);
  const Geometry<T> now = geometry(x);
  const T reference_volume = load<T>(&element.reference_volume[e]);
  PointState<T> state = load_state<T>(element, e);
  state.relative_volume = now.volume / reference_volume;
  state.stress = rotated(state.stress, hughes_winget_rotation(gradient, T(dt)));

  HourglassModes<T> natural;
  const bool irregular = solid.irregular[place.pack] != 0;
  if (irregular)
    for (std::size_t m = 0; m < 4; ++m)
      for (std::size_t j = 0; j < 3; ++j) natural[m][j] = load<T>(&solid.natural_hourglass[place.row(12, 3 * m + j)]);
  const auto rate = hourglass_rate(v, middle, gradient);
  const auto stiffness = undamaged_stiffness<T>(solid, e);
  const T flow = advance_mean_stress(law, state, strain_increment(gradient, T(dt)), T(dt), [&] {
    const auto shape = beyond_mean_motion(middle, irregular ? &natural : nullptr);
    return spread_about_mean(numerics, law, stiffness, shape, rate, T(1.0 / half_way.volume), state.damage, T(dt));
  });

  // Viscosity, hourglass control and the nodal forces, at the end of the step.
  const T mass = law.density * reference_volume;
  const T area = largest_area(now), length = now.volume / area;
  const T inverse_volume = 1.0 / now.volume;
  const T density = mass * inverse_volume;
  const T bulk = tangent_bulk_modulus(law, state);
  const T speed = wave_speed(law, state);
  const T expansion = gradient[0] + gradient[4] + gradient[8];
  const auto viscous = bulk_viscosity(numerics, expansion, length, speed, density);
  const auto control =
      hourglass_input(numerics, law, stiffness, mass, state, flow, area, T(area * inverse_volume), speed);

  Modes<T> hourglass_force{};
  const T stiff_power = add_hourglass_stiffness(control, x, v, T(dt), irregular ? &natural : nullptr, hourglass_force);
  Tensor<T> stress = full_tensor(state.stress);
  for (int i = 0; i < 9; i += 4) stress[i] -= viscous.pressure;
  const T viscous_power =
      add_hourglass_viscosity(control, x, rate, inverse_volume, hourglass_force, stress);
  Modes<T> force = stress_forces(stress, now);
  for (int m = 1; m < 8; ++m)
    for (int i = 0; i < 3; ++i) force[m][i] += hourglass_force[m][i];
  NodalVectors<T> nodal_force = nodal_values(force);
  if (!all_live)
    for (auto& node : nodal_force)
      for (T& component : node) component = select(lives, component, T(0.0));
#pragma GCC unroll 8
  for (std::size_t a = 0; a < 8; ++a)
    scatter_vectors<T>(nodal_force[a], nodes.force.data(), &solid.chunks.connectivity[place.row(8, a)]);

  const T hourglass = dt * (stiff_power + viscous_power);
  const T shock = -dt * viscous.pressure * expansion * half_way.volume;
  sums.hourglass += all_live ? hourglass : select(lives, hourglass, T(0.0));
  sums.viscous += all_live ? shock : select(lives, shock, T(0.0));

  for (int c = 0; c < 6; ++c) store_living(state.stress[c], element.stress[c], e, all_live, lives);
  store_living(now.volume, element.volume, e, all_live, lives);
  if constexpr (!std::is_same_v<LawType, Elastic>) {
    store_changed(state.damage, element.damage, e, lives);
    store_changed(state.plastic_strain, element.plastic_strain, e, lives);
    store_changed(state.bulking_pressure, element.bulking_pressure, e, lives);
  }
  const T exposure = solid.complete[place.pack] == 2 ? T(exposure_amid_others) : load<T>(&solid.exposure[e]);
  T step = element_step(bulk, law.shear_modulus, exposure, T(state.relative_volume * (1 / law.density)), length,
                        viscous.speed);
  if (!all_live) step = select(lives, step, T(1e300));
  store(step, &element.step_limit[e]);
  sums.step_limit = minimum(sums.step_limit, step);

  const T trace = state.stress[0] + state.stress[1] + state.stress[2];
  const auto good = (now.volume > T(0.0)) && (half_way.volume > T(0.0)) && (trace * trace < T(1e300));
  return !any(lives && !good);
}

}  // namespace polynya::continuum
