#include "geometry/columns.hpp"

#include <algorithm>
#include <cmath>

namespace polynya::geometry {
namespace {

constexpr double negligible = 1e-12;       // of a cell or face: rounding
constexpr double negligible_wall = 1e-14;  // of the sum of a cell's face areas

double snapped(double fraction) {
  if (std::abs(fraction) < negligible) return 0.0;
  if (std::abs(fraction - 1.0) < negligible) return 1.0;
  return fraction;
}

/// One column: gathers the records, then walks down from the top, keeping what lies above.
class ColumnWalk {
 public:
  ColumnWalk(const GridLines& grid, std::span<const BodySurface> bodies, std::span<ColumnRecords> records,
             std::size_t column, ColumnChunk& chunk)
      : bodies_(bodies), records_(records), column_(column), chunk_(chunk), z_(grid.lines[2]) {
    const auto columns_x = static_cast<std::size_t>(grid.cells(0)) + 1;
    i_ = static_cast<std::int32_t>(column % columns_x);
    j_ = static_cast<std::int32_t>(column / columns_x);
    top_ = static_cast<std::int32_t>(grid.cells(2));
    dx_ = i_ < grid.cells(0) ? grid.width(0, i_) : 0.0;
    dy_ = j_ < grid.cells(1) ? grid.width(1, j_) : 0.0;
  }

  void run() {
    if (!gather()) return;
    chunk_.shade.assign(bodies_.size(), {});
    std::fill_n(chunk_.row_of_k.begin(), highest_ + 1, -1);
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
    note_rows_of_records();
    std::fill_n(chunk_.sums.begin(), static_cast<std::size_t>(highest_ + 1) * bodies_.size(), CellSum{});
    std::fill_n(chunk_.occupied.begin(), highest_ + 1, char{0});
  }

 private:
  CellSum& sum(std::int32_t k, std::size_t body) {
    return chunk_.sums[static_cast<std::size_t>(k) * bodies_.size() + body];
  }

  bool gather() {
    highest_ = -1;
    for (std::size_t b = 0; b < bodies_.size(); ++b)
      for (std::int32_t r = records_[b].start[column_]; r < records_[b].start[column_ + 1]; ++r)
        add(*records_[b].record[static_cast<std::size_t>(r)], b);
    return highest_ >= 0;
  }

  void add(const PieceRecord& piece, std::size_t b) {
    chunk_.occupied[static_cast<std::size_t>(piece.k)] = 1;
    highest_ = std::max(highest_, piece.k);
    CellSum& s = sum(piece.k, b);
    s.height_moment += piece.height_moment;
    s.x_extent += piece.x_extent, s.x_moment += piece.x_moment;
    s.y_extent += piece.y_extent, s.y_moment += piece.y_moment;
    const double wall =
        std::sqrt(piece.area[0] * piece.area[0] + piece.area[1] * piece.area[1] + piece.area[2] * piece.area[2]);
    s.wall += wall;
    const std::int32_t* vertex = bodies_[b].triangles.data() + 3 * static_cast<std::size_t>(piece.triangle);
    for (std::size_t c = 0; c < 3; ++c) {
      const double* velocity = bodies_[b].velocities.data() + 3 * static_cast<std::size_t>(vertex[c]);
      for (std::size_t d = 0; d < 3; ++d) s.weighted_velocity[d] += wall * piece.weights[c] * velocity[d];
    }
    for (std::size_t d = 0; d < 3; ++d) s.area[d] += piece.area[d];
  }

  double height(std::int32_t k) const { return z_[static_cast<std::size_t>(k) + 1] - z_[static_cast<std::size_t>(k)]; }

  /// Volumes, x-faces and y-faces of `count` cells from k upward: what lies inside them and under the shade of what
  /// lies above. There is only one when there is surface inside.
  void cells(std::int32_t k, std::int32_t count) {
    const double dz = height(k);
    if (dy_ > 0)
      faces(0, k, count, dy_, [&](std::size_t b) { return sum(k, b).x_moment / dz + chunk_.shade[b].x_extent; });
    if (dx_ > 0)
      faces(1, k, count, dx_, [&](std::size_t b) { return sum(k, b).y_moment / dz + chunk_.shade[b].y_extent; });
    if (!(dx_ > 0 && dy_ > 0)) return;
    const double least_wall = negligible_wall * (dx_ * dy_ + dy_ * dz + dz * dx_);
    bool present = false;
    double total = 0;
    const std::size_t first = chunk_.cells.values.size();
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      const CellSum& s = sum(k, b);
      const double solid = snapped((s.height_moment / dz + chunk_.shade[b].area) / (dx_ * dy_));
      const double per_wall = s.wall > 0 ? 1.0 / s.wall : 0.0;
      present = present || solid != 0 || s.wall > least_wall;
      total += solid;
      chunk_.cells.values.insert(chunk_.cells.values.end(),
                                 {solid, s.area[0], s.area[1], s.area[2], per_wall * s.weighted_velocity[0],
                                  per_wall * s.weighted_velocity[1], per_wall * s.weighted_velocity[2]});
    }
    if (!present) return chunk_.cells.values.resize(first);
    chunk_.row_of_k[static_cast<std::size_t>(k)] = static_cast<std::int32_t>(chunk_.cells.size());
    chunk_.cells.place.push_back({i_, j_, k, count});
    if (total > 1.0 + 1e-9) chunk_.overlapping_cells += count;
  }

  /// After this the shade is what crosses the z-plane k.
  void take_into_shade(std::int32_t k) {
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      const CellSum& s = sum(k, b);
      chunk_.shade[b].area += s.area[2];
      chunk_.shade[b].x_extent += s.x_extent;
      chunk_.shade[b].y_extent += s.y_extent;
    }
  }

  void z_faces(std::int32_t k, std::int32_t count) {
    if (dx_ > 0 && dy_ > 0) faces(2, k, count, dx_ * dy_, [&](std::size_t b) { return chunk_.shade[b].area; });
  }

  /// Solid parts of `count` faces from k upward; `solid` and `whole` are areas, for x and y per height.
  template <class Solid>
  void faces(std::size_t axis, std::int32_t k, std::int32_t count, double whole, Solid&& solid) {
    Rows& rows = chunk_.faces[axis];
    const std::size_t first = rows.values.size();
    bool present = false;
    double total = 0;
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      const double fraction = snapped(solid(b) / whole);
      present = present || fraction != 0;
      total += fraction;
      rows.values.push_back(fraction);
    }
    if (!present) return rows.values.resize(first);
    rows.place.push_back({i_, j_, k, count});
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

  void note_rows_of_records() {
    for (ColumnRecords& body : records_)
      for (std::int32_t r = body.start[column_]; r < body.start[column_ + 1]; ++r) {
        const PieceRecord& piece = *body.record[static_cast<std::size_t>(r)];
        const bool area = piece.area[0] != 0 || piece.area[1] != 0 || piece.area[2] != 0;
        const std::int32_t row = area && piece.k < top_ ? chunk_.row_of_k[static_cast<std::size_t>(piece.k)] : -1;
        body.row[static_cast<std::size_t>(r)] = row;
        chunk_.pieces += row >= 0;
      }
  }

  std::span<const BodySurface> bodies_;
  std::span<ColumnRecords> records_;
  std::size_t column_;
  ColumnChunk& chunk_;
  const std::vector<double>& z_;
  std::int32_t i_ = 0, j_ = 0, top_ = 0, highest_ = -1;
  double dx_ = 0, dy_ = 0;
};

}  // namespace

void Rows::count_levels(std::size_t levels) {
  next.assign(levels + 1, 0);
  for (const Place& at : place) {  // the ends of the runs first, then their sum
    ++next[static_cast<std::size_t>(at.k)];
    --next[static_cast<std::size_t>(at.k + at.count)];
  }
  for (std::size_t k = 1; k <= levels; ++k) next[k] += next[k - 1];
}

void ColumnChunk::clear() {
  cells.clear();
  for (Rows& rows : faces) rows.clear();
  excesses.clear();
  pieces = 0;
  overlapping_cells = 0;
}

void ColumnRecords::sort(const std::vector<std::vector<PieceRecord>>& chunks, std::size_t columns,
                         std::int32_t columns_x) {
  const auto column = [&](const PieceRecord& p) { return static_cast<std::size_t>(p.i + columns_x * p.j); };
  start.assign(columns + 2, 0);
  for (const auto& chunk : chunks)
    for (const PieceRecord& piece : chunk) ++start[column(piece) + 2];
  for (std::size_t c = 2; c < start.size(); ++c) start[c] += start[c - 1];
  record.resize(static_cast<std::size_t>(start.back()));
  row.resize(record.size());
  for (const auto& chunk : chunks)  // start[c + 1] runs from the beginning of column c to its end
    for (const PieceRecord& piece : chunk) record[static_cast<std::size_t>(start[column(piece) + 1]++)] = &piece;
}

void sum_columns(const GridLines& grid, std::span<const BodySurface> bodies, std::span<ColumnRecords> records,
                 std::size_t begin, std::size_t end, ColumnChunk& chunk) {
  chunk.clear();
  const auto slabs = static_cast<std::size_t>(grid.cells(2)) + 1;
  chunk.row_of_k.resize(slabs);
  chunk.occupied.resize(slabs, 0);
  if (chunk.sums.size() != slabs * bodies.size()) chunk.sums.assign(slabs * bodies.size(), CellSum{});
  for (std::size_t column = begin; column < end; ++column) ColumnWalk(grid, bodies, records, column, chunk).run();
  chunk.cells.count_levels(slabs);
  for (Rows& rows : chunk.faces) rows.count_levels(slabs);
}

}  // namespace polynya::geometry
