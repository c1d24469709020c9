#include <cmath>

#include "fluid_solver/prescribed_bodies.hpp"

namespace polynya::fluid {

Overlap overlap_of(const geometry::CutCells& cut) {
  Overlap overlap;
  const std::size_t entries = cut.cell.size(), bodies = cut.bodies;
  overlap.cell = cut.cell;
  overlap.solid_volume = cut.solid_volume;
  overlap.debris_volume = cut.debris_volume;
  for (std::size_t d = 0; d < 3; ++d) overlap.face[d] = cut.faces[d].face, overlap.face_solid[d] = cut.faces[d].solid;
  overlap.wall_area.assign(6 * entries, 0.0);
  overlap.wall_velocity.assign(6 * entries, 0.0);
  overlap.wall_size.assign(entries, 0.0);
  overlap.wall_sweep.assign(2 * entries, 0.0);
  std::vector<double> size(bodies * entries, 0.0), together(2 * entries, 0.0);
  for (const geometry::WallPiece& piece : cut.pieces) {
    const auto entry = static_cast<std::size_t>(piece.entry), body = static_cast<std::size_t>(piece.body);
    const double area = std::hypot(piece.area[0], piece.area[1], piece.area[2]);
    size[entry * bodies + body] += area;
    together[2 * entry + (body > 0)] += area;
    overlap.wall_size[entry] += area;
  }
  for (std::size_t e = 0; e < entries; ++e) {
    if (cut.walled[e]) overlap.walled.push_back(cut.cell[e]);
    for (std::size_t b = 0; b < bodies; ++b) {
      const std::size_t from = e * bodies + b, to = 2 * e + (b > 0);
      overlap.wall_sweep[to] += cut.wall_sweep[from];
      const double share = together[to] > 0 ? size[from] / together[to] : 0.0;
      for (std::size_t d = 0; d < 3; ++d) {
        overlap.wall_area[3 * to + d] += cut.wall_area[3 * from + d];
        overlap.wall_velocity[3 * to + d] += share * cut.wall_velocity[3 * from + d];
      }
    }
  }
  return overlap;
}

}  // namespace polynya::fluid
