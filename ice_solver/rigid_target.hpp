#pragma once
#include <vector>

#include "ice_solver/ice_body.hpp"

namespace polynya::ice {

/// A rigid, smooth plate that fills z < height: nodes that enter it, and particles that come nearer than half their
/// size, are pushed back by springs k d, k = factor m / step^2 with the step of the start.
struct RigidTarget {
  double height = 0;                   ///< m
  double stiffness_per_mass = 0;       ///< 1/s^2
  std::vector<double> node_depth;      ///< [nodes], m, at the last push
  std::vector<double> node_stiffness;  ///< [nodes], N/m, then
  std::vector<double> reach;      ///< [particles], m: at birth at most their height, so that they start without force
  double stored = 0;              ///< J, in the springs
  double released = 0;            ///< J, held by springs whose mass left
  double force = 0, impulse = 0;  ///< N and N s, upward, on the modelled part

  POLYNYA_STATE(height, stiffness_per_mass, node_depth, node_stiffness, reach, stored, released, force, impulse)
};

/// factor: of m / step^2, as contact.stiffness_factor.
RigidTarget make_rigid_target(const IceBody& ice, double height, double factor, double step);

/// Forces at the present positions: node_loads [nodes][3], particle_loads [particles][3], N. They act for
/// `acting_time` (s), as advance_velocities lets them.
void push_back(RigidTarget& target, const IceBody& ice, std::vector<double>& node_loads,
               std::vector<double>& particle_loads);
/// Counts the impulse of the last forces.
inline void book_impulse(RigidTarget& target, double acting_time) {
  target.impulse += acting_time * target.force;
}

}  // namespace polynya::ice
