#include "core/continuum/rigid_modes.hpp"

#include <cmath>
#include <cstdint>

namespace polynya::continuum {
namespace {

/// Of the mean square of a rigid motion at the held components: below it that motion is not held. A rotation about a
/// support of the width w of a body of radius r has (w/r)^2.
constexpr double held_share = 1e-12;

bool is_held(const ExplicitSolid& solid, std::size_t i) {
  return (solid.fixed[i / 3] >> i % 3 & 1) != 0;
}

/// Three translations, three rotations about the centre of mass, by the radius of gyration, of all nodes.
Eigen::MatrixXd all_rigid_modes(const ExplicitSolid& solid) {
  const std::size_t n = solid.node_count();
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double mass = 0, square = 0;
  const auto place = [&](std::size_t k) { return Eigen::Map<const Eigen::Vector3d>(&solid.positions[3 * k]); };
  for (std::size_t k = 0; k < n; ++k) mass += solid.masses[k], centre += solid.masses[k] * place(k);
  centre /= mass;
  for (std::size_t k = 0; k < n; ++k) square += solid.masses[k] * (place(k) - centre).squaredNorm();
  const double radius = std::sqrt(square / mass);
  Eigen::MatrixXd modes(3 * n, 6);
  for (std::size_t k = 0; k < n; ++k) {
    const Eigen::Vector3d arm = (place(k) - centre) / radius;
    for (int axis = 0; axis < 3; ++axis) {
      modes.block<3, 1>(static_cast<Eigen::Index>(3 * k), axis) = Eigen::Vector3d::Unit(axis);
      modes.block<3, 1>(static_cast<Eigen::Index>(3 * k), 3 + axis) = Eigen::Vector3d::Unit(axis).cross(arm);
    }
  }
  return modes;
}

/// Combinations of rigid motions that move no held component, as columns.
Eigen::MatrixXd free_combinations(const ExplicitSolid& solid, const Eigen::MatrixXd& modes) {
  Eigen::Matrix<double, 6, 6> held = Eigen::Matrix<double, 6, 6>::Zero();
  std::size_t count = 0;
  for (std::size_t i = 0; i < solid.positions.size(); ++i) {
    if (!is_held(solid, i) || !(solid.masses[i / 3] > 0)) continue;
    const auto row = modes.row(static_cast<Eigen::Index>(i));
    held += row.transpose() * row;
    ++count;
  }
  if (count == 0) return Eigen::MatrixXd::Identity(6, 6);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> values(held);
  Eigen::Index free = 0;
  while (free < 6 && values.eigenvalues()[free] < held_share * static_cast<double>(count)) ++free;
  return values.eigenvectors().leftCols(free);
}

}  // namespace

Eigen::VectorXd times_masses(const ExplicitSolid& solid, const Eigen::VectorXd& values) {
  Eigen::VectorXd result = values;
  for (Eigen::Index i = 0; i < values.size(); ++i) result[i] *= solid.masses[static_cast<std::size_t>(i / 3)];
  return result;
}

Eigen::MatrixXd free_rigid_modes(const ExplicitSolid& solid) {
  Eigen::MatrixXd modes = all_rigid_modes(solid);
  modes = modes * free_combinations(solid, modes);
  for (std::size_t i = 0; i < solid.positions.size(); ++i)
    if (is_held(solid, i) || !(solid.masses[i / 3] > 0)) modes.row(static_cast<Eigen::Index>(i)).setZero();
  if (modes.cols() == 0) return modes;
  Eigen::MatrixXd moved(modes.rows(), modes.cols());
  for (Eigen::Index c = 0; c < modes.cols(); ++c) moved.col(c) = times_masses(solid, modes.col(c));
  const Eigen::MatrixXd gram = modes.transpose() * moved;
  const Eigen::LLT<Eigen::MatrixXd> factor(gram);
  return factor.matrixL().solve(modes.transpose()).transpose();
}

std::vector<double> without_rigid_acceleration(const ExplicitSolid& solid, std::span<const double> loads) {
  const Eigen::MatrixXd modes = free_rigid_modes(solid);
  Eigen::VectorXd balanced = Eigen::Map<const Eigen::VectorXd>(loads.data(), static_cast<Eigen::Index>(loads.size()));
  // Twice: what rounding leaves of a weight that buoyancy carries is then in the last digit of the loads.
  for (int pass = 0; pass < 2; ++pass) {
    const Eigen::VectorXd acceleration = modes * (modes.transpose() * balanced);
    balanced -= times_masses(solid, acceleration);
  }
  return {balanced.begin(), balanced.end()};
}

}  // namespace polynya::continuum
