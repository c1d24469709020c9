#pragma once
#include "geometry/columns.hpp"
#include "geometry/cut_cells.hpp"
#include "geometry/debris.hpp"
#include "geometry/joint_pieces.hpp"
#include "geometry/placed_surface.hpp"

namespace polynya::geometry {

/// Everything a cutter keeps between cuts. Internal to the room.
struct Cutter::Workspace {
  GridLines grid;
  std::array<LineLocator, 3> locators;
  ClipTriangles method = clip_packed;
  std::vector<double> reach;                       ///< [bodies], m, largest coordinate of grid and body
  std::vector<PlacedSurface> surfaces;             ///< [bodies]
  std::vector<std::vector<ClippedChunk>> clipped;  ///< [bodies][chunks of triangles]
  std::vector<std::array<std::size_t, 2>> clips;   ///< body and chunk of triangles of all of them
  std::vector<ColumnChunk> chunks;                 ///< [chunks of columns]
  std::vector<FaceExcess> excesses;
  std::vector<std::vector<std::array<double, 3>>> shifts;  ///< [bodies], joint_shifts
  std::vector<UnionBody> union_bodies;                     ///< empty: one body at most has a surface
  UnionMethod union_method;
  std::vector<PiecePart> parts;          ///< of all chunks of columns
  std::vector<std::size_t> piece_start;  ///< [clips + 1]
  DebrisDeposit debris;
  bool complete = false;  ///< `clipped` belongs to `surfaces`: no error came between

  /// Columns of cells, and one more along x and y for the last planes.
  std::size_t columns() const { return static_cast<std::size_t>((grid.cells(0) + 1) * (grid.cells(1) + 1)); }
  std::int64_t clip(std::span<const BodySurface> bodies);  ///< returns how many triangles were kept
  void prepare_union(std::span<const BodySurface> bodies);
  void sum(std::span<const BodySurface> bodies);
  void collect(CutCells& out);
  void collect_uncertain(CutCells& out) const;
  void collect_pieces(std::span<const BodySurface> bodies, CutCells& out);
};

}  // namespace polynya::geometry
