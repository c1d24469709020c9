#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "geometry/vehicle/vehicle_profile.hpp"

namespace polynya::geometry {

enum class HullRegion : std::uint8_t { head = 0, cylinder = 1, base = 2 };

/// How a quarter of the body is divided. A square patch of `patch` x `patch` faces sits on the nose; around it run
/// rows of 2 `patch` faces, `head_rows` down to the shoulder and `cylinder_rows` down to the base.
struct HullDivision {
  int patch = 0, head_rows = 0, cylinder_rows = 0, base_rows = 0;
  int columns() const { return 2 * patch; }
  int rows() const { return head_rows + cylinder_rows; }
};

/// Division for faces about `size` (m) wide.
HullDivision divide_hull(const Meridian& outline, double size);

/// A node of the hull: depth below the nose (m), distance from the axis (m) and direction (cosine, sine) about it.
struct HullNode {
  double arc = 0;  ///< arc length from the nose, head nodes only
  double depth = 0, radius = 0;
  double cosine = 1, sine = 0;
};

/// Structured nodes of a quarter (x >= 0, y >= 0) of the hull. On the planes x = 0 and y = 0 the cosine or the sine is
/// exactly zero.
struct HullNet {
  HullDivision division;
  std::vector<HullNode> nodes;
  std::vector<std::array<std::int32_t, 4>> quads;  ///< counter-clockwise seen from outside
  std::vector<HullRegion> regions;                 ///< of the quads

  /// Node of the nose patch, 0 <= i, j <= division.patch.
  std::int32_t patch_node(int i, int j) const { return i * (division.patch + 1) + j; }
  /// Node in a row around the body: row 0 is the edge of the nose patch, row division.rows() the edge of the base.
  std::int32_t ring_node(int column, int row) const;
};

/// Head and cylinder; with_base adds the base (rows inwards, then a square patch).
HullNet make_hull_net(const Meridian& outline, const HullDivision& division, bool with_base);

/// Position of node (i, j) of an n x n grid mapped to the unit quarter disc: halfway between a square and concentric
/// circles, so that its outer corner opens to about 135 degrees. Its edge midpoint lies at distance 1 from the centre.
std::array<double, 2> rounded_square(int i, int j, int n);

}  // namespace polynya::geometry
