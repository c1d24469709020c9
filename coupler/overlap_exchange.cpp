#include "coupler/overlap_exchange.hpp"

#include <algorithm>
#include <utility>

#include "core/compute/parallel.hpp"
#include "core/contact/vector3.hpp"
#include "geometry/exact_cut.hpp"

namespace polynya::coupler {
namespace {

/// Where a body's wall of a cell stands in arrays [entries][bodies].
std::size_t at_wall(const geometry::WallPiece& piece) {
  return static_cast<std::size_t>(piece.entry) * body_count + static_cast<std::size_t>(piece.body);
}

}  // namespace

OverlapExchange::OverlapExchange(const FluidSide& fluid, bool debris_displaces_fluid, double atmospheric_pressure,
                                 bool exact)
    : cutter_(fluid.grid),
      debris_displaces_fluid_(debris_displaces_fluid),
      exact_(exact),
      atmospheric_pressure_(atmospheric_pressure) {
  if (exact) cutter_.set_method(geometry::clip_exactly);
}

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
  const std::size_t recut = geometry::recut_uncertain(now_.cells, now_.views(), cutter_.grid());
  const long walled = std::count(now_.cells.walled.begin(), now_.cells.walled.end(), std::uint8_t{1});
  counts_.cells += walled;
  counts_.exact += exact_ ? walled : static_cast<long>(recut);
  counts_.shared += static_cast<long>(now_.cells.shared_cells);
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

void OverlapExchange::prepare() {
  const std::vector<geometry::WallPiece>& pieces = now_.cells.pieces;
  now_.piece_size.resize(pieces.size());
  now_.wall_size.assign(now_.cells.cell.size() * body_count, 0.0);
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    now_.piece_size[p] = contact::norm(pieces[p].area);
    now_.wall_size[at_wall(pieces[p])] += now_.piece_size[p];
  }
}

void OverlapExchange::take(Conversation& conversation, const FluidAnswer& answer, double span, Ledger& ledger) const {
  std::vector<geometry::WallForces> at_start, at_end;
  PerBody carried, impedance;
  // Four sums over the pieces of wall, of which none needs another; the longest first.
  compute::for_uneven_chunks(4, 1, [&](std::size_t sum, std::size_t) {
    const auto forces = [](const Cut& cut, const WallPressure& pressure) {
      return geometry::pressure_forces(cut.cells, cut.views(), pressure.value, pressure.gradient_z);
    };
    if (sum == 0) at_start = forces(before_, answer.at_start);
    if (sum == 1) at_end = forces(now_, answer.at_end);
    if (sum == 2 && !answer.impedance.empty()) impedance = impedances(conversation, answer.impedance);
    if (sum == 3 && !answer.impulse.empty()) carried = wall_impulses(conversation, answer.impulse);
  });
  book(conversation, before_, at_start, 0.5 * span, ledger);
  book(conversation, now_, at_end, 0.5 * span, ledger);
  for (SolidSide& side : conversation.solids) {
    const auto body = static_cast<std::size_t>(side.body);
    for (std::size_t i = 0; i < carried[body].size(); ++i) {
      side.fluid_impulse[i] += carried[body][i];
      ledger.fluid_given[body][i % 3] += carried[body][i];
      if (i % 3 == 2) ledger.fluid_carried[body] += carried[body][i];
    }
    if (!impedance[body].empty()) side.impedance = std::move(impedance[body]);
  }
}

void OverlapExchange::set_start_forces(Conversation& conversation, const WallPressure& pressure) const {
  std::vector<geometry::WallForces> forces =
      geometry::pressure_forces(now_.cells, now_.views(), pressure.value, pressure.gradient_z);
  for (SolidSide& side : conversation.solids)
    side.start_force = std::move(forces[static_cast<std::size_t>(side.body)].on_vertices);
}

void OverlapExchange::book(Conversation& conversation, const Cut& cut, const std::vector<geometry::WallForces>& forces,
                           double time, Ledger& ledger) const {
  for (SolidSide& side : conversation.solids)
    for (const Cut::Surface& surface : cut.surfaces) {
      if (surface.body != side.body) continue;
      const auto body = static_cast<std::size_t>(side.body);
      std::vector<double> impulses = forces[body].on_vertices;
      double vertical = 0;
      for (std::size_t i = 0; i < impulses.size(); ++i) {
        impulses[i] *= time;
        ledger.fluid_given[body][i % 3] += impulses[i];
        if (i % 3 == 2) vertical += impulses[i];
      }
      ledger.fluid_weight[body] += vertical - time * forces[body].without_gradient;
      ledger.fluid_atmosphere[body] += time * atmospheric_pressure_ * forces[body].area_z;
      add_fluid_impulses(side, surface.ids, surface.positions, impulses);
    }
}

OverlapExchange::PerBody OverlapExchange::wall_impulses(const Conversation& conversation,
                                                        std::span<const double> impulse) const {
  PerBody all;
  std::array<const std::int32_t*, body_count> triangles{};
  for (const SolidSide& side : conversation.solids) {
    all[static_cast<std::size_t>(side.body)].assign(side.positions.size(), 0.0);
    triangles[static_cast<std::size_t>(side.body)] = side.triangles.data();
  }
  for (std::size_t p = 0; p < now_.cells.pieces.size(); ++p) {
    const geometry::WallPiece& piece = now_.cells.pieces[p];
    const double* given = &impulse[3 * at_wall(piece)];
    if ((given[0] == 0 && given[1] == 0 && given[2] == 0) || !(now_.wall_size[at_wall(piece)] > 0)) continue;
    const double share = now_.piece_size[p] / now_.wall_size[at_wall(piece)];
    const auto body = static_cast<std::size_t>(piece.body);
    const std::int32_t* v = triangles[body] + 3 * static_cast<std::size_t>(piece.triangle);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t d = 0; d < 3; ++d)
        all[body][3 * static_cast<std::size_t>(v[i]) + d] += share * piece.weights[i] * given[d];
  }
  return all;
}

OverlapExchange::PerBody OverlapExchange::impedances(const Conversation& conversation,
                                                     std::span<const double> impedance) const {
  PerBody all;
  std::array<const std::int32_t*, body_count> triangles{};
  for (const SolidSide& side : conversation.solids) {
    all[static_cast<std::size_t>(side.body)].assign(6 * side.vertices(), 0.0);
    triangles[static_cast<std::size_t>(side.body)] = side.triangles.data();
  }
  for (std::size_t p = 0; p < now_.cells.pieces.size(); ++p) {
    const geometry::WallPiece& piece = now_.cells.pieces[p];
    const double at_cell = impedance[static_cast<std::size_t>(piece.entry)], size = now_.piece_size[p];
    if (size == 0 || at_cell == 0) continue;
    const double n[3] = {piece.area[0] / size, piece.area[1] / size, piece.area[2] / size};
    const double products[6] = {n[0] * n[0], n[1] * n[1], n[2] * n[2], n[0] * n[1], n[1] * n[2], n[2] * n[0]};
    const auto body = static_cast<std::size_t>(piece.body);
    const std::int32_t* v = triangles[body] + 3 * static_cast<std::size_t>(piece.triangle);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t c = 0; c < 6; ++c)
        all[body][6 * static_cast<std::size_t>(v[i]) + c] += at_cell * size * piece.weights[i] * products[c];
  }
  return all;
}

double OverlapExchange::verify_sample(std::uint64_t seed, std::size_t count) const {
  return geometry::verify_sample(now_.cells, now_.views(), cutter_.grid(), seed, count);
}

}  // namespace polynya::coupler
