// Nodes beside solids that hold next to nothing while water presses on the faces around them. Where ice breaks, room
// opens at once: half of its faces' area counts as open in a step at whose beginning the nodes had no room and no mass;
// and a film that shares the pressure of the water beside it may lie before a void or air. Pressure would give the
// little mass there any speed, and the volume that it sweeps would be crushed in one step.
//
// Such a node weighs in its faces only by what it holds, so the others carry the flow. Where all nodes of a face are
// light, the face itself is held: a node whose mass is the part b of a whole node's, on faces of which the part f is
// open, is f^2 / b times as stiff as a whole node in the open, and no more is let through than keeps this below 1 for
// the nodes together, f at most (sum of b) / sqrt(largest b). The rest counts as wall in this step: the difference of
// pressure over it goes to the body beside it. Free surfaces, drops, films, slits and pockets have more at their nodes.
#include <algorithm>
#include <array>
#include <cmath>

#include "fluid_solver/phases.hpp"

namespace polynya::fluid {
namespace {

/// Of the mass that a node would have in the fluid that presses around it. Beside a flat free surface it is a half, in
/// a corner of water an eighth.
constexpr double light = 0.02;

struct LightNode {
  std::ptrdiff_t node;
  double part;  ///< its mass over that of a whole node
};

/// Mass of a node over what it would be if all around were free and as dense as the densest cell there that can push;
/// infinite where nothing pushes.
double part_of_whole(const Fluid& fluid, std::ptrdiff_t node) {
  double mass = 0, volume = 0, density = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const std::ptrdiff_t c = node - (corner & 1) - (corner & 2 ? fluid.grid.sy : 0) - (corner & 4 ? fluid.grid.sz : 0);
    mass += fluid.material[water].mass[c] + fluid.material[air].mass[c];
    volume += fluid.grid.cell_volume[c];
    if (fluid.bulk_modulus[c] > 0) density = std::max(density, fluid.density[c]);
  }
  return density > 0 ? mass / (density * volume) : 1e300;
}

/// Corners of the cells with wall that held fluid or will, each once, ascending.
std::vector<std::ptrdiff_t> nodes_beside_walls(const Fluid& fluid) {
  std::vector<std::ptrdiff_t> nodes;
  for (const CutGeometry* cut : {&fluid.before, &fluid.after})
    for (const WallPiece& wall : cut->walls) {
      const std::ptrdiff_t c = wall.cell;
      if (!(fluid.before.volume[c] > 0) && !(fluid.after.volume[c] > 0)) continue;
      for (int corner = 0; corner < 8; ++corner)
        nodes.push_back(c + (corner & 1) + (corner & 2 ? fluid.grid.sy : 0) + (corner & 4 ? fluid.grid.sz : 0));
    }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

std::vector<LightNode> light_nodes(const Fluid& fluid) {
  constexpr std::size_t together = 512;
  const std::vector<std::ptrdiff_t> nodes = nodes_beside_walls(fluid);
  std::vector<std::vector<LightNode>> found((nodes.size() + together - 1) / together);
  compute::for_chunks(nodes.size(), together, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      if (!(fluid.node_fraction[nodes[n]] > 0)) continue;
      const double part = part_of_whole(fluid, nodes[n]);
      if (part < light * fluid.node_fraction[nodes[n]]) found[begin / together].push_back({nodes[n], part});
    }
  });
  std::vector<LightNode> all;
  for (const auto& some : found) all.insert(all.end(), some.begin(), some.end());
  return all;
}

std::array<std::ptrdiff_t, 4> nodes_of(const Grid& grid, std::ptrdiff_t face, int axis) {
  const std::ptrdiff_t t1 = grid.stride(axis == 0 ? 1 : 0), t2 = grid.stride(axis == 2 ? 1 : 2);
  return {face, face + t1, face + t2, face + t1 + t2};
}

double sum_of_fractions(const Fluid& fluid, std::ptrdiff_t face, int axis) {
  double sum = 0;
  for (const std::ptrdiff_t node : nodes_of(fluid.grid, face, axis)) sum += fluid.node_fraction[node];
  return sum;
}

/// A face around light nodes, with its area while these still had the weight of their room.
struct Face {
  std::ptrdiff_t face;
  int axis;
  double area;  ///< m^2
  auto operator<=>(const Face&) const = default;
};

std::vector<Face> faces_around(const Fluid& fluid, const std::vector<LightNode>& nodes) {
  std::vector<Face> faces;
  for (const auto& [node, part] : nodes)
    for (int axis = 0; axis < 3; ++axis)
      for (const std::ptrdiff_t mirrored : nodes_of(fluid.grid, 0, axis)) {
        const std::ptrdiff_t face = node - mirrored;
        const double coefficient = fluid.face_coefficient[axis][face];
        if (coefficient > 0) faces.push_back({face, axis, coefficient * sum_of_fractions(fluid, face, axis)});
      }
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  return faces;
}

/// The part of a face that may be open for its nodes' sake.
double most_open(const Fluid& fluid, std::ptrdiff_t face, int axis) {
  double sum = 0, largest = 0;
  for (const std::ptrdiff_t node : nodes_of(fluid.grid, face, axis)) {
    const double part = std::min(part_of_whole(fluid, node), 1.0);
    sum += part;
    largest = std::max(largest, part);
  }
  return largest > 0 ? sum / std::sqrt(largest) : 0.0;
}

void weigh_anew(Fluid& fluid, const Face& face) {
  const double sum = sum_of_fractions(fluid, face.face, face.axis),
               open = 0.5 * (fluid.before.open[face.axis][face.face] + fluid.after.open[face.axis][face.face]),
               kept = std::min(1.0, most_open(fluid, face.face, face.axis) / open);
  fluid.face_coefficient[face.axis][face.face] = sum > 0 ? kept * face.area / sum : 0.0;
  if (kept < 1) fluid.held_faces.push_back({face.face, face.axis, face.area * (1.0 - kept)});
}

}  // namespace

void hold_light_faces(Fluid& fluid) {
  fluid.held_faces.clear();
  const std::vector<LightNode> nodes = light_nodes(fluid);
  const std::vector<Face> faces = faces_around(fluid, nodes);
  for (const auto& [node, part] : nodes) fluid.node_fraction[node] = part / light;
  for (const Face& face : faces) weigh_anew(fluid, face);
}

void book_held_faces(Fluid& fluid, double dt) {
  const std::vector<double>& p = fluid.predicted_pressure;
  for (const auto& [face, axis, area] : fluid.held_faces) {
    const std::ptrdiff_t below = face - fluid.grid.stride(axis);
    const double impulse = dt * (p[below] - p[face]) * area;
    fluid.account.node_fix_impulse[axis] += impulse;
    for (const std::ptrdiff_t cell : {below, face}) {
      const WallPiece* wall = fluid.after.wall_in(cell);
      if (!wall) continue;
      const auto size = [&](int body) {
        return std::hypot(wall->area[body][0], wall->area[body][1], wall->area[body][2]);
      };
      fluid.wall_impulse[wall - fluid.after.walls.data()][size(1) > size(0) ? 1 : 0][axis] += impulse;
      break;
    }
  }
}

}  // namespace polynya::fluid
