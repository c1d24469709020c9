// Nodes that solid has nearly covered have next to no mass and would fly off: they follow their neighbours, and the
// difference of momentum goes to the body (OVERLAP 13). Nodes inside the solid take the velocity of its wall.
#include <algorithm>

#include "fluid_solver/phases.hpp"

namespace polynya::fluid {
namespace {

constexpr double covered = 0.02;

std::array<double, 3> wall_velocity(const WallPiece& wall) {
  for (const auto& [area, velocity] : {std::pair{wall.area[0], wall.velocity[0]}, std::pair{wall.area[1], wall.velocity[1]}}) {
    if (area[0] != 0 || area[1] != 0 || area[2] != 0) return velocity;
  }
  return wall.velocity[0];
}

}  // namespace

void fix_covered_nodes(Fluid& fluid) {
  const Grid& grid = fluid.grid;
  const std::vector<double>& free = fluid.after.node_fraction;
  std::vector<std::pair<std::ptrdiff_t, const WallPiece*>> nodes;
  for (const WallPiece& wall : fluid.after.walls) {
    for (int corner = 0; corner < 8; ++corner) {
      const std::ptrdiff_t n = wall.cell + (corner & 1) + (corner & 2 ? grid.sy : 0) + (corner & 4 ? grid.sz : 0);
      if (free[n] < covered) nodes.emplace_back(n, &wall);
    }
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end(), [](const auto& a, const auto& b) { return a.first == b.first; }), nodes.end());
  std::vector<std::array<double, 3>> velocity(nodes.size());
  for (std::size_t m = 0; m < nodes.size(); ++m) {
    const std::ptrdiff_t n = nodes[m].first;
    double weight = 0;
    std::array<double, 3> sum{};
    for (int axis = 0; axis < 3; ++axis) {
      for (const std::ptrdiff_t other : {n - grid.stride(axis), n + grid.stride(axis)}) {
        if (free[other] < covered || fluid.node_mass[other] <= 0) continue;
        weight += free[other];
        for (int d = 0; d < 3; ++d) sum[d] += free[other] * fluid.velocity[d][other];
      }
    }
    if (weight > 0) {
      for (int d = 0; d < 3; ++d) velocity[m][d] = sum[d] / weight;
    } else {
      velocity[m] = wall_velocity(*nodes[m].second);
    }
  }
  for (std::size_t m = 0; m < nodes.size(); ++m) {
    const std::ptrdiff_t n = nodes[m].first;
    const double mass = fluid.node_mass[n];
    for (int d = 0; d < 3; ++d) {
      double& u = fluid.velocity[d][n];
      fluid.account.node_fix_impulse[d] += mass * (u - velocity[m][d]);
      fluid.account.node_fix += 0.5 * mass * (u * u - velocity[m][d] * velocity[m][d]);
      u = velocity[m][d];
    }
  }
}

}  // namespace polynya::fluid
