#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "geometry/clipped_triangles.hpp"
#include "geometry/cut_cells.hpp"

/// From the records of clipped triangles to cells and faces, one column of cells after the other. Internal to the room.
namespace polynya::geometry {

/// Where cells or faces lie: `count` of them from k upward, all with the same values.
struct Place {
  std::int32_t i, j, k, count;
};

/// Rows of output of a chunk of columns: where they belong and what they hold. A row stands for `count` places, one per
/// level k.
struct Rows {
  std::vector<Place> place;
  std::vector<double> values;          ///< [rows][stride]
  std::vector<std::int32_t> start;     ///< [levels + 1], in `order`
  std::vector<std::int32_t> order;     ///< rows by level, there in the order of the columns
  std::vector<std::int64_t> first;     ///< [levels], where the chunk's first place of a level goes in the sorted output
  std::vector<std::int64_t> position;  ///< [rows], where the first of the row went
  std::vector<std::uint8_t> walled;    ///< [rows] of cells: 1 where there are pieces of wall
  std::vector<double> total;           ///< [rows] of cells: fraction that the union of the bodies fills, before limits

  std::size_t size() const { return place.size(); }
  void clear() {
    place.clear();
    values.clear();
    walled.clear();
    total.clear();
  }
  void sort(std::size_t levels);
};

/// Values of a cell per body: fraction of its volume, outward area vector, velocity, volume swept outward per time.
inline constexpr std::size_t cell_stride = 8;

/// Solid area of a face (m^2, signed) by which the sum over bodies leaves [0, area of the face].
struct FaceExcess {
  std::int32_t axis, i, j, k;
  double area;
};

/// What the bodies leave in the cells above the current one.
struct ColumnShade {
  double area = 0, x_extent = 0, y_extent = 0;
  double wall = 0;  ///< m^2, of all the surface above
};

/// Sums of the records of one body in one cell.
struct CellSum {
  std::array<double, 3> area{}, weighted_velocity{};
  double wall = 0, sweep = 0, height_moment = 0;
  double x_extent = 0, x_moment = 0, y_extent = 0, y_moment = 0;
};

/// What other bodies leave of a piece. No area: nothing.
struct PiecePart {
  std::ptrdiff_t record = 0;  ///< of its chunk of columns
  std::int64_t entry = -1;    ///< position in CutCells::cell
  std::array<double, 3> area{}, weights{};
};

/// How the parts of surfaces inside other bodies are found.
struct UnionBody {
  std::span<const Corner> corners;
  std::span<const std::array<double, 3>> shifts;  ///< joint_shifts
};
struct UnionMethod {
  std::span<const UnionBody> bodies;
  AddBelow exact = nullptr;  ///< where doubles are not certain
  bool always_exact = false;
};

/// One chunk of columns: its own output and scratch, so that results belong to chunks.
struct ColumnChunk {
  Rows cells;
  std::array<Rows, 3> faces;
  std::vector<FaceExcess> excesses;
  std::vector<std::pair<Place, std::int32_t>> uncertain;  ///< cells and bodies
  std::int64_t shared_cells = 0, overlapping_cells = 0, united_cells = 0, united_exactly = 0, doubted_unions = 0;
  std::vector<PiecePart> parts;                   ///< ascending by record
  std::size_t first_part = 0;                     ///< of the parts of all chunks
  std::vector<std::int32_t> first;                ///< [bodies][column_chunk + 1], where the records of a column begin
  std::vector<const PieceRecord*> record;         ///< by body and column, in the order of the triangles
  std::vector<std::int64_t*> entry;               ///< per record: ClippedChunk::entry
  std::vector<std::int32_t> row;                  ///< per record: row of its cell, -1: no wall of any cell
  std::vector<std::vector<std::int32_t>> pieces;  ///< [bodies][chunks of triangles], how many records have a row
  std::vector<CellSum> sums;                      ///< scratch [cells along z + 1][bodies]
  std::vector<CellSum> removed;                   ///< scratch likewise: what of them lies in other bodies
  std::vector<double> above;                      ///< scratch [slabs + 1][bodies], see ColumnUnion
  std::vector<char> surface;                      ///< scratch [slabs][bodies]
  std::vector<ColumnShade> shade;                 ///< scratch [bodies]
  std::vector<ColumnShade> joint_shade;           ///< scratch [bodies], of what lies in other bodies
  std::vector<std::int32_t> row_of_k;             ///< scratch [cells along z + 1]
  std::vector<char> occupied;                     ///< scratch [cells along z + 1], there is surface in the slab
};

/// Notes the records of the columns from `begin` on (numbered i + (nx+1)*j) in `chunk`. clipped: [bodies][chunks of
/// triangles].
void gather_columns(const GridLines& grid, std::span<std::vector<ClippedChunk>> clipped, std::size_t begin,
                    ColumnChunk& chunk);

/// Sums up the columns [begin, end) of all bodies into their chunk, one of `chunks`, all of which are gathered. reach:
/// [bodies], see PlacedSurface. What lies in two bodies counts once, if `method` knows them.
void sum_columns(const GridLines& grid, std::span<const BodySurface> bodies, std::span<const double> reach,
                 const UnionMethod& method, std::size_t begin, std::size_t end, std::span<ColumnChunk> chunks);

}  // namespace polynya::geometry
