#include "core/continuum/hexahedron_kernel.hpp"

namespace polynya::continuum {
namespace {

constexpr std::size_t w = compute::pack_width;

Place place_of(std::size_t element) {
  return {element / w, element % w};
}

/// arrays: ElementState or PointArrays.
template <class Arrays>
void store_state(const PointState<double>& state, Arrays& arrays, std::size_t e) {
  for (std::size_t c = 0; c < 6; ++c) arrays.stress[c][e] = state.stress[c];
  arrays.damage[e] = state.damage;
  arrays.plastic_strain[e] = state.plastic_strain;
  arrays.bulking_pressure[e] = state.bulking_pressure;
}

std::array<double, 3> mean_of(const ExplicitSolid& solid, const std::vector<double>& values, std::size_t element) {
  std::array<double, 3> mean{};
  for (std::size_t a = 0; a < 8; ++a)
    for (std::size_t i = 0; i < 3; ++i) mean[i] += 0.125 * values[3 * solid.mesh.elements[8 * element + a] + i];
  return mean;
}

}  // namespace

std::array<double, 3> element_centre(const ExplicitSolid& solid, std::size_t element) {
  return mean_of(solid, solid.positions, element);
}

std::array<double, 3> element_velocity(const ExplicitSolid& solid, std::size_t element) {
  return mean_of(solid, solid.velocities, element);
}

Tensor<double> velocity_gradient(const ExplicitSolid& solid, std::size_t element) {
  const auto x = modes_of(nodal_vectors<double>(solid, solid.positions, place_of(element)));
  const auto v = modes_of(nodal_vectors<double>(solid, solid.velocities, place_of(element)));
  return mean_gradient(v, geometry(x));
}

double characteristic_length(const ExplicitSolid& solid, std::size_t element) {
  return shortest_length(geometry(modes_of(nodal_vectors<double>(solid, solid.positions, place_of(element)))));
}

PointState<double> point_state(const ExplicitSolid& solid, std::size_t element) {
  auto state = load_state<double>(solid.element, element);
  state.relative_volume = solid.element.volume[element] / solid.element.reference_volume[element];
  return state;
}

void set_point_state(ExplicitSolid& solid, std::size_t element, const PointState<double>& state) {
  store_state(state, solid.element, element);
  for (PointArrays& point : solid.points) store_state(state, point, element);
}

}  // namespace polynya::continuum
