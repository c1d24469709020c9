#pragma once
#include <vector>

#include "geometry/columns.hpp"
#include "geometry/cut_cells.hpp"

namespace polynya::geometry {

/// Where bodies overlap, faces are clamped to fully solid. Takes what was clamped out of the wall area of the cells on
/// both sides, so that wall areas and faces of a cell still close, and gives it to the pieces, so that forces and wall
/// area still agree: the body with most wall in the cell receives it at its largest piece there. Internal to the room.
void correct_excess(const GridLines& grid, const std::vector<FaceExcess>& excesses, CutCells& out);

}  // namespace polynya::geometry
