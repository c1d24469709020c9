#include "core/contact/triangle_grid.hpp"

#include <algorithm>

namespace polynya::contact {

TriangleGrid::Range TriangleGrid::cells_of(std::span<const double> positions, std::span<const std::int32_t> triangles,
                                           std::size_t t, double reach) const {
  Range range;
  for (int d = 0; d < 3; ++d) {
    const double a = positions[3 * triangles[3 * t] + d], b = positions[3 * triangles[3 * t + 1] + d],
                 c = positions[3 * triangles[3 * t + 2] + d];
    const double low = std::min({a, b, c}) - reach, high = std::max({a, b, c}) + reach;
    range[d][0] = std::max(0, static_cast<int>(std::floor((low - low_[d]) / cell_size_)));
    range[d][1] = std::min(count_[d] - 1, static_cast<int>(std::floor((high - low_[d]) / cell_size_)));
  }
  return range;
}

template <class Visit>
void TriangleGrid::for_each_cell(const Range& range, Visit&& visit) const {
  for (int k = range[2][0]; k <= range[2][1]; ++k)
    for (int j = range[1][0]; j <= range[1][1]; ++j)
      for (int i = range[0][0]; i <= range[0][1]; ++i)
        visit(static_cast<std::size_t>(i + count_[0] * (j + count_[1] * k)));
}

void TriangleGrid::build(std::span<const double> positions, std::span<const std::int32_t> triangles,
                         const Vector3& low, const Vector3& high, double cell_size, double reach) {
  low_ = low;
  cell_size_ = cell_size;
  std::size_t cells = 1;
  for (int d = 0; d < 3; ++d) {
    count_[d] = std::max(1, static_cast<int>(std::ceil((high[d] - low[d]) / cell_size)));
    cells *= static_cast<std::size_t>(count_[d]);
  }
  start_.assign(cells + 1, 0);
  const std::size_t count = triangles.size() / 3;
  for (std::size_t t = 0; t < count; ++t)
    for_each_cell(cells_of(positions, triangles, t, reach), [&](std::size_t c) { ++start_[c + 1]; });
  for (std::size_t c = 0; c < cells; ++c) start_[c + 1] += start_[c];
  list_.resize(static_cast<std::size_t>(start_[cells]));
  fill_.assign(start_.begin(), start_.end() - 1);
  for (std::size_t t = 0; t < count; ++t)
    for_each_cell(cells_of(positions, triangles, t, reach),
                  [&](std::size_t c) { list_[fill_[c]++] = static_cast<std::int32_t>(t); });
}

std::span<const std::int32_t> TriangleGrid::near(const Vector3& p) const {
  std::array<int, 3> cell;
  for (int d = 0; d < 3; ++d) {
    cell[d] = static_cast<int>(std::floor((p[d] - low_[d]) / cell_size_));
    if (cell[d] < 0 || cell[d] >= count_[d]) return {};
  }
  const std::size_t c = static_cast<std::size_t>(cell[0] + count_[0] * (cell[1] + count_[1] * cell[2]));
  return std::span(list_).subspan(static_cast<std::size_t>(start_[c]), static_cast<std::size_t>(start_[c + 1] - start_[c]));
}

}  // namespace polynya::contact
