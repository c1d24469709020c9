#include "coupler/overlap_exchange.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "core/compute/parallel.hpp"
#include "core/contact/vector3.hpp"
#include "geometry/exact_cut.hpp"

namespace polynya::coupler {
namespace {

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Where a body's wall stands in arrays [walls][bodies].
std::size_t at_wall(std::int32_t wall, const geometry::WallPiece& piece) {
  return static_cast<std::size_t>(wall) * body_count + static_cast<std::size_t>(piece.body);
}

/// Resistance of the fluid to the motion of a piece's vertices: impedance x area, along its normal.
void add_impedance(const geometry::WallPiece& piece, const std::int32_t* vertex, double per_size,
                   std::vector<double>& impedance) {
  const auto [x, y, z] = piece.area;
  const double products[6] = {x * x, y * y, z * z, x * y, y * z, z * x};
  for (std::size_t i = 0; i < 3; ++i) {
    double* at = &impedance[6 * static_cast<std::size_t>(vertex[i])];
    for (std::size_t c = 0; c < 6; ++c) at[c] += per_size * piece.weights[i] * products[c];
  }
}

}  // namespace

OverlapExchange::OverlapExchange(const FluidSide& fluid, bool debris_displaces_fluid, double atmospheric_pressure,
                                 bool exact)
    : cutter_(fluid.grid),
      debris_displaces_fluid_(debris_displaces_fluid),
      exact_(exact),
      atmospheric_pressure_(atmospheric_pressure) {
  if (exact) cutter_.set_method(geometry::clip_exactly);
  cutter_.set_exact_union(geometry::add_below_exactly, exact);
}

std::vector<geometry::BodySurface> OverlapExchange::Cut::views() const {
  std::vector<geometry::BodySurface> bodies(body_count);
  for (const Surface& surface : surfaces) bodies[static_cast<std::size_t>(surface.body)] = surface.view();
  return bodies;
}

const geometry::CutCells& OverlapExchange::cut(const Conversation& conversation, compute::Stopwatch& watch) {
  const auto lap = watch.lap("overlap");
  const double begun = seconds_now();
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
  counts_.united += static_cast<long>(now_.cells.united_cells);
  counts_.united_exactly += static_cast<long>(now_.cells.united_exactly);
  counts_.doubted += static_cast<long>(now_.cells.doubted_unions);
  counts_.kept += static_cast<long>(now_.cells.kept_triangles);
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
  times_.push_back({begun, seconds_now()});
  return now_.cells;
}

void OverlapExchange::prepare() {
  Cut& cut = now_;
  const std::vector<geometry::WallPiece>& pieces = cut.cells.pieces;
  cut.walls = 0;
  cut.wall_of.resize(cut.cells.cell.size());
  for (std::size_t e = 0; e < cut.wall_of.size(); ++e)
    cut.wall_of[e] = cut.cells.walled[e] ? static_cast<std::int32_t>(cut.walls++) : -1;
  cut.piece_size.resize(pieces.size());
  cut.wall_size.assign(cut.walls * body_count, 0.0);
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    cut.piece_size[p] = contact::norm(pieces[p].area);
    cut.wall_size[at_wall(cut.wall_of[static_cast<std::size_t>(pieces[p].entry)], pieces[p])] += cut.piece_size[p];
  }
}

void OverlapExchange::take(Conversation& conversation, const FluidAnswer& answer, double span, Ledger& ledger) const {
  Given at_start, at_end;
  // Neither needs the other; the longer one first.
  compute::for_uneven_chunks(2, 1, [&](std::size_t sum, std::size_t) {
    if (sum == 0) at_end = spread(now_, answer.at_end, 0.5 * span, &answer);
    if (sum == 1) at_start = spread(before_, answer.at_start, 0.5 * span, nullptr);
  });
  book(conversation, before_, at_start, 0.5 * span, ledger);
  book(conversation, now_, at_end, 0.5 * span, ledger);
  if (answer.forecast.empty()) return;
  for (SolidSide& side : conversation.solids) {
    side.expected_force = std::move(at_end.expected[static_cast<std::size_t>(side.body)]);
    side.impedance = std::move(at_end.impedance[static_cast<std::size_t>(side.body)]);
  }
}

/// One pass through the pieces of wall does all: to read them takes longer than what is computed of them.
OverlapExchange::Given OverlapExchange::spread(const Cut& cut, const WallPressureView& pressure, double time,
                                               const FluidAnswer* last) {
  Given given;
  const std::span<const double> impulse = last ? last->impulse : std::span<const double>();
  const bool forecast = last && !last->forecast.empty();
  std::array<const std::int32_t*, body_count> triangles{};
  for (const Cut::Surface& surface : cut.surfaces) {
    const auto body = static_cast<std::size_t>(surface.body);
    given.impulse[body].assign(surface.positions.size(), 0.0);
    if (forecast) {
      given.expected[body].assign(surface.positions.size(), 0.0);
      given.impedance[body].assign(2 * surface.positions.size(), 0.0);
    }
    triangles[body] = surface.triangles.data();
  }
  for (std::size_t p = 0; p < cut.cells.pieces.size(); ++p) {
    const geometry::WallPiece& piece = cut.cells.pieces[p];
    const std::int32_t at = cut.wall_of[static_cast<std::size_t>(piece.entry)];
    const auto wall = static_cast<std::size_t>(at), body = static_cast<std::size_t>(piece.body);
    const std::int32_t* vertex = triangles[body] + 3 * static_cast<std::size_t>(piece.triangle);
    const double rise = pressure.gradient_z[wall] * piece.height;
    const double push = time * (pressure.value[wall] - rise);
    std::array<double, 3> sum{-push * piece.area[0], -push * piece.area[1], -push * piece.area[2]};
    given.weight[body] += time * rise * piece.area[2];
    given.area_z[body] -= piece.area[2];
    if (!impulse.empty() && cut.wall_size[at_wall(at, piece)] > 0) {
      const double share = cut.piece_size[p] / cut.wall_size[at_wall(at, piece)];
      const double* other = &impulse[3 * at_wall(at, piece)];
      for (std::size_t d = 0; d < 3; ++d) sum[d] += share * other[d];
      given.carried[body] += share * other[2];
    }
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t d = 0; d < 3; ++d)
        given.impulse[body][3 * static_cast<std::size_t>(vertex[i]) + d] += piece.weights[i] * sum[d];
    if (!forecast) continue;
    const double expected = last->forecast[wall] - rise;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t d = 0; d < 3; ++d)
        given.expected[body][3 * static_cast<std::size_t>(vertex[i]) + d] -=
            expected * piece.weights[i] * piece.area[d];
    if (cut.piece_size[p] > 0)
      add_impedance(piece, vertex, last->impedance[wall] / cut.piece_size[p], given.impedance[body]);
  }
  return given;
}

void OverlapExchange::set_start_forces(Conversation& conversation, const WallPressure& pressure) const {
  std::vector<geometry::WallForces> forces =
      geometry::pressure_forces(now_.cells, now_.views(), pressure.value, pressure.gradient_z);
  for (SolidSide& side : conversation.solids)
    side.start_force = std::move(forces[static_cast<std::size_t>(side.body)].on_vertices);
}

void OverlapExchange::book(Conversation& conversation, const Cut& cut, const Given& given, double time,
                           Ledger& ledger) const {
  for (SolidSide& side : conversation.solids)
    for (const Cut::Surface& surface : cut.surfaces) {
      if (surface.body != side.body) continue;
      const auto body = static_cast<std::size_t>(side.body);
      const std::vector<double>& impulses = given.impulse[body];
      for (std::size_t i = 0; i < impulses.size(); ++i) ledger.fluid_given[body][i % 3] += impulses[i];
      ledger.fluid_weight[body] += given.weight[body];
      ledger.fluid_carried[body] += given.carried[body];
      ledger.fluid_atmosphere[body] += time * atmospheric_pressure_ * given.area_z[body];
      add_fluid_impulses(side, surface.ids, surface.positions, impulses);
    }
}

double OverlapExchange::verify_sample(std::uint64_t seed, std::size_t count) const {
  return geometry::verify_sample(now_.cells, now_.views(), cutter_.grid(), seed, count);
}

}  // namespace polynya::coupler
