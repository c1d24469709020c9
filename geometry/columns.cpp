#include "geometry/columns.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/column_union.hpp"

namespace polynya::geometry {
namespace {

constexpr double negligible = 1e-12;        // of a cell or face: rounding
constexpr std::size_t prefetch_ahead = 16;  // records
constexpr double negligible_rest = 1e-12;   // of a wall inside another body
constexpr double negligible_wall = 1e-14;   // of the sum of a cell's face areas

// Rounding moves a corner by a few parts in 2^53 of its coordinates, and the volume under it by that times the wall; a
// sum rounds each of its terms. Beyond this share of a cell a volume is not certain.
constexpr double rounding = 32 * 0x1p-53, largest_uncertainty = 1e-11;

double snapped(double fraction) {
  if (std::abs(fraction) < negligible) return 0.0;
  if (std::abs(fraction - 1.0) < negligible) return 1.0;
  return fraction;
}

/// One column: gathers the records, then walks down from the top, keeping what lies above.
class ColumnWalk {
 public:
  ColumnWalk(const GridLines& grid, std::span<const BodySurface> bodies, std::span<const double> reach,
             const UnionMethod& method, std::size_t column, std::span<ColumnChunk> chunks)
      : grid_(grid),
        bodies_(bodies),
        reach_(reach),
        method_(method),
        local_(column % column_chunk),
        chunks_(chunks),
        chunk_(chunks[column / column_chunk]),
        z_(grid.lines[2]) {
    const auto columns_x = static_cast<std::size_t>(grid.cells(0)) + 1;
    i_ = static_cast<std::int32_t>(column % columns_x);
    j_ = static_cast<std::int32_t>(column / columns_x);
    top_ = static_cast<std::int32_t>(grid.cells(2));
    dx_ = i_ < grid.cells(0) ? grid.width(0, i_) : 0.0;
    dy_ = j_ < grid.cells(1) ? grid.width(1, j_) : 0.0;
  }

  void run() {
    if (!gather()) return;
    const std::size_t parts = chunk_.parts.size();
    united_ = !method_.bodies.empty() && unite({grid_, bodies_, method_, chunks_, i_, j_}, chunk_);
    chunk_.shade.assign(bodies_.size(), {});
    chunk_.joint_shade.assign(bodies_.size(), {});
    for (std::int32_t k = highest_; k >= 0; --k) {
      if (chunk_.occupied[static_cast<std::size_t>(k)]) {
        if (k < top_) cells(k, 1);
        take_into_shade(k);
        z_faces(k, 1);
        continue;
      }
      const std::int32_t high = k;
      while (k > 0 && !chunk_.occupied[static_cast<std::size_t>(k) - 1]) --k;
      if (shade_is_negligible()) continue;
      cells(k, high - k + 1);
      z_faces(k, high - k + 1);
    }
    note_rows_of_records(parts);
    clear_sums();
  }

 private:
  CellSum& sum(std::int32_t k, std::size_t body) {
    return chunk_.sums[static_cast<std::size_t>(k) * bodies_.size() + body];
  }

  CellSum& removed(std::int32_t k, std::size_t body) {
    return chunk_.removed[static_cast<std::size_t>(k) * bodies_.size() + body];
  }

  /// What two bodies have in common is bounded by their surfaces inside one another.
  template <class Value>
  double joint(Value&& value) const {
    double total = 0;
    for (std::size_t b = 0; united_ && b < bodies_.size(); ++b) total += value(b);
    return total;
  }

  /// The column's records of one body.
  std::span<const PieceRecord*> records(std::size_t body) const {
    const std::int32_t* first = chunk_.first.data() + body * (column_chunk + 1) + local_;
    return {chunk_.record.data() + first[0], static_cast<std::size_t>(first[1] - first[0])};
  }

  bool gather() {
    highest_ = -1;
    for (std::size_t b = 0; b < bodies_.size(); ++b)
      for (const PieceRecord*& piece : records(b)) {
        prefetch(static_cast<std::size_t>(&piece - chunk_.record.data()) + prefetch_ahead);
        add(*piece, b);
      }
    return highest_ >= 0;
  }

  /// The records of a column lie apart from one another, and waiting for them is most of the work.
  void prefetch(std::size_t record) const {
    if (record >= chunk_.record.size()) return;
    const char* piece = reinterpret_cast<const char*>(chunk_.record[record]);
    __builtin_prefetch(piece);
    __builtin_prefetch(piece + 64);
    __builtin_prefetch(piece + sizeof(PieceRecord) - 1);
  }

  void clear_sums() {
    for (std::size_t b = 0; b < bodies_.size(); ++b)
      for (const PieceRecord* piece : records(b)) {
        sum(piece->k, b) = {};
        removed(piece->k, b) = {};
        chunk_.occupied[static_cast<std::size_t>(piece->k)] = 0;
      }
  }

  void add(const PieceRecord& piece, std::size_t b) {
    chunk_.occupied[static_cast<std::size_t>(piece.k)] = 1;
    chunk_.row_of_k[static_cast<std::size_t>(piece.k)] = -1;
    highest_ = std::max(highest_, piece.k);
    CellSum& s = sum(piece.k, b);
    s.height_moment += piece.height_moment;
    s.x_extent += piece.x_extent, s.x_moment += piece.x_moment;
    s.y_extent += piece.y_extent, s.y_moment += piece.y_moment;
    const double wall =
        std::sqrt(piece.area[0] * piece.area[0] + piece.area[1] * piece.area[1] + piece.area[2] * piece.area[2]);
    s.wall += wall;
    const std::array<double, 3> velocity = velocity_of(piece, bodies_[b]);
    s.sweep += piece.area[0] * velocity[0] + piece.area[1] * velocity[1] + piece.area[2] * velocity[2];
    for (std::size_t d = 0; d < 3; ++d) {
      s.weighted_velocity[d] += wall * velocity[d];
      s.area[d] += piece.area[d];
    }
  }

  static std::array<double, 3> velocity_of(const PieceRecord& piece, const BodySurface& body) {
    const std::int32_t* vertex = body.triangles.data() + 3 * static_cast<std::size_t>(piece.triangle);
    const std::array<const double*, 3> at{body.velocities.data() + 3 * static_cast<std::size_t>(vertex[0]),
                                          body.velocities.data() + 3 * static_cast<std::size_t>(vertex[1]),
                                          body.velocities.data() + 3 * static_cast<std::size_t>(vertex[2])};
    std::array<double, 3> velocity;
    for (std::size_t d = 0; d < 3; ++d)
      velocity[d] = piece.weights[0] * at[0][d] + piece.weights[1] * at[1][d] + piece.weights[2] * at[2][d];
    return velocity;
  }

  double height(std::int32_t k) const { return z_[static_cast<std::size_t>(k) + 1] - z_[static_cast<std::size_t>(k)]; }

  /// Volumes, x-faces and y-faces of `count` cells from k upward: what lies inside them and under the shade of what
  /// lies above. There is only one when there is surface inside.
  void cells(std::int32_t k, std::int32_t count) {
    const double dz = height(k);
    if (dy_ > 0)
      faces(
          0, k, count, dy_, [&](std::size_t b) { return sum(k, b).x_moment / dz + chunk_.shade[b].x_extent; },
          [&](std::size_t b) { return removed(k, b).x_moment / dz + chunk_.joint_shade[b].x_extent; });
    if (dx_ > 0)
      faces(
          1, k, count, dx_, [&](std::size_t b) { return sum(k, b).y_moment / dz + chunk_.shade[b].y_extent; },
          [&](std::size_t b) { return removed(k, b).y_moment / dz + chunk_.joint_shade[b].y_extent; });
    if (!(dx_ > 0 && dy_ > 0)) return;
    const double least_wall = negligible_wall * (dx_ * dy_ + dy_ * dz + dz * dx_);
    int present = 0;
    double total = 0;
    const std::size_t first = chunk_.cells.values.size(), doubted = chunk_.uncertain.size();
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      const CellSum& s = sum(k, b);
      const double solid = snapped((s.height_moment / dz + chunk_.shade[b].area) / (dx_ * dy_));
      const CellSum& r = removed(k, b);
      const double wetted = s.wall - r.wall;
      const double per_wall = wetted > negligible_rest * r.wall ? 1.0 / wetted : 0.0;
      present += solid != 0 || s.wall > least_wall;
      total += solid;
      const double doubt = rounding * (reach_[b] * s.wall + dz * (s.wall + chunk_.shade[b].wall));
      if (doubt > largest_uncertainty * dx_ * dy_ * dz)
        chunk_.uncertain.push_back({{i_, j_, k, count}, static_cast<std::int32_t>(b)});
      chunk_.cells.values.insert(chunk_.cells.values.end(),
                                 {solid, s.area[0] - r.area[0], s.area[1] - r.area[1], s.area[2] - r.area[2],
                                  per_wall * (s.weighted_velocity[0] - r.weighted_velocity[0]),
                                  per_wall * (s.weighted_velocity[1] - r.weighted_velocity[1]),
                                  per_wall * (s.weighted_velocity[2] - r.weighted_velocity[2]), s.sweep - r.sweep});
    }
    if (present == 0) {
      chunk_.uncertain.resize(doubted);
      return chunk_.cells.values.resize(first);
    }
    if (present > 1) chunk_.shared_cells += count;
    chunk_.row_of_k[static_cast<std::size_t>(k)] = static_cast<std::int32_t>(chunk_.cells.size());
    chunk_.cells.place.push_back({i_, j_, k, count});
    chunk_.cells.walled.push_back(0);
    const double common =
        joint([&](std::size_t b) { return removed(k, b).height_moment / dz + chunk_.joint_shade[b].area; });
    if (united_) total = snapped(total - common / (dx_ * dy_));
    chunk_.cells.total.push_back(total);
    if (total > 1.0 + 1e-9) chunk_.overlapping_cells += count;
  }

  /// After this the shade is what crosses the z-plane k.
  void take_into_shade(std::int32_t k) {
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      take(sum(k, b), chunk_.shade[b]);
      if (united_) take(removed(k, b), chunk_.joint_shade[b]);
    }
  }

  static void take(const CellSum& sum, ColumnShade& shade) {
    shade.area += sum.area[2];
    shade.x_extent += sum.x_extent;
    shade.y_extent += sum.y_extent;
    shade.wall += sum.wall;
  }

  void z_faces(std::int32_t k, std::int32_t count) {
    if (dx_ > 0 && dy_ > 0)
      faces(
          2, k, count, dx_ * dy_, [&](std::size_t b) { return chunk_.shade[b].area; },
          [&](std::size_t b) { return chunk_.joint_shade[b].area; });
  }

  /// Solid parts of `count` faces from k upward; `solid`, `common` and `whole` are areas, for x and y per height.
  template <class Solid, class Common>
  void faces(std::size_t axis, std::int32_t k, std::int32_t count, double whole, Solid&& solid, Common&& common) {
    bool present = false;
    double total = 0;
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      const double fraction = snapped(solid(b) / whole);
      present = present || fraction != 0;
      total += fraction;
    }
    if (!present) return;
    if (united_) total = snapped(total - joint(common) / whole);
    chunk_.faces[axis].place.push_back({i_, j_, k, count});
    chunk_.faces[axis].values.push_back(std::clamp(total, 0.0, 1.0));
    const double excess = total - std::clamp(total, 0.0, 1.0);
    if (std::abs(excess) <= negligible) return;
    for (std::int32_t level = k; level < k + count; ++level)
      chunk_.excesses.push_back(
          {static_cast<std::int32_t>(axis), i_, j_, level, excess * whole * (axis < 2 ? height(level) : 1.0)});
  }

  bool shade_is_negligible() const {
    return std::ranges::all_of(chunk_.shade, [&](const ColumnShade& s) {
      return std::abs(s.area) <= negligible * dx_ * dy_ && (dy_ == 0 || std::abs(s.x_extent) <= negligible * dy_) &&
             (dx_ == 0 || std::abs(s.y_extent) <= negligible * dx_);
    });
  }

  void note_rows_of_records(std::size_t part) {
    for (std::size_t b = 0; b < bodies_.size(); ++b)
      for (const PieceRecord*& piece : records(b)) {
        const std::ptrdiff_t record = &piece - chunk_.record.data();
        const bool reduced = part < chunk_.parts.size() && chunk_.parts[part].record == record;
        const std::array<double, 3>& left = reduced ? chunk_.parts[part++].area : piece->area;
        const bool area = left[0] != 0 || left[1] != 0 || left[2] != 0;
        const std::int32_t row = area && piece->k < top_ ? chunk_.row_of_k[static_cast<std::size_t>(piece->k)] : -1;
        chunk_.row[static_cast<std::size_t>(record)] = row;
        if (row < 0) continue;
        chunk_.cells.walled[static_cast<std::size_t>(row)] = 1;
        ++chunk_.pieces[b][static_cast<std::size_t>(piece->triangle) / triangle_chunk];
      }
  }

  const GridLines& grid_;
  std::span<const BodySurface> bodies_;
  std::span<const double> reach_;
  const UnionMethod& method_;
  std::size_t local_;  // number of the column within the chunk
  std::span<ColumnChunk> chunks_;
  ColumnChunk& chunk_;
  const std::vector<double>& z_;
  std::int32_t i_ = 0, j_ = 0, top_ = 0, highest_ = -1;
  double dx_ = 0, dy_ = 0;
  bool united_ = false;  // bodies have surface inside one another
};

}  // namespace

void Rows::sort(std::size_t levels) {
  start.assign(levels + 1, 0);
  for (const Place& at : place) {  // the ends of the runs first, then their sum
    ++start[static_cast<std::size_t>(at.k)];
    --start[static_cast<std::size_t>(at.k + at.count)];
  }
  for (std::size_t k = 1; k <= levels; ++k) start[k] += start[k - 1];
  std::int32_t total = 0;
  for (std::int32_t& count : start) total += std::exchange(count, total);
  order.resize(static_cast<std::size_t>(total));
  first.assign(start.begin(), start.end() - 1);  // meanwhile: where the next one of the level goes in `order`
  for (std::size_t r = 0; r < size(); ++r)
    for (std::int32_t k = place[r].k; k < place[r].k + place[r].count; ++k)
      order[static_cast<std::size_t>(first[static_cast<std::size_t>(k)]++)] = static_cast<std::int32_t>(r);
}

namespace {

void clear(ColumnChunk& chunk, std::size_t bodies, std::size_t slabs) {
  chunk.cells.clear();
  for (Rows& rows : chunk.faces) rows.clear();
  chunk.excesses.clear();
  chunk.uncertain.clear();
  chunk.shared_cells = chunk.overlapping_cells = 0;
  chunk.united_cells = chunk.united_exactly = chunk.doubted_unions = 0;
  chunk.parts.clear();
  chunk.row_of_k.resize(slabs, -1);
  chunk.occupied.resize(slabs, 0);
  if (chunk.sums.size() != slabs * bodies) chunk.sums.assign(slabs * bodies, CellSum{});
  if (chunk.removed.size() != slabs * bodies) chunk.removed.assign(slabs * bodies, CellSum{});
}

/// Sorts the records in the columns from `begin` on by body and column; triangles keep their order.
void take_records(std::span<std::vector<ClippedChunk>> clipped, std::size_t begin, ColumnChunk& chunk) {
  const std::size_t bucket = begin / column_chunk;
  constexpr std::size_t stride = column_chunk + 1;
  chunk.first.assign(clipped.size() * stride, 0);
  chunk.pieces.resize(clipped.size());
  const auto for_all = [&](std::size_t b, auto&& action) {
    for (ClippedChunk& part : clipped[b])
      for (std::int32_t r = part.start[bucket]; r < part.start[bucket + 1]; ++r) {
        const ClippedChunk::InColumn& at = part.by_columns[static_cast<std::size_t>(r)];
        action(static_cast<std::size_t>(at.column) - begin, part, static_cast<std::size_t>(at.record));
      }
  };
  std::int32_t total = 0;
  for (std::size_t b = 0; b < clipped.size(); ++b) {
    chunk.pieces[b].assign(clipped[b].size(), 0);
    std::int32_t* first = chunk.first.data() + b * stride;
    for_all(b, [&](std::size_t column, ClippedChunk&, std::size_t) { ++first[column]; });
    for (std::size_t c = 0; c < stride; ++c) total += std::exchange(first[c], total);
  }
  chunk.record.resize(static_cast<std::size_t>(total));
  chunk.entry.resize(chunk.record.size());
  chunk.row.resize(chunk.record.size());
  for (std::size_t b = 0; b < clipped.size(); ++b) {
    std::int32_t* first = chunk.first.data() + b * stride;
    for_all(b, [&](std::size_t column, ClippedChunk& part, std::size_t record) {
      const auto at = static_cast<std::size_t>(first[column]++);
      chunk.record[at] = &part.records[record];
      chunk.entry[at] = &part.entry[record];
    });
    for (std::size_t c = stride - 1; c > 0; --c) first[c] = first[c - 1];  // back from the ends to the beginnings
    first[0] = b == 0 ? 0 : first[-1];
  }
}

}  // namespace

void gather_columns(const GridLines& grid, std::span<std::vector<ClippedChunk>> clipped, std::size_t begin,
                    ColumnChunk& chunk) {
  clear(chunk, clipped.size(), static_cast<std::size_t>(grid.cells(2)) + 1);
  take_records(clipped, begin, chunk);
}

void sum_columns(const GridLines& grid, std::span<const BodySurface> bodies, std::span<const double> reach,
                 const UnionMethod& method, std::size_t begin, std::size_t end, std::span<ColumnChunk> chunks) {
  ColumnChunk& chunk = chunks[begin / column_chunk];
  for (std::size_t column = begin; column < end; ++column)
    ColumnWalk(grid, bodies, reach, method, column, chunks).run();
  const auto slabs = static_cast<std::size_t>(grid.cells(2)) + 1;
  chunk.cells.sort(slabs);
  for (Rows& rows : chunk.faces) rows.sort(slabs);
}

}  // namespace polynya::geometry
