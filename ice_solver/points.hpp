#pragma once
#include <cstddef>
#include <vector>

#include "core/compute/state_archive.hpp"

namespace polynya::ice {

/// What the particle sums read and write of a set of points: particles, or intact elements seen as points.
struct Points {
  std::vector<double> position;          ///< [n][3], m
  std::vector<double> velocity;          ///< [n][3], m/s, half a step behind the position's time
  std::vector<double> stress;            ///< [n][6], Pa: xx, yy, zz, xy, yz, zx
  std::vector<double> mass;              ///< [n], kg
  std::vector<double> density;           ///< [n], kg/m^3
  std::vector<double> smoothing_length;  ///< [n], m
  std::vector<double> origin;            ///< [n][3], m, centre of the element in the reference configuration
  std::vector<double> bond_reach;        ///< [n], m, smoothing length of the element in the reference configuration
  std::vector<double> force;             ///< [n][3], N, result of the sums
  std::vector<double> viscous_force;     ///< [n][3], N, the part of it that is artificial viscosity

  std::size_t count() const { return mass.size(); }
  void resize(std::size_t count);

  POLYNYA_STATE(position, velocity, stress, mass, density, smoothing_length, origin, bond_reach, force, viscous_force)
};

inline void Points::resize(std::size_t count) {
  for (auto* vector : {&position, &velocity, &origin, &force, &viscous_force}) vector->resize(3 * count);
  for (auto* scalar : {&mass, &density, &smoothing_length, &bond_reach}) scalar->resize(count);
  stress.resize(6 * count);
}

}  // namespace polynya::ice
