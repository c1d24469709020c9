#include "geometry/joint_pieces.hpp"

#include <limits>

#include "geometry/joint_clip.hpp"

namespace polynya::geometry {
namespace {

constexpr double beside_plane = 1e-14, outward = 5e-15, own = 3e-16;  // of the smallest cell

/// Between -1 and 1, the same in every run (splitmix64, Steele et al. 2014).
double scattered(std::uint64_t number) {
  number += 0x9e3779b97f4a7c15;
  number = (number ^ (number >> 30)) * 0xbf58476d1ce4e5b9;
  number = (number ^ (number >> 27)) * 0x94d049bb133111eb;
  return 0x1p-52 * static_cast<double>((number ^ (number >> 31)) >> 11) - 1.0;
}

double smallest_width(const GridLines& grid) {
  double least = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis)
    for (std::int64_t c = 0; c < grid.cells(axis); ++c) least = std::min(least, grid.width(axis, c));
  return least;
}

std::vector<std::array<double, 3>> vertex_normals(const BodySurface& body, std::span<const Corner> corners) {
  std::vector<std::array<double, 3>> normals(corners.size(), {0, 0, 0});
  for (std::size_t t = 0; t < body.triangles.size(); t += 3) {
    const auto vertex = [&](std::size_t c) { return static_cast<std::size_t>(body.triangles[t + c]); };
    const auto n = JointClip<double>::normal_of(corners[vertex(0)].x, corners[vertex(1)].x, corners[vertex(2)].x);
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t d = 0; d < 3; ++d) normals[vertex(c)][d] += n[d];
  }
  return normals;
}

}  // namespace

bool add_below_packed(const JointCell& cell, const JointTriangle& piece, std::span<const JointTriangle> others,
                      JointSum& sum) {
  return JointClip<double>(cell).add_below(piece, others, sum);
}

std::vector<std::array<double, 3>> joint_shifts(const GridLines& grid, const std::array<LineLocator, 3>& lines,
                                                const BodySurface& body, std::span<const Corner> corners,
                                                std::size_t number) {
  const double width = smallest_width(grid);
  std::vector<std::array<double, 3>> shifts = vertex_normals(body, corners);
  for (std::size_t v = 0; v < corners.size(); ++v) {
    std::array<double, 3>& shift = shifts[v];
    const double length = std::sqrt(shift[0] * shift[0] + shift[1] * shift[1] + shift[2] * shift[2]);
    for (std::size_t d = 0; d < 3; ++d) {
      shift[d] *= length > 0 ? outward / (static_cast<double>(number + 1) * length) : 0.0;
      shift[d] += own * scattered(3 * v + d + (static_cast<std::uint64_t>(number) << 40));
      const std::int32_t slab = corners[v].slab[d], last = lines[d].intervals();
      if (slab < last && corners[v].x[d] == lines[d].line(slab + 1)) shift[d] -= beside_plane;
      if (slab >= 0 && corners[v].x[d] == lines[d].line(slab)) shift[d] += beside_plane;
      shift[d] *= width;
    }
  }
  return shifts;
}

}  // namespace polynya::geometry
