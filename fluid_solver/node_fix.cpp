// Nodes at and inside solids. A node that solid has nearly covered has next to no mass and would fly off: it follows
// its neighbours. A node inside takes the velocity of the wall. Where all cells on one side of a node are solid and the
// wall is nearly flat, it lies in or before the plane of those faces: closed faces exert no force on the node, so it
// takes the wall's normal velocity; left alone it would meet the wall with a jolt as soon as the wall moves off the
// plane. Beside an oblique wall the plane of faces closes cell by cell while the water moves outwards with the wall: to
// stop it there would be a blow. The difference of momentum goes to the body, and reaches it a span later. A node of
// mass m_f (per area) that followed a wall of mass m_s at once would make the pair swing up by sqrt(m_f / m_s) per span
// where the wall is lighter; following by the share b it is sqrt(b m_f / m_s), the root of x^2 - (1 - b) x + b m_f /
// m_s. A node in a void has no inertia at all and follows its neighbours like one that is covered; amid a void it
// rests.
#include <algorithm>
#include <cmath>
#include <optional>

#include "fluid_solver/phases.hpp"

namespace polynya::fluid {
namespace {

constexpr double covered = 0.02;
constexpr double nearly_flat = 0.98;  ///< cosine of the angle between a wall's normal and the axis

/// The pieces of wall in the cells around a node; null where there is none.
using WallsAround = std::array<const WallPiece*, 8>;

WallsAround walls_around(const Fluid& fluid, std::ptrdiff_t node) {
  WallsAround around{};
  for (int corner = 0; corner < 8; ++corner) {
    const std::int32_t wall =
        fluid.label[node - (corner & 1) - (corner & 2 ? fluid.grid.sy : 0) - (corner & 4 ? fluid.grid.sz : 0)];
    if (wall >= 0) around[7 - corner] = &fluid.after.walls[wall];
  }
  return around;
}

/// The walls around a node taken together.
struct MeanWall {
  std::array<double, 3> normal{}, velocity{};
};
std::optional<MeanWall> mean_wall(const WallsAround& around) {
  MeanWall mean;
  double sum = 0;
  for (const WallPiece* wall : around) {
    for (int body = 0; wall && body < 2; ++body) {
      const auto& a = wall->area[body];
      const double size = std::hypot(a[0], a[1], a[2]);
      sum += size;
      for (int d = 0; d < 3; ++d) {
        mean.normal[d] += a[d];
        mean.velocity[d] += size * wall->velocity[body][d];
      }
    }
  }
  const double size = std::hypot(mean.normal[0], mean.normal[1], mean.normal[2]);
  if (!(size > 0)) return {};
  for (int d = 0; d < 3; ++d) {
    mean.normal[d] /= size;
    mean.velocity[d] /= sum;
  }
  return mean;
}

/// Moves the component along the axis by a share `follow` to where the node does not move through the wall.
void follow_wall(const MeanWall& wall, int axis, double follow, std::array<double, 3>& velocity) {
  double along = 0;
  for (int d = 0; d < 3; ++d) along += (velocity[d] - wall.velocity[d]) * wall.normal[d];
  velocity[axis] -= follow * along / wall.normal[axis];
}

/// Velocity of solid around a node: of its walls, or of the first piece there is (of a cell inside solid, where no area
/// tells more).
double speed_inside(const WallsAround& around, int axis) {
  if (const auto wall = mean_wall(around)) return wall->velocity[axis];
  for (const WallPiece* wall : around) {
    if (wall) return wall->velocity[0][axis];
  }
  return 0;
}

/// By axis: true if all cells of the grid on one side of the node hold no fluid, and some on the other side do.
std::array<bool, 3> solid_on_one_side(const Fluid& fluid, std::ptrdiff_t node) {
  const Grid& grid = fluid.grid;
  std::array<std::array<int, 2>, 3> cells{}, filled{};
  int solid = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const std::ptrdiff_t c = node - (corner & 1) - (corner & 2 ? grid.sy : 0) - (corner & 4 ? grid.sz : 0);
    const bool inside = grid.inside(c), holds = inside && fluid.after.volume[c] > 0;
    solid += inside && !holds;
    for (int axis = 0; axis < 3; ++axis) {
      const int side = corner >> axis & 1;
      cells[axis][side] += inside;
      filled[axis][side] += holds;
    }
  }
  std::array<bool, 3> flat{};
  if (solid == 0) return flat;  // most nodes: no cell around is full of solid
  for (int axis = 0; axis < 3; ++axis)
    flat[axis] = cells[axis][0] > 0 && cells[axis][1] > 0 && (filled[axis][0] == 0) != (filled[axis][1] == 0);
  return flat;
}

/// The piece of wall around the node with the largest area, and its body; no wall inside solid.
struct Receiver {
  const WallPiece* wall = nullptr;
  int body = 0;
};
Receiver nearest_wall(const WallsAround& around) {
  Receiver receiver;
  double largest = 0;
  for (const WallPiece* wall : around) {
    for (int body = 0; wall && body < 2; ++body) {
      const auto& a = wall->area[body];
      const double area = a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
      if (area <= largest) continue;
      largest = area;
      receiver = {wall, body};
    }
  }
  return receiver;
}

std::optional<std::array<double, 3>> mean_of_neighbours(const Fluid& fluid, std::ptrdiff_t n) {
  const std::vector<double>& free = fluid.after.node_fraction;
  double weight = 0;
  std::array<double, 3> sum{};
  for (int axis = 0; axis < 3; ++axis) {
    for (const std::ptrdiff_t other : {n - fluid.grid.stride(axis), n + fluid.grid.stride(axis)}) {
      if (free[other] <= free[n] || fluid.node_mass[other] <= 0) continue;
      weight += free[other];
      for (int d = 0; d < 3; ++d) sum[d] += free[other] * fluid.velocity[d][other];
    }
  }
  if (weight <= 0) return {};
  for (double& component : sum) component /= weight;
  return sum;
}

struct Change {
  std::ptrdiff_t node;
  std::array<double, 3> velocity;
  Receiver receiver;
};

/// What has to change at a node, if anything.
std::optional<Change> change_of(const Fluid& fluid, std::ptrdiff_t n, double follow) {
  const bool hidden = fluid.after.node_fraction[n] < covered;
  const std::array<bool, 3> flat = solid_on_one_side(fluid, n);
  if (!hidden && !flat[0] && !flat[1] && !flat[2]) return {};
  const WallsAround around = walls_around(fluid, n);
  Change change{n, {fluid.velocity[0][n], fluid.velocity[1][n], fluid.velocity[2][n]}, nearest_wall(around)};
  bool changed = hidden;
  if (hidden) {
    const auto mean = mean_of_neighbours(fluid, n);
    for (int d = 0; d < 3; ++d) change.velocity[d] = mean ? (*mean)[d] : speed_inside(around, d);
  }
  for (int axis = 0; axis < 3; ++axis) {
    if (!flat[axis]) continue;
    if (const auto wall = mean_wall(around); wall && std::abs(wall->normal[axis]) > nearly_flat) {
      follow_wall(*wall, axis, follow, change.velocity);
      changed = true;
    }
  }
  return changed ? std::optional(change) : std::nullopt;
}

/// In the order of the nodes, whatever the number of threads.
std::vector<Change> find_changes(const Fluid& fluid, double follow) {
  constexpr std::size_t together = 512;
  const std::vector<std::ptrdiff_t>& nodes = fluid.after.nodes();
  std::vector<std::vector<Change>> found((nodes.size() + together - 1) / together);
  compute::for_chunks(nodes.size(), together, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n)
      if (const auto change = change_of(fluid, nodes[n], follow)) found[begin / together].push_back(*change);
  });
  std::vector<Change> all;
  for (const auto& some : found) all.insert(all.end(), some.begin(), some.end());
  return all;
}

}  // namespace

void calm_void_nodes(Fluid& fluid) {
  const Grid& grid = fluid.grid;
  const auto is_void = [&](std::ptrdiff_t n) {
    int i, j, k;
    grid.position(n, i, j, k);
    const double volume =
        0.125 * (grid.dx[i - 1] + grid.dx[i]) * (grid.dy[j - 1] + grid.dy[j]) * (grid.dz[k - 1] + grid.dz[k]);
    return fluid.node_mass[n] <= void_density * volume;
  };
  for (const std::ptrdiff_t n : fluid.thin_nodes) {
    if (!is_void(n)) continue;
    double weight = 0;
    std::array<double, 3> mean{};
    for (int axis = 0; axis < 3; ++axis)
      for (const std::ptrdiff_t other : {n - grid.stride(axis), n + grid.stride(axis)}) {
        if (is_void(other)) continue;
        weight += fluid.node_mass[other];
        for (int d = 0; d < 3; ++d) mean[d] += fluid.node_mass[other] * fluid.velocity[d][other];
      }
    for (int d = 0; d < 3; ++d) {
      double& u = fluid.velocity[d][n];
      const double later = weight > 0 ? mean[d] / weight : 0.0;
      fluid.account.node_fix_impulse[d] += fluid.node_mass[n] * (u - later);
      fluid.account.node_fix += 0.5 * fluid.node_mass[n] * (u * u - later * later);
      u = later;
    }
  }
}

void fix_covered_nodes(Fluid& fluid, double follow) {
  fluid.wall_impulse.assign(fluid.after.walls.size(), {});
  for (std::size_t w = 0; w < fluid.after.walls.size(); ++w)
    fluid.label[fluid.after.walls[w].cell] = static_cast<std::int32_t>(w);
  const std::vector<Change> changes = find_changes(fluid, follow);
  for (const WallPiece& wall : fluid.after.walls) fluid.label[wall.cell] = -1;
  for (const auto& [n, velocity, receiver] : changes) {
    const double mass = fluid.node_mass[n];
    for (int d = 0; d < 3; ++d) {
      double& u = fluid.velocity[d][n];
      const double impulse = mass * (u - velocity[d]);
      if (receiver.wall) fluid.wall_impulse[receiver.wall - fluid.after.walls.data()][receiver.body][d] += impulse;
      fluid.account.node_fix_impulse[d] += impulse;
      fluid.account.node_fix += 0.5 * mass * (u * u - velocity[d] * velocity[d]);
      u = velocity[d];
    }
  }
}

}  // namespace polynya::fluid
