#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <string>

#include "geometry/vehicle/mesh_quality.hpp"
#include "geometry/vehicle/vehicle_mesh.hpp"

namespace polynya::geometry {
namespace {

constexpr double diameter = 0.01, length = 0.1;  // m

struct Head {
  const char* name;
  HeadShape shape;
  double length;
};
constexpr std::array<Head, 4> heads = {{{"ogive", HeadShape::ogive, 0.01},
                                        {"hemisphere", HeadShape::hemisphere, 0.005},
                                        {"ellipsoid", HeadShape::ellipsoid, 0.01},
                                        {"blunt ellipsoid", HeadShape::ellipsoid, 0.003}}};

Meridian outline_of(const Head& head) {
  return Meridian(head.shape, head.length, diameter, length);
}

VehicleMesh mesh_of(const Head& head, double wall, double size, Portion portion) {
  VehicleMeshOptions options;
  options.element_size = size;
  options.portion = portion;
  options.wall_thickness = wall;
  options.nose_position = -0.004;
  return make_vehicle_mesh(outline_of(head), options);
}

std::array<double, 3> hull_point(const VehicleMesh& mesh, std::int32_t vertex) {
  const double* p = &mesh.hexahedra.nodes[3 * mesh.hull_nodes[vertex]];
  return {p[0], p[1], p[2]};
}

/// Integrals over the hull's triangles: area vector, and a third of x.n dA (the enclosed volume of a closed hull).
struct HullSums {
  std::array<double, 3> area{};
  double volume = 0;
};
HullSums hull_sums(const VehicleMesh& mesh) {
  HullSums sums;
  for (std::size_t t = 0; t < mesh.hull_triangles.size(); t += 3) {
    const auto a = hull_point(mesh, mesh.hull_triangles[t]), b = hull_point(mesh, mesh.hull_triangles[t + 1]),
               c = hull_point(mesh, mesh.hull_triangles[t + 2]);
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      const double area = 0.5 * ((b[j] - a[j]) * (c[k] - a[k]) - (b[k] - a[k]) * (c[j] - a[j]));
      sums.area[i] += area;
      sums.volume += area * a[i] / 3;
    }
  }
  return sums;
}

TEST(VehicleMesh, EveryCornerOfEveryElementIsPositive) {
  for (const Head& head : heads)
    for (const double wall : {0.0, 0.4e-3, 0.65e-3, 1.2e-3})
      for (const double size : {4e-3, 2e-3, 1.5e-3, 1e-3, 0.7e-3})
        for (const Portion portion : {Portion::quarter, Portion::half, Portion::full}) {
          const MeshQuality quality = measure_quality(mesh_of(head, wall, size, portion).hexahedra);
          EXPECT_GT(quality.least_scaled_jacobian, 0.2) << head.name << ", wall " << wall << ", size " << size;
          EXPECT_GT(quality.smallest_height, 0);
        }
}

TEST(VehicleMesh, SlenderHeadsStayPositiveToo) {
  const Head slender[] = {{"ogive", HeadShape::ogive, 0.03}, {"ellipsoid", HeadShape::ellipsoid, 0.025}};
  for (const Head& head : slender)
    for (const double wall : {0.0, 0.65e-3})
      for (const double size : {2e-3, 1e-3})
        EXPECT_GT(measure_quality(mesh_of(head, wall, size, Portion::quarter).hexahedra).least_scaled_jacobian, 0.04)
            << head.name << ", wall " << wall << ", size " << size;
}

TEST(VehicleMesh, VolumeConvergesToTheExactShapeWithTheSquareOfTheSize) {
  for (const Head& head : heads)
    for (const double wall : {0.0, 0.65e-3}) {
      const Meridian outline = outline_of(head);
      const double exact = enclosed_volume(outline) - (wall > 0 ? enclosed_volume(InnerOutline(outline, wall)) : 0);
      const auto error = [&](double size) {
        return 1 - 4 * mesh_volume(mesh_of(head, wall, size, Portion::quarter).hexahedra) / exact;
      };
      const double coarse = error(1e-3), fine = error(0.25e-3);
      EXPECT_GT(fine, 0) << head.name << ": an inscribed mesh is smaller";
      EXPECT_LT(fine, 6e-4) << head.name;
      EXPECT_NEAR(std::log2(coarse / fine) / 2, 2, 0.15) << head.name << ", wall " << wall;
    }
}

TEST(VehicleMesh, QuarterHalfAndFullAreOneToTwoToFour) {
  for (const double wall : {0.0, 0.65e-3}) {
    const auto volume = [&](Portion portion) { return mesh_volume(mesh_of(heads[0], wall, 1e-3, portion).hexahedra); };
    const double quarter = volume(Portion::quarter);
    EXPECT_NEAR(volume(Portion::half) / quarter, 2, 1e-13);
    EXPECT_NEAR(volume(Portion::full) / quarter, 4, 1e-13);
  }
}

TEST(VehicleMesh, FullHullIsClosedAndOutward) {
  for (const Head& head : heads)
    for (const double wall : {0.0, 0.65e-3}) {
      const VehicleMesh mesh = mesh_of(head, wall, 1e-3, Portion::full);
      std::map<std::pair<std::int32_t, std::int32_t>, int> edges;
      for (std::size_t t = 0; t < mesh.hull_triangles.size(); t += 3)
        for (int k = 0; k < 3; ++k) ++edges[{mesh.hull_triangles[t + k], mesh.hull_triangles[t + (k + 1) % 3]}];
      for (const auto& [edge, count] : edges) {
        EXPECT_EQ(count, 1);
        EXPECT_EQ(edges.count({edge.second, edge.first}), 1u) << "every edge is walked once each way";
      }
      const HullSums sums = hull_sums(mesh);
      for (const double area : sums.area) EXPECT_NEAR(area, 0, 1e-17);
      // Triangles cut the slightly warped faces of the nose; solid elements fill the hull up to that.
      const double outer = mesh_volume(mesh_of(head, 0, 1e-3, Portion::full).hexahedra);
      EXPECT_NEAR(sums.volume / outer, 1, 3e-4) << head.name;
      EXPECT_GT(sums.volume, 0);
    }
}

TEST(VehicleMesh, HullOfASolidEnclosesItsElementsExactly) {
  // Both diagonals of every face, averaged, give the volume under the bilinear face.
  const VehicleMesh mesh = mesh_of(heads[0], 0, 1.5e-3, Portion::full);
  const double first = hull_sums(mesh).volume;
  VehicleMesh other = mesh;
  for (std::size_t t = 0; t < other.hull_triangles.size(); t += 6) {
    const std::int32_t* q = &mesh.hull_triangles[t];
    const std::int32_t corner[4] = {q[0], q[1], q[2], q[5]};
    const int order[6] = {1, 2, 3, 1, 3, 0};
    for (int k = 0; k < 6; ++k) other.hull_triangles[t + k] = corner[order[k]];
  }
  EXPECT_NEAR(0.5 * (first + hull_sums(other).volume) / mesh_volume(mesh.hexahedra), 1, 1e-13);
}

TEST(VehicleMesh, CutModelsHaveNoFaceOnTheirPlanesAndTheSameHull) {
  for (const double wall : {0.0, 0.65e-3}) {
    const HullSums full = hull_sums(mesh_of(heads[0], wall, 1e-3, Portion::full));
    for (const Portion portion : {Portion::quarter, Portion::half}) {
      const VehicleMesh mesh = mesh_of(heads[0], wall, 1e-3, portion);
      for (std::size_t t = 0; t < mesh.hull_triangles.size(); t += 3)
        for (int axis = 0; axis < 2; ++axis) {
          const bool plane = portion == Portion::quarter || axis == 1;
          bool flat = true;
          for (int k = 0; k < 3; ++k) flat = flat && hull_point(mesh, mesh.hull_triangles[t + k])[axis] == 0;
          EXPECT_FALSE(plane && flat);
        }
      // Planes through the axis add nothing to x.n dA, so the volumes are fractions of the whole.
      EXPECT_NEAR(hull_sums(mesh).volume * portions_in_whole(portion) / full.volume, 1, 1e-13);
      EXPECT_NEAR(hull_sums(mesh).area[2], 0, 1e-17);
    }
  }
}

TEST(VehicleMesh, HullNodesLieOnTheOutline) {
  for (const Head& head : heads) {
    const Meridian outline = outline_of(head);
    const VehicleMesh mesh = mesh_of(head, 0.65e-3, 1.5e-3, Portion::half);
    for (std::size_t v = 0; v < mesh.hull_nodes.size(); ++v) {
      const auto [x, y, z] = hull_point(mesh, static_cast<std::int32_t>(v));
      const double depth = -0.004 - z, radius = std::hypot(x, y);
      if (std::abs(depth - length) < 1e-12) {
        EXPECT_LE(radius, 0.5 * diameter * (1 + 1e-12));
      } else {
        EXPECT_NEAR(radius, outline.radius_at(depth), 1e-9) << head.name << " at depth " << depth;
      }
    }
  }
}

TEST(VehicleMesh, NodesAreFlagged) {
  const VehicleMesh mesh = mesh_of(heads[0], 0.65e-3, 2e-3, Portion::quarter);
  std::size_t hull = 0;
  for (std::size_t i = 0; i < mesh.node_flags.size(); ++i) {
    const double *p = &mesh.hexahedra.nodes[3 * i], depth = -0.004 - p[2];
    EXPECT_EQ((mesh.node_flags[i] & in_head) != 0, depth < 0.01 + 1e-9);
    EXPECT_EQ((mesh.node_flags[i] & on_plane_x) != 0, std::abs(p[0]) < 1e-12);
    EXPECT_EQ((mesh.node_flags[i] & on_plane_y) != 0, std::abs(p[1]) < 1e-12);
    hull += (mesh.node_flags[i] & on_hull) != 0;
  }
  EXPECT_EQ(hull, mesh.hull_nodes.size());
}

TEST(VehicleMesh, WallIsFoundForAVolumeToRounding) {
  for (const Head& head : heads)
    for (const double size : {2e-3, 1e-3}) {
      VehicleMeshOptions options;
      options.element_size = size;
      options.portion = Portion::half;
      const double wanted = 0.005 / 2700 / 2;
      options.wall_thickness = wall_thickness_for_volume(outline_of(head), options, wanted);
      EXPECT_NEAR(mesh_volume(make_vehicle_mesh(outline_of(head), options).hexahedra) / wanted, 1, 1e-12);
      EXPECT_GT(options.wall_thickness, 0.5e-3);
      EXPECT_LT(options.wall_thickness, 0.7e-3);
    }
}

TEST(VehicleMesh, ImpossibleVolumesAreRefused) {
  VehicleMeshOptions options;
  options.element_size = 2e-3;
  EXPECT_THROW(wall_thickness_for_volume(outline_of(heads[0]), options, 1e-5), std::invalid_argument);
  EXPECT_THROW(wall_thickness_for_volume(outline_of(heads[0]), options, 1e-12), std::invalid_argument);
  options.element_size = 0;
  EXPECT_THROW(make_vehicle_mesh(outline_of(heads[0]), options), std::invalid_argument);
}

}  // namespace
}  // namespace polynya::geometry
