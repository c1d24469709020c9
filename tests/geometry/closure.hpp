#pragma once
#include <algorithm>
#include <cmath>
#include <map>

#include "geometry/cut_cells.hpp"

/// What must hold for every cut, however degenerate.
struct Closure {
  double area = 0;      ///< largest |sum of walls - sum of solid faces| of a cell, over the cell's largest face
  double pieces = 0;    ///< largest |sum of pieces + wall area|, over the cell's largest face
  double fraction = 0;  ///< by how much a union fraction or a volume leaves its range
  bool sorted = true;
};

inline Closure check_closure(const polynya::geometry::CutCells& cut, const polynya::geometry::GridLines& grid) {
  Closure worst;
  std::array<std::map<std::int64_t, std::size_t>, 3> face_at;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto& faces = cut.faces[axis];
    worst.sorted = worst.sorted && std::ranges::adjacent_find(faces.face, std::greater_equal{}) == faces.face.end();
    for (std::size_t f = 0; f < faces.face.size(); ++f) {
      face_at[axis][faces.face[f]] = f;
      worst.fraction = std::max({worst.fraction, -faces.solid[f], faces.solid[f] - 1});
    }
  }
  worst.sorted = worst.sorted && std::ranges::adjacent_find(cut.cell, std::greater_equal{}) == cut.cell.end();
  std::vector<double> pieces(cut.wall_area);
  for (const auto& piece : cut.pieces)
    for (std::size_t d = 0; d < 3; ++d)
      pieces[(static_cast<std::size_t>(piece.entry) * cut.bodies + static_cast<std::size_t>(piece.body)) * 3 + d] +=
          piece.area[d];
  for (std::size_t e = 0; e < cut.cell.size(); ++e) {
    const auto p = grid.cell_position(cut.cell[e]);
    const std::array<double, 3> width{grid.width(0, p[0]), grid.width(1, p[1]), grid.width(2, p[2])};
    const double volume = width[0] * width[1] * width[2], largest = volume / std::ranges::min(width);
    worst.fraction = std::max({worst.fraction, -cut.solid_volume[e] / volume, cut.solid_volume[e] / volume - 1});
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::array<std::int64_t, 3> n{grid.cells(0), grid.cells(1), grid.cells(2)};
      ++n[axis];
      double all = 0;
      for (int side : {0, 1}) {
        auto q = p;
        q[axis] += side;
        const auto found = face_at[axis].find(q[0] + n[0] * (q[1] + n[1] * q[2]));
        if (found == face_at[axis].end()) continue;
        const double area = (side == 1 ? 1 : -1) * volume / width[axis];
        all += area * cut.faces[axis].solid[found->second];
      }
      for (std::size_t b = 0; b < cut.bodies; ++b) {
        const std::size_t at = (e * cut.bodies + b) * 3 + axis;
        worst.pieces = std::max(worst.pieces, std::abs(pieces[at]) / largest);
        all -= cut.wall_area[at];
      }
      worst.area = std::max(worst.area, std::abs(all) / largest);
    }
  }
  return worst;
}

inline double total_volume(const polynya::geometry::CutCells& cut) {
  double sum = 0;
  for (double volume : cut.solid_volume) sum += volume;
  return sum;
}
