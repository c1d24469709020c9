#include "coupler/overlap_exchange.hpp"

#include "core/contact/vector3.hpp"
#include "geometry/exact_cut.hpp"

namespace polynya::coupler {

OverlapExchange::OverlapExchange(const FluidSide& fluid, bool debris_displaces_fluid, double atmospheric_pressure)
    : cutter_(fluid.grid),
      debris_displaces_fluid_(debris_displaces_fluid),
      atmospheric_pressure_(atmospheric_pressure) {}

std::vector<geometry::BodySurface> OverlapExchange::Cut::views() const {
  std::vector<geometry::BodySurface> bodies(body_count);
  for (const Surface& surface : surfaces) bodies[static_cast<std::size_t>(surface.body)] = surface.view();
  return bodies;
}

const geometry::CutCells& OverlapExchange::cut(const Conversation& conversation, compute::Stopwatch& watch) {
  const auto lap = watch.lap("overlap");
  std::swap(before_, now_);
  now_.surfaces.resize(conversation.solids.size());
  for (std::size_t s = 0; s < conversation.solids.size(); ++s) {
    const SolidSide& side = conversation.solids[s];
    Cut::Surface& surface = now_.surfaces[s];
    surface.body = side.body;
    surface.ids = side.ids;
    surface.positions = side.positions;
    surface.velocities = side.mean_velocity();  // areas times mean velocity are the swept volume
    surface.triangles = side.triangles;
  }
  cutter_.cut(now_.views(), now_.cells);
  if (debris_displaces_fluid_) {
    const auto inner = watch.lap("debris_displacement");
    std::vector<double> positions, volumes;
    for (const SolidSide& side : conversation.solids)
      for (std::size_t v = 0; v < side.vertices(); ++v) {
        if (side.volumes[v] <= 0) continue;
        volumes.push_back(side.volumes[v]);
        positions.insert(positions.end(), &side.positions[3 * v], &side.positions[3 * v] + 3);
      }
    if (!volumes.empty()) cutter_.deposit_debris(positions, volumes, now_.cells);
  }
  return now_.cells;
}

void OverlapExchange::give(SolidSide& side, const Cut& cut, std::int32_t index, const WallPressure& pressure,
                           double factor, Ledger& ledger) const {
  const Cut::Surface* surface = nullptr;
  for (const Cut::Surface& candidate : cut.surfaces)
    if (candidate.body == side.body) surface = &candidate;
  if (!surface) return;
  std::vector<double> impulses(surface->positions.size(), 0.0);
  geometry::add_pressure_forces(cut.cells, cutter_.grid(), index, surface->view(), pressure.value, pressure.gradient_z,
                                impulses);
  for (double& value : impulses) value *= factor;
  double pressure_alone = 0, open_area = 0;
  for (std::size_t e = 0; e < cut.cells.cell.size(); ++e) {
    const double area = cut.cells.wall_area[(e * body_count + static_cast<std::size_t>(index)) * 3 + 2];
    pressure_alone += pressure.value[e] * area;
    open_area += area;
  }
  double vertical = 0;
  for (std::size_t i = 2; i < impulses.size(); i += 3) vertical += impulses[i];
  ledger.fluid_weight[index] += vertical - factor * pressure_alone;
  ledger.fluid_atmosphere[index] += factor * atmospheric_pressure_ * open_area;
  for (std::size_t i = 0; i < impulses.size(); ++i) ledger.fluid_given[static_cast<int>(side.body)][i % 3] += impulses[i];
  add_fluid_impulses(side, surface->ids, surface->positions, impulses);
}

void OverlapExchange::give_impulses(Conversation& conversation, const WallPressure& at_start,
                                    const WallPressure& at_end, double span, Ledger& ledger) const {
  for (SolidSide& side : conversation.solids) {
    const auto body = static_cast<std::int32_t>(side.body);
    give(side, before_, body, at_start, 0.5 * span, ledger);
    give(side, now_, body, at_end, 0.5 * span, ledger);
  }
}

void OverlapExchange::set_start_forces(Conversation& conversation, const WallPressure& pressure) const {
  for (SolidSide& side : conversation.solids) {
    side.start_force.assign(3 * side.vertices(), 0.0);
    const geometry::BodySurface surface{side.positions, side.velocities, side.triangles};
    geometry::add_pressure_forces(now_.cells, cutter_.grid(), static_cast<std::int32_t>(side.body), surface,
                                  pressure.value, pressure.gradient_z, side.start_force);
  }
}

void OverlapExchange::give_wall_impulses(Conversation& conversation, std::span<const double> impulse,
                                         Ledger& ledger) const {
  using contact::norm;
  std::vector<double> area(now_.cells.cell.size() * body_count, 0.0);
  for (const geometry::WallPiece& piece : now_.cells.pieces) area[piece.entry * body_count + piece.body] += norm(piece.area);
  for (SolidSide& side : conversation.solids) {
    const int body = static_cast<int>(side.body);
    std::vector<double> impulses(side.positions.size(), 0.0);
    for (const geometry::WallPiece& piece : now_.cells.pieces) {
      if (piece.body != body) continue;
      const std::size_t at = piece.entry * body_count + static_cast<std::size_t>(body);
      if (!(area[at] > 0)) continue;
      const double share = norm(piece.area) / area[at];
      const std::int32_t* v = &side.triangles[3 * static_cast<std::size_t>(piece.triangle)];
      for (int i = 0; i < 3; ++i)
        for (int d = 0; d < 3; ++d) impulses[3 * v[i] + d] += share * piece.weights[i] * impulse[3 * at + d];
    }
    for (std::size_t i = 0; i < impulses.size(); ++i) {
      side.fluid_impulse[i] += impulses[i];
      ledger.fluid_given[body][i % 3] += impulses[i];
      if (i % 3 == 2) ledger.fluid_carried[body] += impulses[i];
    }
  }
}

void OverlapExchange::set_impedance(Conversation& conversation, std::span<const double> impedance) const {
  for (SolidSide& side : conversation.solids) {
    side.impedance.assign(6 * side.vertices(), 0.0);
    for (const geometry::WallPiece& piece : now_.cells.pieces) {
      const double size = contact::norm(piece.area);
      if (piece.body != static_cast<std::int32_t>(side.body) || size == 0 || impedance[piece.entry] == 0) continue;
      const double n[3] = {piece.area[0] / size, piece.area[1] / size, piece.area[2] / size};
      const double products[6] = {n[0] * n[0], n[1] * n[1], n[2] * n[2], n[0] * n[1], n[1] * n[2], n[2] * n[0]};
      const std::int32_t* v = &side.triangles[3 * static_cast<std::size_t>(piece.triangle)];
      for (int i = 0; i < 3; ++i)
        for (int c = 0; c < 6; ++c)
          side.impedance[6 * static_cast<std::size_t>(v[i]) + c] += impedance[piece.entry] * size * piece.weights[i] * products[c];
    }
  }
}

double OverlapExchange::verify_sample(std::uint64_t seed, std::size_t count) const {
  return geometry::verify_sample(now_.cells, now_.views(), cutter_.grid(), seed, count);
}

}  // namespace polynya::coupler
