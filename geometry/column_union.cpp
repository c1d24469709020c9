#include "geometry/column_union.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace polynya::geometry {
namespace {

constexpr double negligible = 1e-13;  // of a cell's largest face: what shifts and rounding leave
constexpr double rounding = 5e-14;    // of a face or an edge
constexpr double whole_number = 1e-9;

JointTriangle triangle_of(const BodySurface& surface, const UnionBody& body, std::int32_t triangle) {
  JointTriangle t;
  for (std::size_t c = 0; c < 3; ++c) {
    t.vertex[c] = surface.triangles[3 * static_cast<std::size_t>(triangle) + c];
    const auto v = static_cast<std::size_t>(t.vertex[c]);
    t.corner[c] = {body.corners[v].x, body.shifts[v]};
  }
  return t;
}

double wall_of(const PieceRecord& piece) {
  return std::sqrt(piece.area[0] * piece.area[0] + piece.area[1] * piece.area[1] + piece.area[2] * piece.area[2]);
}

void add_whole(const PieceRecord& piece, double times, JointSum& sum) {
  const double wall = times * wall_of(piece);
  for (std::size_t d = 0; d < 3; ++d) {
    sum.area[d] += times * piece.area[d];
    sum.weighted[d] += wall * piece.weights[d];
  }
  sum.wall += wall;
  sum.height_moment += times * piece.height_moment;
  sum.x_extent += times * piece.x_extent, sum.x_moment += times * piece.x_moment;
  sum.y_extent += times * piece.y_extent, sum.y_moment += times * piece.y_moment;
}

void add(const JointSum& part, const BodySurface& surface, std::int32_t triangle, CellSum& sum) {
  const std::int32_t* vertex = surface.triangles.data() + 3 * static_cast<std::size_t>(triangle);
  std::array<double, 3> velocity{};
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t d = 0; d < 3; ++d)
      velocity[d] += part.weighted[c] * surface.velocities[3 * static_cast<std::size_t>(vertex[c]) + d];
  for (std::size_t d = 0; d < 3; ++d) {
    sum.area[d] += part.area[d];
    sum.weighted_velocity[d] += velocity[d];
    if (part.wall != 0) sum.sweep += part.area[d] / part.wall * velocity[d];
  }
  sum.wall += part.wall;
  sum.height_moment += part.height_moment;
  sum.x_extent += part.x_extent, sum.x_moment += part.x_moment;
  sum.y_extent += part.y_extent, sum.y_moment += part.y_moment;
}

class ColumnUnion {
 public:
  ColumnUnion(const UnitedColumn& at, ColumnChunk& chunk) : at_(at), chunk_(chunk), bodies_(at.bodies.size()) {
    const auto low = [&](std::size_t axis, std::int32_t c) { return at.grid.lines[axis][static_cast<std::size_t>(c)]; };
    cell_.last = {at.i == at.grid.cells(0), at.j == at.grid.cells(1)};
    i_ = cell_.last[0] ? at.i - 1 : at.i;
    j_ = cell_.last[1] ? at.j - 1 : at.j;
    cell_.low = {low(0, i_), low(1, j_), 0};
    cell_.high = {low(0, i_ + 1), low(1, j_ + 1), 0};
    base_ = at.grid.width(0, i_) * at.grid.width(1, j_);
    top_ = static_cast<std::int32_t>(at.grid.cells(2));
  }

  bool run() {
    std::size_t present = 0;
    for (std::size_t b = 0; b < bodies_; ++b) present += !records(b, i_, j_).empty();
    if (present < 2) return false;
    sum_from_above();
    for (std::size_t a = 0; a < bodies_; ++a)
      for (const PieceRecord* const& piece : records(a, at_.i, at_.j)) unite_piece(a, piece);
    for (const std::vector<std::int32_t>* cells : {&united_, &exact_, &doubted_}) count(*cells);
    return any_;
  }

 private:
  std::size_t column(std::int32_t i, std::int32_t j) const {
    return static_cast<std::size_t>(i + (at_.grid.cells(0) + 1) * j);
  }

  std::span<const PieceRecord* const> records(std::size_t body, std::int32_t i, std::int32_t j) const {
    const std::size_t number = column(i, j);
    const ColumnChunk& chunk = at_.chunks[number / column_chunk];
    const std::int32_t* first = chunk.first.data() + body * (column_chunk + 1) + number % column_chunk;
    return {chunk.record.data() + first[0], static_cast<std::size_t>(first[1] - first[0])};
  }

  std::size_t place(std::int32_t k, std::size_t body) const { return static_cast<std::size_t>(k) * bodies_ + body; }

  /// Area of a body that crosses the plane at the lower end of a slab, and whether it has surface in the slab.
  void sum_from_above() {
    for (std::size_t b = 0; b < bodies_; ++b)
      for (const PieceRecord* piece : records(b, i_, j_)) highest_ = std::max(highest_, piece->k);
    const std::size_t slabs = static_cast<std::size_t>(highest_) + 1;
    chunk_.surface.assign(slabs * bodies_, 0);
    chunk_.above.assign((slabs + 1) * bodies_, 0.0);
    for (std::size_t b = 0; b < bodies_; ++b) {
      for (const PieceRecord* piece : records(b, i_, j_)) {
        chunk_.surface[place(piece->k, b)] = 1;
        chunk_.above[place(piece->k, b)] += piece->area[2];
      }
      for (std::int32_t k = highest_; k-- > 0;) chunk_.above[place(k, b)] += chunk_.above[place(k + 1, b)];
    }
  }

  bool has_surface(std::int32_t k, std::size_t body) const {
    return k <= highest_ && chunk_.surface[place(k, body)] != 0;
  }

  /// How often a body covers a slab without surface of it, of which it fills all or nothing.
  double cover(std::int32_t k, std::size_t body) {
    if (k > highest_) return 0;
    const double fraction = chunk_.above[place(k, body)] / base_, cover = std::round(fraction);
    if (std::abs(fraction - cover) > whole_number) doubted_.push_back(k);
    return cover;
  }

  void unite_piece(std::size_t a, const PieceRecord* const& piece) {
    JointSum inside;
    int found = 0;
    for (std::size_t b = 0; b < bodies_; ++b)
      if (b != a && !records(b, i_, j_).empty()) found += add_inside(a, b, *piece, inside);
    if (found == 0) return;
    if (found > 1) doubted_.push_back(piece->k);  // what three have in common is not what pairs have
    any_ = true;
    add(inside, at_.bodies[a], piece->triangle, chunk_.removed[place(piece->k, a)]);
    if (std::abs(inside.wall) <= negligible * largest_face(piece->k)) return;
    united_.push_back(piece->k);
    chunk_.parts.push_back(remainder(*piece, inside));
    chunk_.parts.back().record = &piece - chunk_.record.data();
  }

  /// Adds what of a piece of body `a` lies in body `b`; false if nothing does.
  bool add_inside(std::size_t a, std::size_t b, const PieceRecord& piece, JointSum& inside) {
    const JointTriangle triangle = triangle_of(at_.bodies[a], at_.method.bodies[a], piece.triangle);
    double times = 0;
    if (const std::array<std::int32_t, 2> beside = across_plane(triangle); beside[0] >= 0) {
      list_triangles(b, piece.k, highest_ + 1);
      list_triangles_beside(b, beside, piece.k);
    } else {
      std::int32_t free = piece.k;  // the next slab without surface of b
      while (has_surface(free, b)) ++free;
      times = cover(free, b);
      if (free == piece.k) {
        if (times != 0) add_whole(piece, times, inside);
        return times != 0;
      }
      list_triangles(b, piece.k, free);
    }
    cell_.low[2] = at_.grid.lines[2][static_cast<std::size_t>(piece.k)];
    cell_.high[2] = piece.k < top_ ? at_.grid.lines[2][static_cast<std::size_t>(piece.k) + 1]
                                   : std::numeric_limits<double>::infinity();
    JointSum whole, sum = add_below(triangle, piece.k);
    if (cell_.last[0] || cell_.last[1])  // its column has the rest
      sum = {.x_extent = cell_.last[0] ? sum.x_extent : 0,
             .x_moment = cell_.last[0] ? sum.x_moment : 0,
             .y_extent = cell_.last[1] ? sum.y_extent : 0,
             .y_moment = cell_.last[1] ? sum.y_moment : 0};
    if (times != 0) add_whole(piece, times, sum);
    add_whole(piece, 1.0, whole);
    if (agrees(sum, {}, piece.k)) return false;
    add_sum(agrees(sum, whole, piece.k) ? whole : sum, inside);
    return true;
  }

  /// The column behind the plane of the grid that a triangle lies on, {-1, -1}: it lies on none. Shifted, the triangle
  /// may be below surface that only touches this column.
  std::array<std::int32_t, 2> across_plane(const JointTriangle& t) const {
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const double x = t.corner[0].x[axis];
      if (t.corner[1].x[axis] != x || t.corner[2].x[axis] != x) continue;
      std::array<std::int32_t, 2> beside{i_, j_};
      if (x == cell_.low[axis]) --beside[axis];
      if (x == cell_.high[axis]) ++beside[axis];
      const bool other = beside[axis] != (axis == 0 ? i_ : j_);
      if (other && beside[axis] >= 0 && beside[axis] < at_.grid.cells(static_cast<int>(axis))) return beside;
    }
    return {-1, -1};
  }

  /// The triangles of a body in the slabs [low, high) of the column.
  void list_triangles(std::size_t b, std::int32_t low, std::int32_t high) {
    others_.clear();
    listed_.clear();
    std::int32_t last = -1;
    for (const PieceRecord* other : records(b, i_, j_)) {
      if (other->k < low || other->k >= high || other->triangle == last) continue;
      last = other->triangle;
      others_.push_back(triangle_of(at_.bodies[b], at_.method.bodies[b], last));
      listed_.push_back(last);
    }
  }

  /// Of another column those from slab `low` up that this column does not have.
  void list_triangles_beside(std::size_t b, const std::array<std::int32_t, 2>& beside, std::int32_t low) {
    std::int32_t last = -1;
    const std::size_t own = others_.size();
    for (const PieceRecord* other : records(b, beside[0], beside[1])) {
      if (other->k < low || other->triangle == last) continue;
      last = other->triangle;
      const auto end = listed_.begin() + static_cast<std::ptrdiff_t>(own);
      if (std::find(listed_.begin(), end, last) != end) continue;
      others_.push_back(triangle_of(at_.bodies[b], at_.method.bodies[b], last));
    }
  }

  /// To rounding: a piece that lies wholly outside or inside stays or goes as it is.
  bool agrees(const JointSum& a, const JointSum& b, std::int32_t k) const {
    const double dx = cell_.high[0] - cell_.low[0], dy = cell_.high[1] - cell_.low[1];
    return std::abs(a.wall - b.wall) <= rounding * largest_face(k) &&
           std::abs(a.x_extent - b.x_extent) <= rounding * dy && std::abs(a.y_extent - b.y_extent) <= rounding * dx;
  }

  JointSum add_below(const JointTriangle& piece, std::int32_t k) {
    JointSum sum;
    if (!at_.method.always_exact && add_below_packed(cell_, piece, others_, sum)) return sum;
    sum = {};
    if (at_.method.exact) {
      exact_.push_back(k);
      at_.method.exact(cell_, piece, others_, sum);
    } else {
      doubted_.push_back(k);
    }
    return sum;
  }

  static void add_sum(const JointSum& from, JointSum& to) {
    for (std::size_t d = 0; d < 3; ++d) to.area[d] += from.area[d], to.weighted[d] += from.weighted[d];
    to.wall += from.wall, to.height_moment += from.height_moment;
    to.x_extent += from.x_extent, to.x_moment += from.x_moment;
    to.y_extent += from.y_extent, to.y_moment += from.y_moment;
  }

  double largest_face(std::int32_t k) const {
    const double dx = cell_.high[0] - cell_.low[0], dy = cell_.high[1] - cell_.low[1];
    const double dz = k < top_ ? at_.grid.width(2, k) : 0.0;
    return std::max({dx * dy, dy * dz, dz * dx});
  }

  PiecePart remainder(const PieceRecord& piece, const JointSum& inside) const {
    PiecePart part;
    const double wall = wall_of(piece), rest = wall - inside.wall;
    if (std::abs(rest) <= negligible * largest_face(piece.k)) return part;
    for (std::size_t d = 0; d < 3; ++d) {
      part.area[d] = piece.area[d] - inside.area[d];
      part.weights[d] = (wall * piece.weights[d] - inside.weighted[d]) / rest;
    }
    return part;
  }

  void count(const std::vector<std::int32_t>& cells) {
    std::vector<std::int32_t> levels(cells);
    std::ranges::sort(levels);
    const auto number = std::ranges::unique(levels).begin() - levels.begin();
    (&cells == &united_  ? chunk_.united_cells
     : &cells == &exact_ ? chunk_.united_exactly
                         : chunk_.doubted_unions) += number;
  }

  const UnitedColumn& at_;
  ColumnChunk& chunk_;
  std::size_t bodies_;
  JointCell cell_{};
  double base_ = 0;             // m^2
  std::int32_t i_ = 0, j_ = 0;  // of the cells; in the column beyond the last one, those of the last
  std::int32_t top_ = 0, highest_ = -1;
  bool any_ = false;
  std::vector<JointTriangle> others_;
  std::vector<std::int32_t> listed_;                    // numbers of others_ from this column
  std::vector<std::int32_t> united_, exact_, doubted_;  // slabs
};

}  // namespace

bool unite(const UnitedColumn& column, ColumnChunk& chunk) {
  return ColumnUnion(column, chunk).run();
}

}  // namespace polynya::geometry
