#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "core/compute/large_pages.hpp"
#include "core/compute/pack.hpp"
#include "core/continuum/exposure.hpp"
#include "core/continuum/full_hexahedron.hpp"
#include "core/continuum/hexahedron_kernel.hpp"

namespace polynya::continuum {
namespace {

constexpr std::size_t w = compute::pack_width;

void check_mesh(const std::string& name, const HexMesh& mesh) {
  if (mesh.element_count() == 0) throw std::invalid_argument(name + ": the mesh has no element");
  for (std::int32_t n : mesh.elements)
    if (n < 0 || static_cast<std::size_t>(n) >= mesh.node_count())
      throw std::invalid_argument(name + ": an element names node " + std::to_string(n) + ", the mesh has " +
                                  std::to_string(mesh.node_count()));
}

void size_points(ExplicitSolid& solid, std::size_t elements) {
  if (solid.numerics.integration != Integration::full) return;
  solid.points.resize(gauss_point_count);
  for (PointArrays& point : solid.points) {
    for (auto& component : point.stress) component = compute::zeros_in_large_pages(elements);
    for (auto* array : {&point.damage, &point.plastic_strain, &point.bulking_pressure})
      *array = compute::zeros_in_large_pages(elements);
  }
}

void size_arrays(ExplicitSolid& solid) {
  const std::size_t nodes = solid.mesh.node_count(), elements = compute::padded(solid.element_count()),
                    packs = elements / w;
  for (auto* array : {&solid.positions, &solid.velocities, &solid.internal_force})
    *array = compute::zeros_in_large_pages(3 * nodes);
  std::copy(solid.mesh.nodes.begin(), solid.mesh.nodes.end(), solid.positions.begin());
  solid.masses.assign(nodes, 0.0);
  solid.fixed.assign(nodes, 0);
  solid.living_elements.assign(nodes, 0);
  ElementState& element = solid.element;
  for (auto* array :
       {&element.volume, &element.mass, &element.damage, &element.plastic_strain, &element.bulking_pressure,
        &element.alive, &solid.exposure, &element.step_limit, &element.reference_volume})
    *array = compute::zeros_in_large_pages(elements);
  for (auto& mode : solid.hourglass_stiffness) mode = compute::zeros_in_large_pages(elements);
  for (auto& component : element.stress) component = compute::zeros_in_large_pages(elements);
  size_points(solid, elements);
  std::fill(element.step_limit.begin(), element.step_limit.end(), 1e300);
  std::fill(element.reference_volume.begin(), element.reference_volume.end(), 1.0);
  solid.natural_hourglass.assign(12 * elements, 0.0);
  solid.irregular.assign(packs, 0);
  solid.idle.assign(packs, 0);
  solid.complete.assign(packs, 0);
  std::fill_n(element.alive.begin(), solid.element_count(), 1.0);
}

void number_connections(ExplicitSolid& solid) {
  const std::size_t elements = solid.element_count();
  solid.connectivity.resize(8 * compute::padded(elements));
  for (std::size_t e = 0; e < compute::padded(elements); ++e)
    for (std::size_t a = 0; a < 8; ++a)
      solid.connectivity[(e / w * 8 + a) * w + e % w] = 3 * solid.mesh.elements[8 * (e < elements ? e : 0) + a];
  solid.chunks = make_chunks(solid.mesh);
  solid.force_shares.assign(static_cast<std::size_t>(solid.chunks.shares), {});
  solid.chunk_step_limit.assign(solid.chunks.chunk_count(), 1e300);
  for (std::int32_t n : solid.mesh.elements) ++solid.living_elements[n];
}

/// Hourglass shape of the reference in the base of its half edges, and the stiffness of bending: see hourglass.hpp.
void shape_hourglass(ExplicitSolid& solid, std::size_t e, const Modes<double>& c, double volume, double young) {
  for (std::size_t m = 0; m < 3; ++m) {
    const auto &one = c[(m + 1) % 3 + 1], &other = c[(m + 2) % 3 + 1];
    solid.hourglass_stiffness[m][e] =
        solid.numerics.hourglass_stiffness * young * volume / (192 * std::max(dot(one, one), dot(other, other)));
  }
  const double triple = dot(c[1], cross(c[2], c[3]));
  for (std::size_t m = 0; m < 4; ++m) {
    const std::array<double, 3> natural{dot(c[m + 4], cross(c[2], c[3])) / triple,
                                        dot(c[m + 4], cross(c[3], c[1])) / triple,
                                        dot(c[m + 4], cross(c[1], c[2])) / triple};
    for (std::size_t j = 0; j < 3; ++j) {
      if (std::abs(natural[j]) < least_natural_hourglass) continue;
      solid.natural_hourglass[(e / w * 12 + 3 * m + j) * w + e % w] = natural[j];
      solid.irregular[e / w] = 1;
    }
  }
}

void set_elements(ExplicitSolid& solid) {
  std::fill(solid.natural_hourglass.begin(), solid.natural_hourglass.end(), 0.0);
  std::fill(solid.irregular.begin(), solid.irregular.end(), std::uint8_t{0});
  const Elastic elastic = elastic_part(solid.law);
  const double young =
      9 * elastic.bulk_modulus * elastic.shear_modulus / (3 * elastic.bulk_modulus + elastic.shear_modulus);
  for (std::size_t e = 0; e < solid.element_count(); ++e) {
    const auto c = modes_of(nodal_vectors<double>(solid, solid.mesh.nodes, {e / w, e % w}));
    const auto g = geometry(c);
    if (!(g.volume > 0)) {
      const auto centre = element_centre(solid, e);
      throw std::invalid_argument(solid.name + ": element " + std::to_string(e) + " at (" + std::to_string(centre[0]) +
                                  ", " + std::to_string(centre[1]) + ", " + std::to_string(centre[2]) +
                                  ") m has the volume " + std::to_string(g.volume) +
                                  " m^3; its nodes must be in VTK's order");
    }
    solid.element.reference_volume[e] = g.volume;
    shape_hourglass(solid, e, c, g.volume, young);
  }
}

}  // namespace

void lay_down_unloaded(ExplicitSolid& solid) {
  std::copy(solid.mesh.nodes.begin(), solid.mesh.nodes.end(), solid.positions.begin());
  std::fill(solid.velocities.begin(), solid.velocities.end(), 0.0);
  set_elements(solid);
  // The reference volume by the very instructions that will compute the current one: at rest mu is exactly 0.
  internal_forces(solid, 0.0);
  std::copy_n(solid.element.volume.begin(), solid.element_count(), solid.element.reference_volume.begin());
  for (auto& component : solid.element.stress) std::fill(component.begin(), component.end(), 0.0);
  for (PointArrays& point : solid.points)
    for (auto& component : point.stress) std::fill(component.begin(), component.end(), 0.0);
}

ExplicitSolid make_solid(std::string name, HexMesh mesh, Law law, Numerics numerics) {
  check_mesh(name, mesh);
  ExplicitSolid solid;
  solid.name = std::move(name);
  solid.mesh = std::move(mesh);
  solid.law = std::move(law);
  solid.numerics = numerics;
  size_arrays(solid);
  number_connections(solid);
  for (std::size_t e = 0; e < solid.element_count(); ++e) update_exposure(solid, e);
  lay_down_unloaded(solid);
  std::fill(solid.element.reference_volume.begin() + static_cast<std::ptrdiff_t>(solid.element_count()),
            solid.element.reference_volume.end(), solid.element.reference_volume[0]);
  for (std::size_t e = 0; e < solid.element_count(); ++e) {
    solid.element.mass[e] = density(solid.law) * solid.element.reference_volume[e];
    for (std::size_t a = 0; a < 8; ++a) solid.masses[solid.mesh.elements[8 * e + a]] += 0.125 * solid.element.mass[e];
  }
  internal_forces(solid, 0.0);
  return solid;
}

}  // namespace polynya::continuum
