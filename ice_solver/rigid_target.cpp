#include "ice_solver/rigid_target.hpp"

#include <algorithm>
#include <cmath>

namespace polynya::ice {

RigidTarget make_rigid_target(const IceBody& ice, double height, double factor, double step) {
  RigidTarget target;
  target.height = height;
  target.stiffness_per_mass = factor / (step * step);
  target.node_depth.assign(ice.solid.node_count(), 0.0);
  target.node_stiffness.assign(ice.solid.node_count(), 0.0);
  return target;
}

void push_back(RigidTarget& target, const IceBody& ice, std::vector<double>& node_loads,
               std::vector<double>& particle_loads) {
  const auto& solid = ice.solid;
  const Points& points = ice.particles.points;
  node_loads.assign(3 * solid.node_count(), 0.0);
  particle_loads.assign(3 * points.count(), 0.0);
  target.force = target.stored = 0;
  const auto push = [&](double stiffness, double depth) {
    target.force += stiffness * depth;
    target.stored += 0.5 * stiffness * depth * depth;
    return stiffness * depth;
  };
  for (std::size_t n = 0; n < solid.node_count(); ++n) {
    const double depth = std::max(target.height - solid.positions[3 * n + 2], 0.0);
    const double k = depth > 0 ? target.stiffness_per_mass * solid.masses[n] : 0;
    if (target.node_depth[n] > 0 && k < target.node_stiffness[n] && depth > 0)
      target.released += 0.5 * (target.node_stiffness[n] - k) * target.node_depth[n] * target.node_depth[n];
    target.node_depth[n] = depth, target.node_stiffness[n] = k;
    if (depth > 0) node_loads[3 * n + 2] = push(k, depth);
  }
  const double density = continuum::density(solid.law);
  for (std::size_t i = 0; i < points.count(); ++i) {
    const double height = points.position[3 * i + 2] - target.height;
    if (i == target.reach.size()) target.reach.push_back(std::min(0.5 * std::cbrt(points.mass[i] / density), height));
    if (height < target.reach[i])
      particle_loads[3 * i + 2] = push(target.stiffness_per_mass * points.mass[i], target.reach[i] - height);
  }
}

}  // namespace polynya::ice
