#pragma once
#include <Eigen/Dense>
#include <span>
#include <vector>

#include "core/continuum/explicit_solid.hpp"

namespace polynya::continuum {

/// The infinitesimal rigid motions that the held components of the nodes leave free, [3 n][0 to 6 columns], orthonormal
/// in the mass matrix (1/sqrt(kg)): N^T M N = I. Rows of held components are zero.
Eigen::MatrixXd free_rigid_modes(const ExplicitSolid& solid);

/// Nodal values ([n][3]) times the mass of their node.
Eigen::VectorXd times_masses(const ExplicitSolid& solid, const Eigen::VectorXd& values);

/// Loads less the inertia of the rigid motion that they and the held components allow ([n][3], N): they accelerate the
/// body as a whole in no direction and about no axis.
std::vector<double> without_rigid_acceleration(const ExplicitSolid& solid, std::span<const double> loads);

}  // namespace polynya::continuum
