#include <array>
#include <cmath>

#include "bench/kernels.hpp"
#include "geometry/cut_cells.hpp"

namespace polynya::bench {
namespace {

constexpr int squares = 71;  // per side of each face: 4 * 71^2 = 20,164 triangles
constexpr int cells = 140;

struct Plate {
  std::vector<double> positions, velocities;
  std::vector<std::int32_t> triangles;
};

/// Upper and lower face of a wavy plate, 1 x 1, three cells thick, cut off at the walls of the grid.
Plate wavy_plate() {
  Plate plate;
  const auto vertex = [](int i, int j, int side) { return i + (squares + 1) * (j + (squares + 1) * side); };
  for (int side : {0, 1})
    for (int j = 0; j <= squares; ++j)
      for (int i = 0; i <= squares; ++i) {
        const double x = static_cast<double>(i) / squares, y = static_cast<double>(j) / squares;
        plate.positions.insert(plate.positions.end(), {x, y, 0.0213 * side + 0.02 * std::sin(9 * x + 3 * y)});
      }
  plate.velocities.assign(plate.positions.size(), 1.0);
  for (int side : {0, 1})
    for (int j = 0; j < squares; ++j)
      for (int i = 0; i < squares; ++i) {
        const std::int32_t a = vertex(i, j, side), b = vertex(i + 1, j, side), c = vertex(i + 1, j + 1, side),
                           d = vertex(i, j + 1, side);
        if (side == 1)
          plate.triangles.insert(plate.triangles.end(), {a, b, c, a, c, d});
        else
          plate.triangles.insert(plate.triangles.end(), {a, c, b, a, d, c});
      }
  return plate;
}

std::vector<double> equal_cells(double low) {
  std::vector<double> lines;
  for (int i = 0; i <= cells; ++i) lines.push_back(low + static_cast<double>(i) / cells);
  return lines;
}

}  // namespace

/// 20,164 triangles through about 44,000 cells with wall (and 32,000 full ones): from positions to volumes, areas,
/// faces and pieces, ms.
std::vector<Figure> clip() {
  const Plate plate = wavy_plate();
  geometry::Cutter cutter(geometry::GridLines{{equal_cells(0), equal_cells(0), equal_cells(-0.5)}});
  const std::array bodies{geometry::BodySurface{plate.positions, plate.velocities, plate.triangles}};
  geometry::CutCells cut;
  return {{"geometry.clip_ms", 1e3 * shortest_time(20, [&] { cutter.cut(bodies, cut); })}};
}

}  // namespace polynya::bench
