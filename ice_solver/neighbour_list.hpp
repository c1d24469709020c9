#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "ice_solver/points.hpp"

namespace polynya::ice {

/// Planes x = 0 and y = 0 on which the model is cut; material lies on their positive side.
struct SymmetryPlanes {
  bool x = false, y = false;
};

/// A point of the sums: a particle or an element, or its mirror image.
struct PointSource {
  std::int32_t index = 0;
  bool element = false;
  std::uint8_t mirror = 0;  ///< bit 0: reflected in x = 0, bit 1: in y = 0
};

/// Rows of neighbours of all particles (every point within reach) and of all elements (only particles within reach),
/// found by a sorted cell list and padded to whole packs with the index of an empty point. Reach is
/// h_i + h_j + skin, so the list holds until some point has moved half the skin.
class NeighbourList {
 public:
  static constexpr std::size_t chunk = 128;  ///< rows per chunk of work

  struct Row {
    std::int32_t point = 0;       ///< whose row it is
    std::int32_t first = 0;       ///< where it starts in its chunk's buffer
    std::int32_t length = 0;      ///< padded
    std::int32_t neighbours = 0;  ///< without padding
  };

  /// bonds_only: a particle and an element are neighbours only if their origins are nearer than both bond reaches.
  /// Throws std::runtime_error naming the first point whose position is not finite.
  void build(const Points& particles, const Points& elements, SymmetryPlanes planes, double skin,
             bool bonds_only = false);
  /// True if points were added or removed or one of them moved by more than half the skin since build().
  bool outdated(const Points& particles, const Points& elements) const;

  std::span<const PointSource> points() const { return points_; }
  std::span<const Row> rows() const { return rows_; }
  const std::int32_t* row_begin(std::size_t row) const { return buffers_[row / chunk].data() + rows_[row].first; }
  std::int32_t empty_point() const { return static_cast<std::int32_t>(points_.size()); }
  /// Pairs counted once per side, without padding.
  std::size_t entries() const;
  std::size_t builds() const { return builds_; }

  /// The list itself is kept: built anew it would hold other neighbours in another order.
  POLYNYA_STATE_WITHOUT((x_, y_, z_, h_, origin_, keys_), points_, x_, y_, z_, h_, origin_, bonds_only_, keys_,
                        stride_y_, stride_z_, rows_, buffers_, built_particles_, built_elements_, skin_, builds_)

 private:
  struct Range {  // of points in sorted order
    std::size_t low, high;
  };
  /// Candidates for the points of one cell: the three cells along x are contiguous, so nine ranges hold all 27.
  std::array<Range, 9> ranges_around(std::int64_t key) const;
  void append_neighbours(std::size_t i, const Range& range, double skin, std::vector<std::int32_t>& buffer) const;
  void collect_points(const Points& particles, const Points& elements, SymmetryPlanes planes, double reach);
  void sort_into_cells(double cell);
  void fill_rows(double skin);

  std::vector<PointSource> points_;
  bool bonded(std::size_t i, std::size_t j) const;

  std::vector<double> x_, y_, z_, h_;          // of the points in sorted order
  std::vector<std::array<double, 4>> origin_;  // and their origins with the bond reach
  bool bonds_only_ = false;
  std::vector<std::int64_t> keys_;  // cell of each point, ascending
  std::int64_t stride_y_ = 0, stride_z_ = 0;
  std::vector<Row> rows_;
  std::vector<std::vector<std::int32_t>> buffers_;
  std::vector<double> built_particles_, built_elements_;
  double skin_ = 0;
  std::size_t builds_ = 0;
};

/// Coordinates and axial signs of a mirror image.
struct MirrorSigns {
  double x, y;
  explicit MirrorSigns(std::uint8_t mirror) : x(mirror & 1 ? -1.0 : 1.0), y(mirror & 2 ? -1.0 : 1.0) {}
};

}  // namespace polynya::ice
