#include "structure_solver/launch.hpp"

#include <cmath>

namespace polynya::structure {

Eigen::Vector3d Launch::axis() const {
  if (angle == 0) return {0, 0, 1};
  return {std::sin(angle), 0, std::cos(angle)};
}

void Launch::place(std::span<double> points) const {
  if (angle == 0 && offset_x == 0 && offset_y == 0) return;
  const double cosine = std::cos(angle), sine = std::sin(angle);
  for (std::size_t i = 0; i + 2 < points.size(); i += 3) {
    const double x = points[i], z = points[i + 2] - nose_position;
    points[i] = cosine * x + sine * z + offset_x;
    points[i + 1] += offset_y;
    points[i + 2] = cosine * z - sine * x + nose_position;
  }
}

}  // namespace polynya::structure
