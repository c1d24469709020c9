#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/clip.hpp"
#include "geometry/cut_cells.hpp"

/// Clipped triangles on their way to the columns of cells. Internal to the room.
namespace polynya::geometry {

inline constexpr std::size_t triangle_chunk = 512;
inline constexpr std::size_t column_chunk = 128;  ///< columns are numbered i + (nx + 1) * j

/// The method of the production path: doubles.
void clip_packed(const std::array<LineLocator, 3>& lines, std::span<const Corner> corners,
                 std::span<const std::int32_t> triangles, std::size_t begin, std::size_t end,
                 std::vector<PieceRecord>& records);

/// The records of one chunk of triangles, and which of them lie in which chunk of columns.
struct ClippedChunk {
  struct InColumn {
    std::int32_t column, record;
  };
  std::vector<PieceRecord> records;  ///< in the order of the triangles
  std::vector<std::int64_t> entry;   ///< [records], where the cell went in the sorted output; -1: no wall of any cell
  std::vector<InColumn> by_columns;  ///< by chunk of columns, there in the order of the triangles
  std::vector<std::int32_t> start;   ///< [chunks of columns + 1], in by_columns

  /// Cuts the triangles [begin, end) of a surface ([triangles][3] vertices) by `method`.
  void clip(ClipTriangles method, const std::array<LineLocator, 3>& lines, std::span<const Corner> corners,
            std::span<const std::int32_t> triangles, std::size_t begin, std::size_t end);

 private:
  void sort(std::int32_t columns_x, std::size_t column_chunks);
};

}  // namespace polynya::geometry
