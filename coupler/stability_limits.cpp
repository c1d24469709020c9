#include "coupler/stability_limits.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "core/contact/vector3.hpp"
#include "core/scene/estimate.hpp"

namespace polynya::coupler {
namespace {

/// Mass per wetted area of every vertex, 0 for particles. Water resists the motion of a vertex by rho c sum(A n n^T):
/// its largest eigenvalue over rho c is the area that counts, so the three faces at a corner do not add up.
std::vector<double> vertex_areal_mass(const SolidSide& side) {
  using contact::operator-;
  std::vector<Eigen::Matrix3d> area(side.vertices(), Eigen::Matrix3d::Zero());
  for (std::size_t t = 0; t < side.triangles.size() / 3; ++t) {
    const std::int32_t* v = &side.triangles[3 * t];
    const contact::Vector3 a = contact::row(side.positions, v[0]), b = contact::row(side.positions, v[1]),
                           c = contact::row(side.positions, v[2]);
    const contact::Vector3 cross = contact::cross(b - a, c - a);
    const double length = contact::norm(cross);
    if (length == 0) continue;
    const Eigen::Vector3d normal(cross[0] / length, cross[1] / length, cross[2] / length);
    for (int i = 0; i < 3; ++i) area[v[i]] += length / 6 * normal * normal.transpose();
  }
  std::vector<double> areal_mass(side.vertices(), 0.0);
  for (std::size_t v = 0; v < area.size(); ++v) {
    if (area[v].trace() <= 0) continue;
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
    solver.computeDirect(area[v], Eigen::EigenvaluesOnly);
    areal_mass[v] = side.masses[v] / solver.eigenvalues()(2);
  }
  return areal_mass;
}

/// In the last layer of cells along an outer side of the grid. Planes of symmetry (lines that start at 0) do not count.
bool on_outer_side(const geometry::GridLines& grid, std::int64_t cell) {
  const auto position = grid.cell_position(cell);
  for (int axis = 0; axis < 2; ++axis) {
    if (position[axis] == grid.cells(axis) - 1) return true;
    if (position[axis] == 0 && grid.lines[axis].front() < 0) return true;
  }
  return false;
}

double smallest_face(const geometry::GridLines& grid, std::int64_t cell) {
  const auto p = grid.cell_position(cell);
  const double x = grid.width(0, p[0]), y = grid.width(1, p[1]), z = grid.width(2, p[2]);
  return std::min({x * y, y * z, z * x});
}

}  // namespace

LightestWall lightest_wall(const Conversation& conversation, const geometry::CutCells& cut) {
  const geometry::GridLines& grid = conversation.fluid->grid;
  LightestWall lightest;
  for (const SolidSide& side : conversation.solids) {
    const std::vector<double> vertex_mass = vertex_areal_mass(side);
    std::vector<double> area(cut.cell.size(), 0.0), mass(cut.cell.size(), 0.0);
    for (const geometry::WallPiece& piece : cut.pieces) {
      if (piece.body != static_cast<std::int32_t>(side.body)) continue;
      const double size = contact::norm(piece.area);
      const std::int32_t* v = &side.triangles[3 * static_cast<std::size_t>(piece.triangle)];
      area[piece.entry] += size;
      for (int i = 0; i < 3; ++i) mass[piece.entry] += size * piece.weights[i] * vertex_mass[v[i]];
    }
    for (std::size_t e = 0; e < cut.cell.size(); ++e) {
      if (area[e] <= 0.1 * smallest_face(grid, cut.cell[e]) || on_outer_side(grid, cut.cell[e])) continue;
      const double areal = mass[e] / area[e];
      if (areal < lightest.areal_mass) lightest = {areal, cut.cell[e], side.body};
    }
  }
  return lightest;
}

double lag_limit(const LightestWall& wall, const scene::Scene& scene) {
  const scene::MaterialCard& water = scene.material(scene.fluid->water);
  return lag_factor * wall.areal_mass /
         (water.value("density") * scene::sound_speed(water, scene.fluid->atmospheric_pressure));
}

}  // namespace polynya::coupler
