#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/compute/parallel.hpp"
#include "core/continuum/hexahedron_kernel.hpp"

namespace polynya::continuum {
namespace {

constexpr std::size_t w = compute::pack_width;

/// F = sum_j a_j (outer) A^j from the half edges a of the present and A of the reference shape.
template <class T>
Tensor<T> deformation_gradient_of(const Modes<T>& present, const Modes<T>& reference) {
  const auto c23 = cross(reference[2], reference[3]), c31 = cross(reference[3], reference[1]),
             c12 = cross(reference[1], reference[2]);
  const T inverse = 1.0 / dot(reference[1], c23);
  Tensor<T> f;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      f[3 * i + j] = inverse * (present[1][i] * c23[j] + present[2][i] * c31[j] + present[3][i] * c12[j]);
  return f;
}

template <class T>
Tensor<T> deformation_gradient_at(const ExplicitSolid& solid, Place place) {
  return deformation_gradient_of(modes_of(nodal_vectors<T>(solid, solid.positions, place)),
                                 modes_of(nodal_vectors<T>(solid, solid.mesh.nodes, place)));
}

/// Lanes in which the strain may exceed the critical value. With tr C = sum of squared stretches and J = det F, a given
/// effective strain e leaves (tr C)^3 / J^2 no smaller than (2 exp(e) + exp(-2 e))^3, which the stretch ratios
/// exp(e/2), exp(e/2), exp(-e) attain.
bool may_exceed(const ExplicitSolid& solid, std::size_t pack, double bound) {
  using compute::Pack;
  const auto f = deformation_gradient_at<Pack>(solid, {pack, 0});
  Pack trace = f[0] * f[0];
  for (int c = 1; c < 9; ++c) trace += f[c] * f[c];
  const Pack determinant =
      f[0] * (f[4] * f[8] - f[5] * f[7]) - f[1] * (f[3] * f[8] - f[5] * f[6]) + f[2] * (f[3] * f[7] - f[4] * f[6]);
  const auto lives = load<Pack>(&solid.element.alive[pack * w]) > Pack(0.5);
  return any(lives && !(trace * trace * trace < bound * determinant * determinant));
}

}  // namespace

Tensor<double> deformation_gradient(const ExplicitSolid& solid, std::size_t element) {
  return deformation_gradient_at<double>(solid, {element / w, element % w});
}

double effective_strain(const ExplicitSolid& solid, std::size_t element) {
  const auto f = deformation_gradient(solid, element);
  const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> gradient(f.data());
  const Eigen::Matrix3d cauchy_green = gradient.transpose() * gradient;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(cauchy_green, Eigen::EigenvaluesOnly);
  Eigen::Array3d strain = 0.5 * solver.eigenvalues().array().log();
  strain -= strain.mean();
  return std::sqrt(2.0 / 3.0 * strain.square().sum());
}

std::vector<std::int32_t> elements_above_strain(const ExplicitSolid& solid, double critical_strain) {
  const double trace = 2 * std::exp(critical_strain) + std::exp(-2 * critical_strain);
  // A little below the bound, for round-off.
  const double bound = trace * trace * trace * (1 - 1e-12);
  constexpr std::size_t chunk = 512;
  const std::size_t packs = solid.idle.size();
  std::vector<std::vector<std::int32_t>> found((packs + chunk - 1) / chunk);
  compute::for_chunks(packs, chunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t pack = begin; pack < end; ++pack) {
      if (solid.sleeping.chunk_sleeps(pack / solid.chunks.packs_per_chunk)) continue;
      if (solid.idle[pack] || !may_exceed(solid, pack, bound)) continue;
      for (std::size_t e = pack * w; e < std::min(solid.element_count(), (pack + 1) * w); ++e)
        if (solid.element.alive[e] != 0 && effective_strain(solid, e) > critical_strain)
          found[begin / chunk].push_back(static_cast<std::int32_t>(e));
    }
  });
  std::vector<std::int32_t> all;
  for (const auto& part : found) all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace polynya::continuum
