#include "geometry/clipped_triangles.hpp"

namespace polynya::geometry {

void clip_packed(const std::array<LineLocator, 3>& lines, std::span<const Corner> corners,
                 std::span<const std::int32_t> triangles, std::size_t begin, std::size_t end,
                 std::vector<PieceRecord>& records) {
  TriangleClipper clipper(lines, records);
  for (std::size_t t = begin; t < end; ++t) {
    const auto corner = [&](std::size_t c) -> const Corner& {
      return corners[static_cast<std::size_t>(triangles[3 * t + c])];
    };
    clipper.cut(static_cast<std::int32_t>(t), corner(0), corner(1), corner(2));
  }
}

void ClippedChunk::clip(ClipTriangles method, const std::array<LineLocator, 3>& lines, std::span<const Corner> corners,
                        std::span<const std::int32_t> triangles, std::size_t begin, std::size_t end) {
  records.clear();
  method(lines, corners, triangles, begin, end, records);
  entry.resize(records.size());
  const auto columns_x = static_cast<std::size_t>(lines[0].intervals()) + 1;
  const std::size_t columns = columns_x * (static_cast<std::size_t>(lines[1].intervals()) + 1);
  sort(static_cast<std::int32_t>(columns_x), (columns + column_chunk - 1) / column_chunk);
}

void ClippedChunk::sort(std::int32_t columns_x, std::size_t column_chunks) {
  const auto column = [&](const PieceRecord& p) { return p.i + columns_x * p.j; };
  const auto bucket = [&](std::int32_t c) { return static_cast<std::size_t>(c) / column_chunk; };
  start.assign(column_chunks + 2, 0);
  for (const PieceRecord& piece : records) ++start[bucket(column(piece)) + 2];
  for (std::size_t c = 2; c < start.size(); ++c) start[c] += start[c - 1];
  by_columns.resize(records.size());
  for (std::size_t r = 0; r < records.size(); ++r) {  // start[c + 1] runs from the beginning of bucket c to its end
    const std::int32_t at = column(records[r]);
    by_columns[static_cast<std::size_t>(start[bucket(at) + 1]++)] = {at, static_cast<std::int32_t>(r)};
  }
  start.pop_back();
}

}  // namespace polynya::geometry
