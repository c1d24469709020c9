// Nodes beside solids that hold next to nothing while water presses on the faces around them. Where ice breaks, room
// opens at once: half of its faces' area counts as open in a step at whose beginning the nodes had no room and no mass;
// and a film that shares the pressure of the water beside it may lie before a void or air. Pressure would give the
// little mass there any speed, and the volume that it sweeps would be crushed in one step.
//
// Such a node weighs in its faces only by what it holds, so the others carry the flow. Where all nodes of a face are
// light, or have no room yet, the face itself is held: a node whose mass is the part b of a whole node's, on faces of
// which the part f is open, is f^2 / b times as stiff as a whole node in the open, and no more is let through than
// keeps this below 1 for the nodes together, f at most (sum of b) / sqrt(largest b). The rest counts as wall in this
// step: the difference of pressure over it goes to the body beside it. Free surfaces, drops, films, slits and pockets
// have more at their nodes.
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

/// Mass and room of the cells around a node, and the largest density of those that can push.
struct Around {
  double mass = 0, volume = 0, pushing_density = 0;
};
Around around(const Fluid& fluid, std::ptrdiff_t node) {
  Around sum;
  for (int corner = 0; corner < 8; ++corner) {
    const std::ptrdiff_t c = node - (corner & 1) - (corner & 2 ? fluid.grid.sy : 0) - (corner & 4 ? fluid.grid.sz : 0);
    sum.mass += fluid.material[water].mass[c] + fluid.material[air].mass[c];
    sum.volume += fluid.grid.cell_volume[c];
    if (fluid.bulk_modulus[c] > 0) sum.pushing_density = std::max(sum.pushing_density, fluid.density[c]);
  }
  return sum;
}

template <class Value>
void make_unique(std::vector<Value>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

/// The cells with wall that held fluid or will, each once, ascending.
std::vector<std::ptrdiff_t> wet_cells(const Fluid& fluid) {
  std::vector<std::ptrdiff_t> cells;
  for (const CutGeometry* cut : {&fluid.before, &fluid.after})
    for (const WallPiece& wall : cut->walls)
      if (fluid.before.volume[wall.cell] > 0 || fluid.after.volume[wall.cell] > 0) cells.push_back(wall.cell);
  make_unique(cells);
  return cells;
}

std::vector<LightNode> light_nodes(const Fluid& fluid, const std::vector<std::ptrdiff_t>& cells) {
  constexpr std::size_t together = 512;
  std::vector<std::ptrdiff_t> nodes;
  for (const std::ptrdiff_t c : cells)
    for (int corner = 0; corner < 8; ++corner)
      nodes.push_back(c + (corner & 1) + (corner & 2 ? fluid.grid.sy : 0) + (corner & 4 ? fluid.grid.sz : 0));
  make_unique(nodes);
  std::vector<std::vector<LightNode>> found((nodes.size() + together - 1) / together);
  compute::for_chunks(nodes.size(), together, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      if (!(fluid.node_fraction[nodes[n]] > 0)) continue;
      const Around sum = around(fluid, nodes[n]);
      if (sum.pushing_density == 0) continue;
      const double part = sum.mass / (sum.pushing_density * sum.volume);
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

/// A face that may have to be held.
struct Face {
  std::ptrdiff_t face;
  int axis;
  auto operator<=>(const Face&) const = default;
};

double open_part(const Fluid& fluid, std::ptrdiff_t face, int axis) {
  return 0.5 * (fluid.before.open[axis][face] + fluid.after.open[axis][face]);
}

double open_area(const Fluid& fluid, std::ptrdiff_t face, int axis) {
  int i, j, k;
  fluid.grid.position(face, i, j, k);
  const Grid& grid = fluid.grid;
  const double whole = axis == 0   ? grid.dy[j] * grid.dz[k]
                       : axis == 1 ? grid.dx[i] * grid.dz[k]
                                   : grid.dx[i] * grid.dy[j];
  return open_part(fluid, face, axis) * whole;
}

/// What a face whose nodes have these parts of a whole node's room or mass may be open.
double most_open(const std::array<double, 4>& parts) {
  const double largest = *std::max_element(parts.begin(), parts.end());
  return largest > 0 ? ((parts[0] + parts[1]) + (parts[2] + parts[3])) / std::sqrt(largest) : 0.0;
}

/// Faces around light nodes, and those of cells with wall that are opening before their nodes have room.
std::vector<Face> faces_to_weigh(const Fluid& fluid, const std::vector<std::ptrdiff_t>& cells,
                                 const std::vector<LightNode>& nodes) {
  std::vector<Face> faces;
  for (const auto& [node, part] : nodes)
    for (int axis = 0; axis < 3; ++axis)
      for (const std::ptrdiff_t mirrored : nodes_of(fluid.grid, 0, axis))
        if (open_part(fluid, node - mirrored, axis) > 0) faces.push_back({node - mirrored, axis});
  for (const std::ptrdiff_t cell : cells)
    for (int axis = 0; axis < 3; ++axis)
      for (const std::ptrdiff_t face : {cell, cell + fluid.grid.stride(axis)}) {
        std::array<double, 4> room;
        std::ranges::transform(nodes_of(fluid.grid, face, axis), room.begin(),
                               [&](std::ptrdiff_t node) { return fluid.node_fraction[node]; });
        if (open_part(fluid, face, axis) > most_open(room)) faces.push_back({face, axis});
      }
  make_unique(faces);
  return faces;
}

/// The part of a face that may be open for its nodes' sake: whole nodes are of the denser cell beside it that can push.
double most_open(const Fluid& fluid, std::ptrdiff_t face, int axis) {
  double density = 0;
  for (const std::ptrdiff_t cell : {face - fluid.grid.stride(axis), face})
    if (fluid.bulk_modulus[cell] > 0) density = std::max(density, fluid.density[cell]);
  if (density == 0) return 1;
  std::array<double, 4> mass;
  std::ranges::transform(nodes_of(fluid.grid, face, axis), mass.begin(), [&](std::ptrdiff_t node) {
    const Around sum = around(fluid, node);
    return std::min(sum.mass / (density * sum.volume), 1.0);
  });
  return most_open(mass);
}

void weigh_anew(Fluid& fluid, const Face& at) {
  const auto [face, axis] = at;
  const double sum = sum_of_fractions(fluid, face, axis), area = open_area(fluid, face, axis);
  const double kept = sum > 0 ? std::min(1.0, most_open(fluid, face, axis) / open_part(fluid, face, axis)) : 0.0;
  fluid.face_coefficient[axis][face] = sum > 0 ? kept * area / sum : 0.0;
  if (kept < 1) fluid.held_faces.push_back({face, axis, area * (1.0 - kept)});
}

}  // namespace

void hold_light_faces(Fluid& fluid) {
  fluid.held_faces.clear();
  const std::vector<std::ptrdiff_t> cells = wet_cells(fluid);
  const std::vector<LightNode> nodes = light_nodes(fluid, cells);
  const std::vector<Face> faces = faces_to_weigh(fluid, cells, nodes);
  for (const auto& [node, part] : nodes) fluid.node_fraction[node] = part / light;
  for (const Face& face : faces) weigh_anew(fluid, face);
  fluid.lightened.nodes += static_cast<long>(nodes.size());
  fluid.lightened.held_faces += static_cast<long>(fluid.held_faces.size());
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
