#include <array>
#include <cmath>

#include "bench/kernels.hpp"
#include "geometry/cut_cells.hpp"
#include "geometry/placed_surface.hpp"

namespace polynya::bench {
namespace {

struct Plate {
  std::vector<double> positions, velocities;
  std::vector<std::int32_t> triangles;
};

/// Upper and lower face of a wavy plate, 1 x 1, three of 140 cells thick, cut off at the walls of the grid: 4 x
/// squares^2 triangles.
Plate wavy_plate(int squares) {
  Plate plate;
  const auto vertex = [squares](int i, int j, int side) { return i + (squares + 1) * (j + (squares + 1) * side); };
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

std::vector<double> equal_cells(double low, int cells) {
  std::vector<double> lines;
  for (int i = 0; i <= cells; ++i) lines.push_back(low + static_cast<double>(i) / cells);
  return lines;
}

}  // namespace

/// From positions to volumes, areas, faces and pieces, ms: 20,164 triangles through about 44,000 cells with wall (and
/// 32,000 full ones), and as many triangles as the ice of the base scene has at 1 mm. The cut has no hierarchy of
/// boxes: what follows the motion of a surface before triangles are clipped is where its vertices lie in the grid;
/// `refit_ms` is the time of that for the 20,164 triangles, `cut_at_rest_ms` that of the cut where they stand still.
std::vector<Figure> clip() {
  const auto shortest = [](Plate plate, int cells, double moved = 1e-4) {
    geometry::Cutter cutter(
        geometry::GridLines{{equal_cells(0, cells), equal_cells(0, cells), equal_cells(-0.5, cells)}});
    const std::array bodies{geometry::BodySurface{plate.positions, plate.velocities, plate.triangles}};
    geometry::CutCells cut;
    return 1e3 * shortest_time(20, [&] {
             moved = -moved;  // what has not moved would not be clipped again
             for (std::size_t z = 2; z < plate.positions.size(); z += 3) plate.positions[z] += moved;
             cutter.cut(bodies, cut);
           });
  };
  const Plate plate = wavy_plate(71);
  const std::vector<double> across = equal_cells(0, 140), upward = equal_cells(-0.5, 140);
  const std::array<geometry::LineLocator, 3> locators{geometry::LineLocator(across), geometry::LineLocator(across),
                                                      geometry::LineLocator(upward)};
  geometry::PlacedSurface placed;
  const double refit = 1e3 * shortest_time(20, [&] {
                         placed.place({plate.positions, plate.velocities, plate.triangles}, locators);
                       });
  return {{"geometry.clip_ms", shortest(plate, 140)},
          {"geometry.clip_160000_ms", shortest(wavy_plate(200), 140)},
          {"geometry.cut_at_rest_ms", shortest(plate, 140, 0)},
          {"geometry.refit_ms", refit}};
}

}  // namespace polynya::bench
