#pragma once
#include "core/continuum/full_hexahedron.hpp"
#include "core/continuum/hexahedron_kernel.hpp"

/// One step of fully integrated elements: of one pack (T a pack) or of one of its lanes (T double).
namespace polynya::continuum {

/// What the points of an element add up.
template <class T>
struct PointSums {
  PointState<T> mean{{}, T(1.0), T(0.0), T(0.0), T(0.0)};  ///< over the points
  Modes<T> force{};                                        ///< N, of the deviators
  T tension{0.0};                                          ///< N m, mean stress times volume
  T shortest{1e300};                                       ///< m, length that bounds the step
  T smallest{1e300};                                       ///< m^3, Jacobian determinant now and at mid-step
};

/// What all points of an element share.
template <class T>
struct ElementMotion {
  Modes<T> now, middle, velocity;
  T relative_volume, expansion;  ///< V/V0, 1/s
};

/// The law at one point, over the configuration at mid-step, and its force at the end of the step.
template <class LawType, class T, class Mask>
POLYNYA_INLINE void advance_point(const LawType& law, PointArrays& arrays, std::size_t e, const NaturalPlace& at,
                                  const ElementMotion<T>& motion, T dt, const Mask& lives, PointSums<T>& sums) {
  const auto half_way = point_geometry(motion.middle, at), now = point_geometry(motion.now, at);
  const Tensor<T> gradient = point_gradient(motion.velocity, at, half_way, motion.expansion);
  PointState<T> state = load_state<T>(arrays, e);
  state.relative_volume = motion.relative_volume;
  state.stress = rotated(state.stress, hughes_winget_rotation(gradient, dt));
  advance_stress(law, state, strain_increment(gradient, dt), dt);

  SymmetricTensor<T> deviator = state.stress;
  const T mean = (1.0 / 3.0) * (deviator[0] + deviator[1] + deviator[2]);
  for (int c = 0; c < 3; ++c) deviator[c] -= mean;
  add_deviator_forces(deviator, at, now, sums.force);
  sums.tension += mean * now.volume;
  sums.shortest = minimum(sums.shortest, point_length(now));
  sums.smallest = minimum(sums.smallest, minimum(half_way.volume, now.volume));

  constexpr double share = 1.0 / gauss_point_count;
  for (int c = 0; c < 6; ++c) {
    sums.mean.stress[c] += share * state.stress[c];
    store_living(state.stress[c], arrays.stress[c], e, false, lives);
  }
  if constexpr (!std::is_same_v<LawType, Elastic>) {
    sums.mean.damage += share * state.damage;
    sums.mean.plastic_strain += share * state.plastic_strain;
    sums.mean.bulking_pressure += share * state.bulking_pressure;
    store_changed(state.damage, arrays.damage, e, lives);
    store_changed(state.plastic_strain, arrays.plastic_strain, e, lives);
    store_changed(state.bulking_pressure, arrays.bulking_pressure, e, lives);
  }
}

/// The means over the points are the element's state.
template <class LawType, class T, class Mask>
POLYNYA_INLINE void store_mean(const PointState<T>& mean, ElementState& element, std::size_t e, const Mask& lives) {
  for (int c = 0; c < 6; ++c) store_living(mean.stress[c], element.stress[c], e, false, lives);
  if constexpr (!std::is_same_v<LawType, Elastic>) {
    store_changed(mean.damage, element.damage, e, lives);
    store_changed(mean.plastic_strain, element.plastic_strain, e, lives);
    store_changed(mean.bulking_pressure, element.bulking_pressure, e, lives);
  }
}

/// Like advance_elements, without hourglass forces. False also if the map is folded at a point.
template <class LawType, class T>
bool advance_full_elements(ExplicitSolid& solid, const LawType& law, Place place, double dt, ChunkNodes& nodes,
                           ElementSums<T>& sums) {
  ElementState& element = solid.element;
  const std::size_t e = place.element();
  const auto lives = load<T>(&element.alive[e]) > T(0.5);

  ElementMotion<T> motion;
  motion.velocity = mode_sums_of(nodal_vectors<T>(nodes.velocity, solid.chunks, place));
  motion.now = mode_sums_of(nodal_vectors<T>(nodes.position, solid.chunks, place));
  for (int m = 0; m < 8; ++m)
    for (int i = 0; i < 3; ++i) motion.middle[m][i] = motion.now[m][i] - 0.5 * dt * motion.velocity[m][i];
  const Geometry<T> half_way = geometry(motion.middle), now = geometry(motion.now);
  const Tensor<T> gradient = mean_gradient(motion.velocity, half_way);
  motion.expansion = gradient[0] + gradient[4] + gradient[8];
  const T reference_volume = load<T>(&element.reference_volume[e]);
  motion.relative_volume = now.volume / reference_volume;

  PointSums<T> points;
  for (std::size_t p = 0; p < gauss_point_count; ++p)
    advance_point(law, solid.points[p], e, gauss_place(p), motion, T(dt), lives, points);

  // The moduli depend on the volume alone, which the points share.
  PointState<T> common;
  common.relative_volume = motion.relative_volume;
  const T length = shortest_length(now), bulk = tangent_bulk_modulus(law, common), speed = wave_speed(law, common);
  const T density = law.density * reference_volume / now.volume;
  const auto viscous = bulk_viscosity(solid.numerics, motion.expansion, length, speed, density);

  const T zero = T(0.0), pull = points.tension / now.volume - viscous.pressure;
  Modes<T> force = stress_forces(Tensor<T>{pull, zero, zero, zero, pull, zero, zero, zero, pull}, now);
  for (int m = 1; m < 8; ++m)
    for (int i = 0; i < 3; ++i) force[m][i] = select(lives, T(force[m][i] + points.force[m][i]), zero);
  const NodalVectors<T> nodal_force = nodal_values(force);
  for (std::size_t a = 0; a < 8; ++a)
    scatter_vectors<T>(nodal_force[a], nodes.force.data(), &solid.chunks.connectivity[place.row(8, a)]);
  sums.viscous += select(lives, T(-dt * viscous.pressure * motion.expansion * half_way.volume), zero);

  store_mean<LawType>(points.mean, element, e, lives);
  store_living(now.volume, element.volume, e, false, lives);
  const T step = select(
      lives,
      element_step(bulk, law.shear_modulus, load<T>(&solid.exposure[e]), T(motion.relative_volume * (1 / law.density)),
                   T(minimum(length, points.shortest)), viscous.speed),
      T(1e300));
  store(step, &element.step_limit[e]);
  sums.step_limit = minimum(sums.step_limit, step);

  const T trace = points.mean.stress[0] + points.mean.stress[1] + points.mean.stress[2];
  const auto good = now.volume > zero && half_way.volume > zero && points.smallest > zero && trace * trace < T(1e300);
  return !any(lives && !good);
}

}  // namespace polynya::continuum
