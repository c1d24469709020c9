#include "core/exchange/byte_entropy.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace polynya::exchange {
namespace {

constexpr std::size_t sampled_arrays = 8;
constexpr std::size_t sampled_items = 1024;  // of each

}  // namespace

double byte_entropy(const std::vector<std::vector<std::byte>>& arrays, std::size_t item_size) {
  std::vector<std::array<std::size_t, 256>> histogram(item_size);
  std::size_t items = 0;
  const std::size_t stride = arrays.size() / sampled_arrays + 1;
  for (std::size_t a = 0; a < arrays.size(); a += stride) {
    const std::size_t count = std::min(arrays[a].size() / item_size, sampled_items);
    for (std::size_t i = 0; i < count * item_size; ++i)
      ++histogram[i % item_size][std::to_integer<std::size_t>(arrays[a][i])];
    items += count;
  }
  if (items == 0) return 0;
  double bits = 0;
  for (const auto& plane : histogram)
    for (const std::size_t count : plane) {
      const double share = static_cast<double>(count) / static_cast<double>(items);
      if (count > 0) bits -= share * std::log2(share);
    }
  return bits / 8 / static_cast<double>(item_size);
}

}  // namespace polynya::exchange
