#include "geometry/grid_lines.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "geometry/error.hpp"

namespace polynya::geometry {

void check_grid(const GridLines& grid) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::vector<double>& line = grid.lines[axis];
    const std::string name(1, "xyz"[axis]);
    if (line.size() < 2) throw GeometryError("the grid needs at least two lines along " + name);
    for (std::size_t i = 0; i < line.size(); ++i) {
      if (!std::isfinite(line[i]))
        throw GeometryError("line " + std::to_string(i) + " along " + name + " is not finite");
      if (i > 0 && !(line[i] > line[i - 1]))
        throw GeometryError("lines along " + name + " must increase strictly; line " + std::to_string(i) + " does not");
    }
  }
}

LineLocator::LineLocator(std::vector<double> lines) : lines_(std::move(lines)) {
  // About two bins per interval of mean width keep the search after the look-up short on graded grids, too.
  const std::size_t bins = 2 * (lines_.size() - 1);
  bins_per_length_ = static_cast<double>(bins) / (lines_.back() - lines_.front());
  first_.resize(bins + 2);
  std::int32_t interval = 0;
  for (std::size_t bin = 0; bin < first_.size(); ++bin) {
    const double lower_end = lines_.front() + static_cast<double>(bin) / bins_per_length_;
    while (interval + 1 < intervals() && lower_end > lines_[static_cast<std::size_t>(interval) + 1]) ++interval;
    first_[bin] = interval;
  }
}

}  // namespace polynya::geometry
