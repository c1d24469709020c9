#pragma once
#include <cstdint>
#include <span>
#include <string>

namespace polynya::geometry {

/// What a surface is worth as the outline of a body.
struct SurfaceCheck {
  bool manifold = false;  ///< every edge between two triangles at most, orientations agree
  bool closed = false;
  bool self_intersects = false;  ///< known only of a manifold surface
  bool outward = false;          ///< of a closed surface: normals point out of the body
  double volume = 0;             ///< m^3, of a closed surface; negative when the normals point inward
  std::string text;              ///< whole sentences about what is wrong; empty when nothing is

  bool good() const { return text.empty(); }
};

/// Checks a surface at import: positions [vertices][3] in m, triangles [triangles][3].
SurfaceCheck check_surface(std::span<const double> positions, std::span<const std::int32_t> triangles);

}  // namespace polynya::geometry
