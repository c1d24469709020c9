#pragma once
#include <string>

#include "geometry/hull/solid_properties.hpp"
#include "geometry/hull/triangle_soup.hpp"

namespace polynya::geometry {

/// What may be done to a surface that is not the boundary of a body.
enum class Repair {
  none,  ///< nothing: it must be right as it is, but for equal points of an STL file
  safe,  ///< what moves nothing: double points and triangles, triangles without area, orientation
  wrap   ///< where that is not enough, a surface around it (CGAL's alpha wrapping)
};

struct HullOptions {
  double scale = 1;        ///< m per unit of the file
  std::string nose = "z";  ///< direction of the nose in the file: x, -x, y, -y, z or -z
  Repair repair = Repair::safe;
  double wrap_alpha = 0;   ///< m; holes and gaps narrower than twice this are closed; 0: a fiftieth of the diagonal
  double wrap_offset = 0;  ///< m; distance of the wrap from the surface; 0: a thirtieth of wrap_alpha
};

struct ImportedHull {
  TriangleSoup outer;           ///< m, outward; nose up, its foremost plane at z = 0, x = y = 0 amid the box
  SolidProperties solid;        ///< between the outer surface and the cavities, in the same place
  double outer_volume = 0;      ///< m^3
  std::size_t cavities = 0;     ///< closed surfaces inside
  double wrapped_distance = 0;  ///< m, farthest that the wrap lies from the file's surface or this from it; 0: no wrap
  std::string note;             ///< what was found and done, whole sentences
};

/// Reads, checks, repairs and places a hull. GeometryError: one sentence with the file, what is wrong and where (in the
/// coordinates of the file).
ImportedHull import_hull(const std::string& path, const HullOptions& options);

/// The outer surface of a body from a file, where the file has it, in m (`scale` m per unit of the file): checked, and
/// repaired as by Repair::safe. GeometryError likewise.
TriangleSoup import_body(const std::string& path, double scale);

/// Halves edges longer than this (m) until there are none; the surface stays where it is.
void split_long_edges(TriangleSoup& surface, double longest);

}  // namespace polynya::geometry
