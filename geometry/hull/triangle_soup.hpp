#pragma once
#include <array>
#include <cstddef>
#include <vector>

namespace polynya::geometry {

using Point = std::array<double, 3>;
using Triangle = std::array<std::size_t, 3>;

/// Triangles as a file has them: nothing is known of how they hang together.
struct TriangleSoup {
  std::vector<Point> points;
  std::vector<Triangle> triangles;
};

}  // namespace polynya::geometry
