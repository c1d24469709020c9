#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/contact/vector3.hpp"

namespace polynya::contact {

/// Uniform grid over a box that lists, per cell, the triangles within a reach of it: the broad phase of contact.
class TriangleGrid {
 public:
  /// Lists triangles [nt][3] over positions [nv][3], each inflated by reach (m), in the part of space [low, high].
  /// Buffers are kept between calls.
  void build(std::span<const double> positions, std::span<const std::int32_t> triangles, const Vector3& low,
             const Vector3& high, double cell_size, double reach);

  /// Triangles whose inflated box touches the cell that holds p; empty outside the grid.
  std::span<const std::int32_t> near(const Vector3& p) const;

 private:
  using Range = std::array<std::array<int, 2>, 3>;
  Range cells_of(std::span<const double> positions, std::span<const std::int32_t> triangles, std::size_t t,
                 double reach) const;
  template <class Visit>
  void for_each_cell(const Range& range, Visit&& visit) const;

  Vector3 low_{};
  double cell_size_ = 1;
  std::array<int, 3> count_{0, 0, 0};
  std::vector<std::int32_t> start_, list_, fill_;
};

}  // namespace polynya::contact
