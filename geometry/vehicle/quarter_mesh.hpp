#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "geometry/vehicle/hull_net.hpp"

namespace polynya::geometry {

/// Working form of the mesh of a quarter: positions (x, y, depth below the nose), hexahedra in VTK order with z =
/// -depth up, and the outward quadrilaterals of the outer hull. Coordinates on a plane of symmetry are exactly zero.
struct QuarterMesh {
  std::vector<std::array<double, 3>> nodes;
  std::vector<std::array<std::int32_t, 8>> elements;
  std::vector<std::array<std::int32_t, 4>> hull;
  std::vector<HullRegion> regions;
};

QuarterMesh make_solid_quarter(const Meridian& outline, double size, int layers);
QuarterMesh make_hollow_quarter(const Meridian& outline, double wall_thickness, double size, int layers);

/// Reflects the mesh at x = 0 (axis 0) or y = 0 (axis 1) and joins the halves at the nodes on the plane.
void mirror(QuarterMesh& mesh, int axis);

/// Numbers elements from the nose to the base and nodes in the order in which elements use them.
void sort_along_axis(QuarterMesh& mesh, double slice);

}  // namespace polynya::geometry
