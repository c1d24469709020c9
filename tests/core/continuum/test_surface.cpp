#include <gtest/gtest.h>

#include "block.hpp"
#include "core/continuum/surface.hpp"

namespace polynya::continuum {
namespace {

/// 1/6 sum a . (b x c): the enclosed volume if triangles point outward.
double enclosed_volume(const HexMesh& mesh, const BoundarySurface& surface) {
  double volume = 0;
  for (std::size_t t = 0; t < surface.triangles.size() / 3; ++t) {
    const double* p[3];
    for (std::size_t k = 0; k < 3; ++k) p[k] = &mesh.nodes[3 * surface.nodes[surface.triangles[3 * t + k]]];
    volume += (p[0][0] * (p[1][1] * p[2][2] - p[1][2] * p[2][1]) + p[0][1] * (p[1][2] * p[2][0] - p[1][0] * p[2][2]) +
               p[0][2] * (p[1][0] * p[2][1] - p[1][1] * p[2][0])) /
              6;
  }
  return volume;
}

TEST(BoundarySurface, EnclosesTheVolumeOfABlock) {
  const auto mesh = tests::block({3, 4, 2}, {3, 4, 2});
  const auto surface = boundary_surface(mesh, face_neighbours(mesh), std::vector<double>(24, 1.0), {});
  EXPECT_EQ(surface.triangles.size() / 3, 2u * 2 * (3 * 4 + 4 * 2 + 2 * 3));
  EXPECT_NEAR(enclosed_volume(mesh, surface), 24, 1e-12);
}

TEST(BoundarySurface, OpensWhereAnElementIsRemoved) {
  const auto mesh = tests::block({3, 3, 3}, {3, 3, 3});
  std::vector<double> alive(27, 1.0);
  alive[13] = 0;  // the one in the middle
  const auto surface = boundary_surface(mesh, face_neighbours(mesh), alive, {});
  EXPECT_EQ(surface.triangles.size() / 3, 2u * (54 + 6));
  EXPECT_NEAR(enclosed_volume(mesh, surface), 26, 1e-12);
}

TEST(BoundarySurface, LeavesOutSymmetryPlanesOnly) {
  const auto mesh = tests::block({3, 4, 2}, {3, 4, 2});
  const std::vector<Plane> planes{{{1, 0, 0}, 0}, {{0, 1, 0}, 0}};
  const auto surface = boundary_surface(mesh, face_neighbours(mesh), std::vector<double>(24, 1.0), planes);
  EXPECT_EQ(surface.triangles.size() / 3, 2u * (2 * 3 * 4 + 4 * 2 + 2 * 3));
}

TEST(BoundarySurface, FindsNodesOfAPlane) {
  const auto mesh = tests::block({3, 4, 2}, {3, 4, 2});
  EXPECT_EQ(nodes_on_plane(mesh, {{0, 0, 1}, 2}, 1e-9).size(), 4u * 5u);
}

}  // namespace
}  // namespace polynya::continuum
