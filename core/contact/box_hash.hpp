#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/contact/vector3.hpp"

namespace polynya::contact {

/// Box with faces normal to the axes.
struct Box {
  Vector3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  void include(const Vector3& p) {
    for (std::size_t d = 0; d < 3; ++d) {
      if (p[d] < low[d]) low[d] = p[d];
      if (p[d] > high[d]) high[d] = p[d];
    }
  }
  void grow(double margin) {
    for (std::size_t d = 0; d < 3; ++d) low[d] -= margin, high[d] += margin;
  }
  bool meets(const Box& other) const {
    for (std::size_t d = 0; d < 3; ++d)
      if (other.high[d] < low[d] || other.low[d] > high[d]) return false;
    return true;
  }
  /// Distance of a point from the box, m; 0 inside.
  double distance(const Vector3& p) const {
    double squared = 0;
    for (std::size_t d = 0; d < 3; ++d) {
      const double away = p[d] < low[d] ? low[d] - p[d] : p[d] > high[d] ? p[d] - high[d] : 0.0;
      squared += away * away;
    }
    return std::sqrt(squared);
  }
};

/// Broad phase of contact: boxes filed under the cells of a uniform grid that they touch, cells hashed into a table, so
/// that memory does not depend on how far things fly apart. Buffers are kept between builds.
class BoxHash {
 public:
  /// Files the parts of boxes within `region`. Cells of this size (m), or larger if the region is very large.
  void build(std::span<const Box> boxes, const Box& region, double cell_size);

  /// Calls visit(index) for boxes filed under the cell of p, a point of the region: every box that holds p, others too,
  /// some more than once.
  template <class Visit>
  void visit_near(const Vector3& p, Visit&& visit) const {
    if (start_.empty()) return;
    const std::size_t bucket = bucket_of(cell(p[0]), cell(p[1]), cell(p[2]));
    for (std::int32_t k = start_[bucket]; k < start_[bucket + 1]; ++k) visit(list_[static_cast<std::size_t>(k)]);
  }

 private:
  std::int64_t cell(double x) const { return static_cast<std::int64_t>(std::floor(x * inverse_size_)); }
  std::size_t bucket_of(std::int64_t i, std::int64_t j, std::int64_t k) const {
    // Teschner et al. 2003, Optimized spatial hashing for collision detection of deformable objects.
    const auto mixed = static_cast<std::uint64_t>(i) * 73856093u ^ static_cast<std::uint64_t>(j) * 19349663u ^
                       static_cast<std::uint64_t>(k) * 83492791u;
    return static_cast<std::size_t>(mixed) & mask_;
  }
  template <class Visit>
  void for_each_bucket(const Box& box, const Box& region, Visit&& visit) const;

  double inverse_size_ = 1;
  std::size_t mask_ = 0;
  std::vector<std::int32_t> start_, list_, fill_;
};

}  // namespace polynya::contact
