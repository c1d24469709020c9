#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "geometry/cut_cells.hpp"

/// The cut by CGAL's exact numbers: slow, and independent of the clipping that every step uses.
namespace polynya::geometry {

/// What one body takes from one cell.
struct ExactCell {
  double volume = 0;             ///< m^3
  std::array<double, 3> area{};  ///< m^2, outward of the body; wall lying exactly on a side of the cell counts
};

/// Intersects the triangles of one body with a cell and with the column above it, exactly; rounds once, at the end.
/// The vertices are placed as by the Cutter (coincidence with walls of the grid, open edges).
ExactCell exact_cut(const GridLines& grid, std::int64_t cell, const BodySurface& body);

/// Recuts up to `count` cells with wall, drawn with `seed`, and returns the largest difference of a body's volume in a
/// cell over the volume of the cell.
double verify_sample(const CutCells& cut, std::span<const BodySurface> bodies, const GridLines& grid,
                     std::uint64_t seed, std::size_t count);

/// Replaces the volumes that the cut is not certain of by exact ones; returns how many.
std::size_t recut_uncertain(CutCells& cut, std::span<const BodySurface> bodies, const GridLines& grid);

/// The cutter's clipping in exact numbers, for Cutter::set_method: what a triangle leaves in a cell is rounded once.
/// Some two hundred times slower than doubles.
void clip_exactly(const std::array<LineLocator, 3>& lines, std::span<const BasicCorner<double>> corners,
                  std::span<const std::int32_t> triangles, std::size_t begin, std::size_t end,
                  std::vector<PieceRecord>& records);

/// The cutter's search for surfaces inside other bodies in exact numbers, for Cutter::set_exact_union.
bool add_below_exactly(const JointCell& cell, const JointTriangle& piece, std::span<const JointTriangle> others,
                       JointSum& sum);

}  // namespace polynya::geometry
