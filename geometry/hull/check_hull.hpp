#pragma once
#include <string>

#include "geometry/hull/triangle_soup.hpp"

namespace polynya::geometry {

/// The boundary of one body.
struct BodyBoundary {
  TriangleSoup outer;                  ///< outward
  std::vector<TriangleSoup> cavities;  ///< normals into the cavity, out of the material
  std::string note;                    ///< what was repaired, whole sentences; empty: nothing
};

/// Makes closed, oriented surfaces without intersections of a soup, moving no point by more than a millionth of the
/// diagonal; `repair` false: refuses where anything would have to be done. GeometryError says what is wrong and where.
BodyBoundary make_boundary(TriangleSoup soup, bool repair);

/// A closed surface around any soup (Portaneri et al. 2022, ACM Trans. Graph. 41:127) and the farthest distance between
/// both. Lengths in the unit of the points.
struct Wrap {
  TriangleSoup surface;
  double farthest = 0;
};
Wrap wrap_soup(const TriangleSoup& soup, double alpha, double offset);

}  // namespace polynya::geometry
