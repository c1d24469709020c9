#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/columns.hpp"
#include "geometry/joint_pieces.hpp"

/// What the surfaces of several bodies in one column have inside one another. Internal to the room.
namespace polynya::geometry {

/// A column of cells and its records in a chunk.
struct UnitedColumn {
  const GridLines& grid;
  std::span<const BodySurface> bodies;
  const UnionMethod& method;
  std::span<const ColumnChunk> chunks;  ///< of all columns
  std::int32_t i, j;
};

/// Sums up what of each body's surface lies in other bodies into `chunk.removed`, and notes what remains of the pieces
/// in `chunk.parts`. False if nothing does. A piece's part inside another body and that body's part inside the first
/// one are the surface of what both have in common; without it, they are the surface of the union.
bool unite(const UnitedColumn& column, ColumnChunk& chunk);

}  // namespace polynya::geometry
