#include "core/continuum/stiffness.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/compute/pack.hpp"

namespace polynya::continuum {
namespace {

constexpr std::size_t block = 4096;        // elements at a time: what they give stays in the cache
constexpr double difference = 1e-6;        // displacement over element size
constexpr Eigen::Index element_rows = 24;  // three components of eight nodes
using ElementMatrix = Eigen::Matrix<double, element_rows, element_rows>;

std::vector<double> part(const std::vector<double>& from, std::size_t first, std::size_t size, std::size_t count) {
  std::vector<double> result(size, 0.0);
  std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(first), count, result.begin());
  return result;
}

template <class Arrays>
void take_part(const Arrays& from, std::size_t first, std::size_t size, std::size_t count, Arrays& to) {
  for (std::size_t c = 0; c < 6; ++c) to.stress[c] = part(from.stress[c], first, size, count);
  to.damage = part(from.damage, first, size, count);
  to.plastic_strain = part(from.plastic_strain, first, size, count);
  to.bulking_pressure = part(from.bulking_pressure, first, size, count);
}

/// Some of the elements, every one with eight nodes of its own.
struct LooseElements {
  ExplicitSolid solid;
  RememberedState start;
  std::vector<double> present, displacement, sizes;  ///< m; sizes: [element]

  LooseElements(const ExplicitSolid& whole, const RememberedState& state, std::span<const double> now,
                std::span<const double> moved, std::size_t first, std::size_t count) {
    HexMesh mesh;
    for (std::size_t k = 8 * first; k < 8 * (first + count); ++k) {
      const std::size_t n = 3 * static_cast<std::size_t>(whole.mesh.elements[k]);
      mesh.elements.push_back(static_cast<std::int32_t>(k - 8 * first));
      for (std::size_t i = n; i < n + 3; ++i) {
        mesh.nodes.push_back(whole.mesh.nodes[i]);
        present.push_back(now[i]);
        displacement.push_back(moved[i]);
      }
    }
    solid = make_solid(whole.name, std::move(mesh), whole.law, without_viscosities(whole.numerics));
    const std::size_t size = compute::padded(count);
    take_part(state, first, size, count, start);
    start.points.resize(state.points.size());
    for (std::size_t p = 0; p < state.points.size(); ++p)
      take_part(state.points[p], first, size, count, start.points[p]);
    for (std::size_t e = 0; e < count; ++e) sizes.push_back(std::cbrt(solid.element.reference_volume[e]));
  }
};

/// Takes out what rigid motions of the element would give.
void remove_rigid_part(const double* nodes, ElementMatrix& k) {
  Eigen::Matrix<double, element_rows, 6> modes;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (int a = 0; a < 8; ++a) centre += 0.125 * Eigen::Map<const Eigen::Vector3d>(nodes + 3 * a);
  for (int a = 0; a < 8; ++a)
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d arm = Eigen::Map<const Eigen::Vector3d>(nodes + 3 * a) - centre;
      modes.block<3, 1>(3 * a, axis) = Eigen::Vector3d::Unit(axis);
      modes.block<3, 1>(3 * a, 3 + axis) = Eigen::Vector3d::Unit(axis).cross(arm);
    }
  for (int c = 0; c < 6; ++c) modes.col(c).normalize();
  const Eigen::HouseholderQR<Eigen::Matrix<double, element_rows, 6>> factor(modes);
  const Eigen::Matrix<double, element_rows, 6> base =
      factor.householderQ() * Eigen::Matrix<double, element_rows, 6>::Identity();
  k -= base * (base.transpose() * k).eval();
  k -= (k * base).eval() * base.transpose();
}

std::vector<ElementMatrix> element_matrices(LooseElements& loose) {
  const std::size_t count = loose.sizes.size();
  std::vector<ElementMatrix> result(count);
  step_from_reference(loose.solid, loose.start, loose.present, loose.displacement);
  const std::vector<double> unmoved = loose.solid.internal_force;
  for (std::size_t column = 0; column < element_rows; ++column) {
    std::vector<double> place = loose.present, way = loose.displacement;
    for (std::size_t i = column, e = 0; e < count; ++e, i += element_rows) {
      place[i] += difference * loose.sizes[e];
      way[i] += place[i] - loose.present[i];
    }
    step_from_reference(loose.solid, loose.start, place, way);
    for (std::size_t e = 0; e < count; ++e) {
      const double further = place[element_rows * e + column] - loose.present[element_rows * e + column];
      for (std::size_t row = 0; row < element_rows; ++row) {
        const std::size_t i = element_rows * e + row;
        result[e](static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)) =
            (unmoved[i] - loose.solid.internal_force[i]) / further;
      }
    }
  }
  for (std::size_t e = 0; e < count; ++e) {
    result[e] = 0.5 * (result[e] + result[e].transpose()).eval();
    remove_rigid_part(&loose.present[element_rows * e], result[e]);
  }
  return result;
}

}  // namespace

Eigen::SparseMatrix<double> tangent_stiffness(const ExplicitSolid& solid, const RememberedState& start,
                                              std::span<const double> present, std::span<const double> displacement,
                                              std::span<const std::int32_t> unknown_of) {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t first = 0; first < solid.element_count(); first += block) {
    const std::size_t count = std::min(block, solid.element_count() - first);
    LooseElements loose(solid, start, present, displacement, first, count);
    const std::vector<ElementMatrix> matrices = element_matrices(loose);
    for (std::size_t e = 0; e < count; ++e) {
      std::array<std::int32_t, element_rows> at;
      for (std::size_t r = 0; r < element_rows; ++r)
        at[r] = unknown_of[3 * static_cast<std::size_t>(solid.mesh.elements[8 * (first + e) + r / 3]) + r % 3];
      for (std::size_t c = 0; c < element_rows; ++c)
        for (std::size_t r = 0; r < element_rows; ++r)
          if (at[c] >= 0 && at[r] >= at[c] && solid.element.alive[first + e] != 0)
            entries.emplace_back(at[r], at[c], matrices[e](static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)));
    }
  }
  const std::int32_t unknowns = 1 + *std::max_element(unknown_of.begin(), unknown_of.end());
  Eigen::SparseMatrix<double> matrix(unknowns, unknowns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace polynya::continuum
