#pragma once
#include "geometry/hull/triangle_soup.hpp"

namespace polynya::geometry {

/// A solid of uniform density 1.
struct SolidProperties {
  double volume = 0;  ///< m^3
  Point centre{};     ///< m
  /// m^5, about the centre: integral of (r.r delta_ij - r_i r_j) over the volume.
  std::array<std::array<double, 3>, 3> inertia{};
};

/// Volume, centre and inertia inside a closed surface with outward triangles, exactly: sums over the tetrahedra between
/// the triangles and a point amid them (F. Tonon 2004, J. Math. Stat. 1:8).
SolidProperties solid_properties(const TriangleSoup& surface);

}  // namespace polynya::geometry
