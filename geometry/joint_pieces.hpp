#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/cut_cells.hpp"
#include "geometry/placed_surface.hpp"

/// Where one body's surface lies inside another body. Internal to the room.
///
/// As the cut itself, this classifies no point and follows no line of intersection: a point of a surface is inside
/// another body when more of that body's surface above it faces upward than downward. So a piece's part inside is a sum
/// over the triangles above it, of the convex parts of the piece that lie below each of them.
namespace polynya::geometry {

/// A vertex as the cut has placed it, and by how much it is shifted so that nothing coincides (joint_shifts).
struct JointVertex {
  std::array<double, 3> x, shift;
};
struct JointTriangle {
  std::array<JointVertex, 3> corner;
  std::array<std::int32_t, 3> vertex;
};
/// The topmost cell has no upper end: what lies above the grid belongs to it.
struct JointCell {
  std::array<double, 3> low, high;
  std::array<bool, 2> last{};  ///< cuts along its upper x- or y-plane are summed, not along its lower ones
};

/// Sums over parts of one triangle in one cell, as in PieceRecord.
struct JointSum {
  std::array<double, 3> area{}, weighted{};  ///< m^2; barycentric coordinates integrated over it
  double wall = 0, height_moment = 0;
  double x_extent = 0, x_moment = 0, y_extent = 0, y_moment = 0;
};

/// Adds what of `piece` in the cell lies below `others` (JointClip::add_below).
bool add_below_packed(const JointCell& cell, const JointTriangle& piece, std::span<const JointTriangle> others,
                      JointSum& sum);

/// Surfaces in contact share planes, edges and corners. Vertices on a plane of the grid are shifted to the side they
/// are assigned to, those of the first of two bodies outward besides, and all by something of their own: by 1e-14,
/// 5e-15 and 3e-16 of the smallest cell. Then surfaces cross or miss each other, and neighbours agree about it. Faces
/// that lie on each other face to face lie inside the other body; of two that face alike the second one's does.
std::vector<std::array<double, 3>> joint_shifts(const GridLines& grid, const std::array<LineLocator, 3>& lines,
                                                const BodySurface& body, std::span<const Corner> corners,
                                                std::size_t number);

}  // namespace polynya::geometry
