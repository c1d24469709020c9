#pragma once
#include <array>
#include <cstdint>
#include <vector>

namespace polynya::geometry {

/// Node coordinates of a structured grid, m, strictly increasing along each axis.
struct GridLines {
  std::array<std::vector<double>, 3> lines;  ///< x, y, z

  std::int64_t cells(int axis) const {
    return static_cast<std::int64_t>(lines[static_cast<std::size_t>(axis)].size()) - 1;
  }
  std::int64_t cell_count() const { return cells(0) * cells(1) * cells(2); }
  std::int64_t cell_index(std::int64_t i, std::int64_t j, std::int64_t k) const {
    return i + cells(0) * (j + cells(1) * k);
  }
  std::array<std::int64_t, 3> cell_position(std::int64_t index) const {
    return {index % cells(0), index / cells(0) % cells(1), index / (cells(0) * cells(1))};
  }
  double width(int axis, std::int64_t cell) const {
    const auto& line = lines[static_cast<std::size_t>(axis)];
    return line[static_cast<std::size_t>(cell) + 1] - line[static_cast<std::size_t>(cell)];
  }
  double cell_volume(std::int64_t index) const {
    const auto p = cell_position(index);
    return width(0, p[0]) * width(1, p[1]) * width(2, p[2]);
  }
};

/// Throws GeometryError unless every axis has at least two lines that are finite and strictly increasing.
void check_grid(const GridLines& grid);

/// Finds the interval of a coordinate between lines in constant time.
class LineLocator {
 public:
  LineLocator() = default;
  explicit LineLocator(std::vector<double> lines);

  /// Largest i with line[i] < x, so -1 at and before the first line and the number of intervals beyond the last.
  std::int32_t below(double x) const {
    if (!(x > lines_.front())) return -1;
    if (x > lines_.back()) return intervals();
    std::int32_t i = first_[static_cast<std::size_t>((x - lines_.front()) * bins_per_length_)];
    while (x > lines_[static_cast<std::size_t>(i) + 1]) ++i;
    while (!(x > lines_[static_cast<std::size_t>(i)])) --i;
    return i;
  }
  std::int32_t intervals() const { return static_cast<std::int32_t>(lines_.size()) - 1; }
  const std::vector<double>& lines() const { return lines_; }
  double line(std::int32_t i) const { return lines_[static_cast<std::size_t>(i)]; }

 private:
  std::vector<double> lines_;
  std::vector<std::int32_t> first_;  ///< per bin, the interval that holds its lower end
  double bins_per_length_ = 0;
};

}  // namespace polynya::geometry
