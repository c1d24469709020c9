#include "geometry/cut_cells.hpp"

namespace polynya::geometry {

void add_pressure_forces(const CutCells& cut, const GridLines& grid, std::int32_t body, const BodySurface& surface,
                         std::span<const double> pressure, std::span<const double> gradient_z,
                         std::span<double> forces) {
  if (pressure.size() != cut.cell.size() || gradient_z.size() != cut.cell.size() ||
      forces.size() != surface.positions.size())
    throw GeometryError("pressures must be given per entry of the cut, forces per vertex of the surface");
  const std::vector<double>& z = grid.lines[2];
  for (const WallPiece& piece : cut.pieces) {
    if (piece.body != body) continue;
    const auto entry = static_cast<std::size_t>(piece.entry);
    const auto k = static_cast<std::size_t>(grid.cell_position(cut.cell[entry])[2]);
    const std::int32_t* vertex = surface.triangles.data() + 3 * static_cast<std::size_t>(piece.triangle);
    double height = -0.5 * (z[k] + z[k + 1]);
    for (std::size_t c = 0; c < 3; ++c)
      height += piece.weights[c] * surface.positions[3 * static_cast<std::size_t>(vertex[c]) + 2];
    const double p = pressure[entry] - gradient_z[entry] * height;
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t d = 0; d < 3; ++d)
        forces[3 * static_cast<std::size_t>(vertex[c]) + d] -= p * piece.weights[c] * piece.area[d];
  }
}

}  // namespace polynya::geometry
