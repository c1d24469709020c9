#include "geometry/debris.hpp"

#include <algorithm>
#include <cmath>

namespace polynya::geometry {
namespace {

constexpr int pushes = 4;  // cells that excess debris may travel

/// Entry of a cell, or the number of entries.
std::size_t find_entry(const CutCells& cut, std::int64_t cell) {
  const auto found = std::ranges::lower_bound(cut.cell, cell);
  return found != cut.cell.end() && *found == cell ? static_cast<std::size_t>(found - cut.cell.begin())
                                                   : cut.cell.size();
}

bool outside(const std::array<LineLocator, 3>& lines, std::span<const double> position) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (!(position[axis] >= lines[axis].lines().front() && position[axis] <= lines[axis].lines().back())) return true;
  return false;
}

/// Overlap of [lower, upper] with the cells of one axis, as fractions of the interval's length.
struct AxisOverlap {
  std::int32_t first = 0, last = -1;
  double lower, upper;
  const LineLocator& lines;

  AxisOverlap(double low, double high, const LineLocator& axis_lines) : lower(low), upper(high), lines(axis_lines) {
    first = std::max(lines.below(lower), 0);
    last = std::min(lines.below(upper), lines.intervals() - 1);
  }
  double fraction(std::int32_t cell) const {
    const double length = std::min(upper, lines.line(cell + 1)) - std::max(lower, lines.line(cell));
    return std::max(length, 0.0) / (upper - lower);
  }
};

/// Moves row r to place[r] (increasing, never below r); the rows in between become zero.
template <class T>
void spread_rows(std::vector<T>& values, std::size_t stride, const std::vector<std::int64_t>& place,
                 std::size_t count) {
  values.resize(count * stride, T{});
  for (std::size_t r = place.size(); r-- > 0;) {
    const auto to = static_cast<std::size_t>(place[r]);
    if (to == r) continue;
    for (std::size_t d = 0; d < stride; ++d) {
      values[to * stride + d] = values[r * stride + d];
      values[r * stride + d] = T{};
    }
  }
}

}  // namespace

void DebrisDeposit::deposit(const GridLines& grid, const std::array<LineLocator, 3>& lines,
                            std::span<const double> positions, std::span<const double> volumes, double least_free,
                            CutCells& out) {
  if (positions.size() != 3 * volumes.size()) throw GeometryError("debris needs three coordinates per volume");
  std::ranges::fill(out.debris_volume, 0.0);
  spread(grid, lines, positions, volumes);
  merge_shares();
  for (int push = 0; push < pushes; ++push) {
    if (push_excess(grid, out, least_free) == 0) break;
    merge_shares();
  }
  out.squeezed_volume = limit(grid, out, least_free);
  insert_entries(out);
}

void DebrisDeposit::spread(const GridLines& grid, const std::array<LineLocator, 3>& lines,
                           std::span<const double> positions, std::span<const double> volumes) {
  shares_.clear();
  for (std::size_t p = 0; p < volumes.size(); ++p) {
    if (!(volumes[p] > 0) || outside(lines, positions.subspan(3 * p, 3))) continue;
    const double half = 0.5 * std::cbrt(volumes[p]);
    std::array<double, 3> centre;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double low = lines[axis].lines().front() + half, high = lines[axis].lines().back() - half;
      centre[axis] = std::clamp(positions[3 * p + axis], std::min(low, high), std::max(low, high));
    }
    const AxisOverlap x(centre[0] - half, centre[0] + half, lines[0]), y(centre[1] - half, centre[1] + half, lines[1]),
        z(centre[2] - half, centre[2] + half, lines[2]);
    for (std::int32_t k = z.first; k <= z.last; ++k)
      for (std::int32_t j = y.first; j <= y.last; ++j)
        for (std::int32_t i = x.first; i <= x.last; ++i) {
          const double share = volumes[p] * x.fraction(i) * y.fraction(j) * z.fraction(k);
          if (share > 0) shares_.push_back({grid.cell_index(i, j, k), share});
        }
  }
}

void DebrisDeposit::merge_shares() {
  std::ranges::stable_sort(shares_, {}, &Share::cell);
  std::size_t count = 0;
  for (const Share& share : shares_) {
    if (count > 0 && shares_[count - 1].cell == share.cell)
      shares_[count - 1].volume += share.volume;
    else
      shares_[count++] = share;
  }
  shares_.resize(count);
}

double DebrisDeposit::capacity(const GridLines& grid, const CutCells& cut, std::int64_t cell, double least_free) const {
  const std::size_t entry = find_entry(cut, cell);
  const double solid = entry < cut.cell.size() ? cut.solid_volume[entry] : 0.0;
  return (1.0 - least_free) * std::max(grid.cell_volume(cell) - solid, 0.0);
}

double DebrisDeposit::push_excess(const GridLines& grid, const CutCells& cut, double least_free) {
  const std::size_t count = shares_.size();
  double pushed = 0;
  for (std::size_t s = 0; s < count; ++s) {
    const double excess = shares_[s].volume - capacity(grid, cut, shares_[s].cell, least_free);
    if (excess <= 0) continue;
    const auto position = grid.cell_position(shares_[s].cell);
    std::array<Share, 6> room;
    std::size_t neighbours = 0;
    double total = 0;
    for (int axis = 0; axis < 3; ++axis)
      for (const int step : {-1, 1}) {
        auto p = position;
        p[static_cast<std::size_t>(axis)] += step;
        if (p[static_cast<std::size_t>(axis)] < 0 || p[static_cast<std::size_t>(axis)] >= grid.cells(axis)) continue;
        const std::int64_t cell = grid.cell_index(p[0], p[1], p[2]);
        const auto held = std::ranges::lower_bound(
            shares_.begin(), shares_.begin() + static_cast<std::ptrdiff_t>(count), cell, {}, &Share::cell);
        const bool found = held != shares_.begin() + static_cast<std::ptrdiff_t>(count) && held->cell == cell;
        const double free = capacity(grid, cut, cell, least_free) - (found ? held->volume : 0.0);
        if (free <= 0) continue;
        room[neighbours++] = {cell, free};
        total += free;
      }
    if (total <= 0) continue;
    const double part = std::min(1.0, total / excess);
    for (std::size_t n = 0; n < neighbours; ++n)
      shares_.push_back({room[n].cell, part * excess * room[n].volume / total});
    shares_[s].volume -= part * excess;
    pushed += part * excess;
  }
  return pushed;
}

double DebrisDeposit::limit(const GridLines& grid, const CutCells& cut, double least_free) {
  double squeezed = 0;
  for (Share& share : shares_) {
    const double kept = std::min(share.volume, capacity(grid, cut, share.cell, least_free));
    squeezed += share.volume - kept;
    share.volume = kept;
  }
  std::erase_if(shares_, [](const Share& share) { return share.volume <= 0; });
  return squeezed;
}

void DebrisDeposit::insert_entries(CutCells& out) {
  // Merges the sorted cells of the entries and of the shares; both learn the row they go to.
  moved_.resize(out.cell.size());
  place_.resize(shares_.size());
  std::size_t entry = 0, share = 0, row = 0;
  for (; entry < moved_.size() || share < shares_.size(); ++row) {
    const bool take_entry =
        share == shares_.size() || (entry < moved_.size() && out.cell[entry] <= shares_[share].cell);
    const bool take_share =
        entry == moved_.size() || (share < shares_.size() && shares_[share].cell <= out.cell[entry]);
    if (take_entry) moved_[entry++] = static_cast<std::int64_t>(row);
    if (take_share) place_[share++] = row;
  }
  if (row > moved_.size()) {
    spread_rows(out.cell, 1, moved_, row);
    spread_rows(out.solid_volume, 1, moved_, row);
    spread_rows(out.debris_volume, 1, moved_, row);
    spread_rows(out.body_volume, out.bodies, moved_, row);
    spread_rows(out.wall_area, 3 * out.bodies, moved_, row);
    spread_rows(out.wall_velocity, 3 * out.bodies, moved_, row);
    spread_rows(out.wall_sweep, out.bodies, moved_, row);
    spread_rows(out.walled, 1, moved_, row);
    for (WallPiece& piece : out.pieces) piece.entry = moved_[static_cast<std::size_t>(piece.entry)];
  }
  for (std::size_t s = 0; s < shares_.size(); ++s) {
    out.cell[place_[s]] = shares_[s].cell;
    out.debris_volume[place_[s]] = shares_[s].volume;
  }
}

}  // namespace polynya::geometry
