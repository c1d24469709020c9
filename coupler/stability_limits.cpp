#include "coupler/stability_limits.hpp"

#include <algorithm>
#include <limits>

#include "core/contact/vector3.hpp"

namespace polynya::coupler {
namespace {

/// Within half a cell of an outer side of the grid. Planes of symmetry (a grid that starts at 0) do not count.
bool beside_wall(const contact::Vector3& p, const geometry::GridLines& grid) {
  for (int axis = 0; axis < 2; ++axis) {
    const std::vector<double>& line = grid.lines[static_cast<std::size_t>(axis)];
    if (p[axis] > line.back() - 0.5 * grid.width(axis, grid.cells(axis) - 1)) return true;
    if (line.front() < 0 && p[axis] < line.front() + 0.5 * grid.width(axis, 0)) return true;
  }
  return false;
}

}  // namespace

double least_areal_mass(const SolidSide& side, const geometry::GridLines& grid) {
  using contact::operator-;
  std::vector<double> area(side.vertices(), 0.0);
  for (std::size_t t = 0; t < side.triangles.size() / 3; ++t) {
    const std::int32_t* v = &side.triangles[3 * t];
    const contact::Vector3 a = contact::row(side.positions, v[0]), b = contact::row(side.positions, v[1]),
                           c = contact::row(side.positions, v[2]);
    const double third = contact::norm(contact::cross(b - a, c - a)) / 6;
    for (int i = 0; i < 3; ++i) area[v[i]] += third;
  }
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t v = 0; v < side.vertices(); ++v)
    if (area[v] > 0 && !beside_wall(contact::row(side.positions, v), grid))
      least = std::min(least, side.masses[v] / area[v]);
  return least;
}

double lag_limit(const Conversation& conversation, const scene::Scene& scene) {
  const scene::MaterialCard& water = scene.material(scene.fluid->water);
  const double impedance = water.values.at("density") * water.values.at("sound_speed");
  double least = std::numeric_limits<double>::infinity();
  for (const SolidSide& side : conversation.solids)
    least = std::min(least, least_areal_mass(side, conversation.fluid->grid));
  return 0.5 * least / impedance;
}

}  // namespace polynya::coupler
