#include "core/scene/graded_line.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace polynya::scene {
namespace {

/// Length of n cells first * ratio, first * ratio^2, ..., none above largest.
double sequence_length(double first, double ratio, int n, double largest) {
  double size = first, sum = 0;
  for (int i = 0; i < n; ++i) {
    size = std::min(size * ratio, largest);
    sum += size;
  }
  return sum;
}

/// Sizes, outward, of the cells that fill `length` next to a cell of size `first`; empty if no sequence with ratios
/// between 1/growth and growth fits.
std::vector<double> graded_sizes(double length, double first, double growth, double largest) {
  int n = 1;
  while (sequence_length(first, growth, n, largest) < length * (1 - 1e-12)) ++n;
  double low = 1 / growth, high = growth;
  if (sequence_length(first, low, n, largest) > length * (1 + 1e-12)) return {};
  for (int i = 0; i < 200 && high > low; ++i) {
    const double middle = 0.5 * (low + high);
    (sequence_length(first, middle, n, largest) < length ? low : high) = middle;
    if (middle == 0.5 * (low + high)) break;
  }
  std::vector<double> sizes(n);
  double size = first;
  for (double& s : sizes) s = size = std::min(size * high, largest);
  return sizes;
}

}  // namespace

void append_equal_cells(std::vector<double>& line, double from, double to, double cell) {
  if (line.empty()) line.push_back(from);
  const double start = line.back();
  const int n = std::max(1, static_cast<int>(std::lround((to - start) / cell)));
  for (int i = 1; i < n; ++i) line.push_back(start + (to - start) * i / n);
  line.push_back(to);
}

std::vector<double> graded_line(double lo, double hi, double fine_lo, double fine_hi, double cell, double growth,
                                double largest) {
  if (!(lo <= fine_lo && fine_lo < fine_hi && fine_hi <= hi && cell > 0 && growth >= 1))
    throw std::invalid_argument("graded_line: needs lo <= fine_lo < fine_hi <= hi, cell > 0 and growth >= 1");
  std::vector<double> below, above;
  // One pass can move an end of the fine part and with it the size of a fine cell, which the other side depends on.
  for (int pass = 0; pass < 3; ++pass) {
    const double size = (fine_hi - fine_lo) / std::max(1L, std::lround((fine_hi - fine_lo) / cell));
    const double limit = std::max(size, largest);
    below = lo < fine_lo ? graded_sizes(fine_lo - lo, size, growth, limit) : std::vector<double>{};
    above = hi > fine_hi ? graded_sizes(hi - fine_hi, size, growth, limit) : std::vector<double>{};
    const bool joins_below = below.empty() && lo < fine_lo, joins_above = above.empty() && hi > fine_hi;
    if (joins_below) fine_lo = lo;
    if (joins_above) fine_hi = hi;
    if (!joins_below && !joins_above) break;
  }
  std::vector<double> line{lo};
  double position = lo;
  for (std::size_t i = below.size(); i-- > 1;) line.push_back(position += below[i]);
  if (!below.empty()) line.push_back(fine_lo);
  append_equal_cells(line, fine_lo, fine_hi, cell);
  position = fine_hi;
  for (std::size_t i = 0; i + 1 < above.size(); ++i) line.push_back(position += above[i]);
  if (!above.empty()) line.push_back(hi);
  return line;
}

}  // namespace polynya::scene
