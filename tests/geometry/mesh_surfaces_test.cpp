// The surfaces that the solvers send: quarter of a vehicle's hull, ice from which elements have gone.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "closure.hpp"
#include "core/continuum/surface.hpp"
#include "geometry/vehicle/vehicle_mesh.hpp"
#include "shapes.hpp"

using namespace polynya;
using geometry::CutCells;
using geometry::Cutter;
using geometry::GridLines;
using shapes::Shape;

namespace {

constexpr double cell = 2e-3;
const GridLines grid{{shapes::lines(0, 0.05, 25), shapes::lines(0, 0.05, 25), shapes::lines(-0.12, 0.04, 80)}};

Shape hull(geometry::HeadShape head, double nose) {
  const geometry::Meridian outline(head, 0.01, 0.01, 0.1);
  geometry::VehicleMeshOptions options;
  options.element_size = cell;
  options.portion = geometry::Portion::quarter;
  options.nose_position = nose;
  const geometry::VehicleMesh mesh = geometry::make_vehicle_mesh(outline, options);
  Shape shape;
  for (std::int32_t node : mesh.hull_nodes) {
    const double* x = mesh.hexahedra.nodes.data() + 3 * static_cast<std::size_t>(node);
    shape.positions.insert(shape.positions.end(), x, x + 3);
  }
  shape.triangles = mesh.hull_triangles;
  shape.rest();
  return shape;
}

continuum::HexMesh plate() {
  continuum::HexMesh mesh;
  const int n = 25, layers = 5;
  for (int k = 0; k <= layers; ++k)
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) mesh.nodes.insert(mesh.nodes.end(), {cell * i, cell * j, cell * k});
  const auto node = [&](int i, int j, int k) { return i + (n + 1) * (j + (n + 1) * k); };
  for (int k = 0; k < layers; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        for (int z = k; z <= k + 1; ++z)
          mesh.elements.insert(mesh.elements.end(),
                               {node(i, j, z), node(i + 1, j, z), node(i + 1, j + 1, z), node(i, j + 1, z)});
  return mesh;
}

Shape surface_of(const continuum::HexMesh& mesh, const std::vector<double>& alive) {
  const std::vector<continuum::Plane> planes{{{1, 0, 0}, 0}, {{0, 1, 0}, 0}};
  const auto boundary = continuum::boundary_surface(mesh, continuum::face_neighbours(mesh), alive, planes);
  Shape shape;
  for (std::int32_t node : boundary.nodes) {
    const double* x = mesh.nodes.data() + 3 * static_cast<std::size_t>(node);
    shape.positions.insert(shape.positions.end(), x, x + 3);
  }
  shape.triangles = boundary.triangles;
  shape.rest();
  return shape;
}

void expect_sound(const CutCells& cut) {
  const Closure closure = check_closure(cut, grid);
  EXPECT_LT(closure.area, 1e-12);
  EXPECT_LT(closure.pieces, 1e-12);
  EXPECT_LE(closure.fraction, 0.0);
  EXPECT_TRUE(closure.sorted);
  EXPECT_EQ(cut.loose_edges, 0);
  EXPECT_EQ(cut.corrected_faces, 0);
}

}  // namespace

TEST(MeshSurfaces, QuarterHullsAreCutOffAtThePlanesOfSymmetry) {
  for (const auto head : {geometry::HeadShape::ogive, geometry::HeadShape::hemisphere, geometry::HeadShape::ellipsoid})
    for (const double nose : {-0.004, 0.0, 0.0123}) {  // on grid planes and between
      const Shape vehicle = hull(head, nose);
      Cutter cutter(grid);
      CutCells cut;
      cutter.cut(std::array{vehicle.surface()}, cut);
      expect_sound(cut);
      // The sides left out lie on x = 0 and y = 0 and add nothing to the volume by the divergence theorem.
      EXPECT_NEAR(total_volume(cut) / shapes::volume(vehicle), 1.0, 1e-12);
    }
}

TEST(MeshSurfaces, IceThatLosesElementsKeepsItsVolumeOnTheGrid) {
  const continuum::HexMesh mesh = plate();
  std::mt19937 random(29);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const double gone : {0.0, 0.05, 0.5}) {
    std::vector<double> alive(mesh.elements.size() / 8);
    double left = 0;
    for (double& a : alive) left += a = uniform(random) < gone ? 0.0 : 1.0;
    const Shape ice = surface_of(mesh, alive);
    Cutter cutter(grid);
    CutCells cut;
    cutter.cut(std::array{ice.surface()}, cut);
    expect_sound(cut);
    EXPECT_NEAR(total_volume(cut) / (left * cell * cell * cell), 1.0, 1e-12);  // aligned: one element per cell
  }
}

TEST(MeshSurfaces, DeformedIceOfAnyTopologyCloses) {
  std::mt19937 random(31);
  std::uniform_real_distribution<double> uniform(0, 1), shift(-0.2 * cell, 0.2 * cell);
  for (int trial = 0; trial < 5; ++trial) {
    const continuum::HexMesh mesh = plate();
    std::vector<double> alive(mesh.elements.size() / 8);
    for (double& a : alive) a = uniform(random) < 0.3 ? 0.0 : 1.0;
    Shape ice = surface_of(mesh, alive);
    for (std::size_t v = 0; v < ice.vertices(); ++v)
      for (std::size_t d = 0; d < 3; ++d) {
        double& x = ice.positions[3 * v + d];
        if (d == 2 || (x != 0 && x < 0.05 - 1e-9)) x += shift(random);  // nodes stay on planes and sides
      }
    const std::array bodies{ice.surface()};
    Cutter cutter(grid);
    CutCells cut;
    cutter.cut(bodies, cut);
    expect_sound(cut);
  }
}
