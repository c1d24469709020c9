#include "geometry/cut_cells.hpp"

namespace polynya::geometry {

std::vector<WallForces> pressure_forces(const CutCells& cut, std::span<const BodySurface> bodies,
                                        std::span<const double> pressure, std::span<const double> gradient_z) {
  if (pressure.size() != cut.cell.size() || gradient_z.size() != cut.cell.size())
    throw GeometryError("pressures must be given per entry of the cut");
  if (bodies.size() != cut.bodies) throw GeometryError("the forces need the surfaces of all bodies of the cut");
  std::vector<WallForces> forces(bodies.size());
  for (std::size_t b = 0; b < bodies.size(); ++b) forces[b].on_vertices.assign(bodies[b].positions.size(), 0.0);
  for (const WallPiece& piece : cut.pieces) {  // once for all bodies: reading the pieces is what takes time
    const auto entry = static_cast<std::size_t>(piece.entry);
    const auto body = static_cast<std::size_t>(piece.body);
    const std::int32_t* vertex = bodies[body].triangles.data() + 3 * static_cast<std::size_t>(piece.triangle);
    WallForces& force = forces[body];
    const double p = pressure[entry] - gradient_z[entry] * piece.height;
    force.without_gradient -= pressure[entry] * piece.area[2];
    force.area_z -= piece.area[2];
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t d = 0; d < 3; ++d)
        force.on_vertices[3 * static_cast<std::size_t>(vertex[c]) + d] -= p * piece.weights[c] * piece.area[d];
  }
  return forces;
}

}  // namespace polynya::geometry
