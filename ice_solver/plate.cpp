#include "ice_solver/plate.hpp"

#include <algorithm>
#include <stdexcept>

namespace polynya::ice {
namespace {

void require_ascending(const std::vector<double>& line, const char* name) {
  if (line.size() < 2 || !std::is_sorted(line.begin(), line.end(), [](double a, double b) { return a <= b; }))
    throw std::invalid_argument(std::string("grid line ") + name + " of the ice needs at least two ascending nodes");
}

/// The four lateral planes that are not symmetry planes, normals outward.
std::vector<continuum::Plane> outer_planes(const continuum::HexMesh& mesh, SymmetryPlanes planes) {
  std::vector<continuum::Plane> outer;
  for (int axis = 0; axis < 2; ++axis) {
    double low = mesh.nodes[static_cast<std::size_t>(axis)], high = low;
    for (std::size_t n = 0; n < mesh.node_count(); ++n) {
      low = std::min(low, mesh.nodes[3 * n + axis]);
      high = std::max(high, mesh.nodes[3 * n + axis]);
    }
    continuum::Plane plane;
    plane.normal[static_cast<std::size_t>(axis)] = 1;
    plane.offset = high;
    outer.push_back(plane);
    if (axis == 0 ? planes.x : planes.y) continue;
    plane.normal[static_cast<std::size_t>(axis)] = -1;
    plane.offset = -low;
    outer.push_back(plane);
  }
  return outer;
}

constexpr double tolerance = 1e-9;  // m, far below any element and far above round-off

}  // namespace

Sides sides_from_name(const std::string& name) {
  if (name == "non_reflecting") return Sides::non_reflecting;
  if (name == "free") return Sides::free;
  if (name == "clamped") return Sides::clamped;
  if (name == "clamped_ends") return Sides::clamped_ends;
  throw std::invalid_argument("ice.sides is \"" + name +
                              "\"; it must be non_reflecting, free, clamped or clamped_ends");
}

continuum::HexMesh plate_mesh(const std::vector<double>& x, const std::vector<double>& y,
                              const std::vector<double>& z) {
  require_ascending(x, "x"), require_ascending(y, "y"), require_ascending(z, "z");
  continuum::HexMesh mesh;
  for (double b : y)
    for (double a : x)
      for (double c : z) mesh.nodes.insert(mesh.nodes.end(), {a, b, c});
  const auto node = [&](std::size_t i, std::size_t j, std::size_t k) {
    return static_cast<std::int32_t>(k + z.size() * (i + x.size() * j));
  };
  for (std::size_t j = 0; j + 1 < y.size(); ++j)
    for (std::size_t i = 0; i + 1 < x.size(); ++i)
      for (std::size_t k = 0; k + 1 < z.size(); ++k)
        mesh.elements.insert(mesh.elements.end(), {node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k),
                                                   node(i, j + 1, k), node(i, j, k + 1), node(i + 1, j, k + 1),
                                                   node(i + 1, j + 1, k + 1), node(i, j + 1, k + 1)});
  return mesh;
}

std::vector<continuum::Plane> excluded_planes(SymmetryPlanes planes) {
  std::vector<continuum::Plane> list;
  if (planes.x) list.push_back({{1, 0, 0}, 0});
  if (planes.y) list.push_back({{0, 1, 0}, 0});
  return list;
}

void constrain_plate(continuum::ExplicitSolid& plate, SymmetryPlanes planes, Sides sides) {
  for (const continuum::Plane& plane : excluded_planes(planes)) {
    const std::uint8_t component = plane.normal[0] != 0 ? 1 : 2;
    for (std::int32_t node : continuum::nodes_on_plane(plate.mesh, plane, tolerance))
      plate.fixed[static_cast<std::size_t>(node)] |= component;
  }
  if (sides == Sides::free) return;
  for (const continuum::Plane& plane : outer_planes(plate.mesh, planes)) {
    if (sides == Sides::non_reflecting) {
      continuum::add_non_reflecting_boundary(plate, plane);
    } else {
      const std::uint8_t components = sides == Sides::clamped_ends && plane.normal[1] != 0 ? 2 : 7;
      for (std::int32_t node : continuum::nodes_on_plane(plate.mesh, plane, tolerance))
        plate.fixed[static_cast<std::size_t>(node)] |= components;
    }
  }
}

void hold_supports(continuum::ExplicitSolid& body, std::span<const Support> supports) {
  for (const Support& support : supports)
    for (const std::int32_t node : support.nodes) body.fixed[static_cast<std::size_t>(node)] |= support.components;
}

void release_waves(continuum::ExplicitSolid& body, std::span<const Support> supports) {
  for (const Support& support : supports)
    if (support.non_reflecting) continuum::add_non_reflecting_boundary(body, support.nodes);
}

void hold_rim(continuum::ExplicitSolid& plate, SymmetryPlanes planes, double width) {
  double top = plate.mesh.nodes[2];
  for (std::size_t n = 0; n < plate.node_count(); ++n) top = std::max(top, plate.mesh.nodes[3 * n + 2]);
  const auto sides = outer_planes(plate.mesh, planes);
  for (std::size_t n = 0; n < plate.node_count(); ++n) {
    const double* at = &plate.mesh.nodes[3 * n];
    const bool in_rim = std::any_of(sides.begin(), sides.end(), [&](const continuum::Plane& side) {
      return side.normal[0] * at[0] + side.normal[1] * at[1] > side.offset - width - tolerance;
    });
    if (in_rim && at[2] > top - tolerance) plate.fixed[n] = 7;
  }
}

}  // namespace polynya::ice
