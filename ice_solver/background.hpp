#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "core/continuum/explicit_solid.hpp"
#include "ice_solver/points.hpp"

namespace polynya::ice {

/// Living elements near particles, seen by the sums as points at their centres with their own mass and stress.
/// This is the bond, and the contact, between debris and intact ice.
struct Background {
  std::vector<std::int32_t> elements;  ///< ascending
  Points points;

  POLYNYA_STATE(elements, points)
};

/// Chooses the living elements whose centre may lie within `reach` (m) of a particle (more are chosen, none is missed)
/// and fills in what stays the same: mass and smoothing length (at most `largest_smoothing_length`).
void select_background(Background& background, const continuum::ExplicitSolid& solid, const Points& particles,
                       double reach, double largest_smoothing_length);

/// Present positions, velocities, densities and stresses.
void refresh_background(Background& background, const continuum::ExplicitSolid& solid);

/// Adds the force on each point to the eight nodes of its element, an eighth each. nodal_force: [nodes][3], N.
void spread_background_forces(const Background& background, const continuum::ExplicitSolid& solid,
                              std::vector<double>& nodal_force);

/// Centre of an element in the reference configuration, m.
std::array<double, 3> reference_centre(const continuum::ExplicitSolid& solid, std::size_t element);

/// 1.2 V^(1/3), m.
double smoothing_length_of(double volume);

}  // namespace polynya::ice
