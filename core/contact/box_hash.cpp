#include "core/contact/box_hash.hpp"

#include <algorithm>
#include <bit>

namespace polynya::contact {
namespace {
constexpr double most_cells = 200;  // along an axis: bounds the cells of one large box
}

template <class Visit>
void BoxHash::for_each_bucket(const Box& box, const Box& region, Visit&& visit) const {
  if (!box.meets(region)) return;
  std::array<std::int64_t, 3> low, high;
  for (std::size_t d = 0; d < 3; ++d) {
    low[d] = cell(std::max(box.low[d], region.low[d]));
    high[d] = cell(std::min(box.high[d], region.high[d]));
  }
  for (std::int64_t k = low[2]; k <= high[2]; ++k)
    for (std::int64_t j = low[1]; j <= high[1]; ++j)
      for (std::int64_t i = low[0]; i <= high[0]; ++i) visit(bucket_of(i, j, k));
}

void BoxHash::build(std::span<const Box> boxes, const Box& region, double cell_size) {
  double extent = 0;
  for (std::size_t d = 0; d < 3; ++d) extent = std::max(extent, region.high[d] - region.low[d]);
  inverse_size_ = 1 / std::max(cell_size, extent / most_cells);
  const std::size_t buckets = std::bit_ceil(std::max<std::size_t>(64, 4 * boxes.size()));
  mask_ = buckets - 1;
  start_.assign(buckets + 1, 0);
  for (const Box& box : boxes) for_each_bucket(box, region, [&](std::size_t b) { ++start_[b + 1]; });
  for (std::size_t b = 0; b < buckets; ++b) start_[b + 1] += start_[b];
  list_.resize(static_cast<std::size_t>(start_[buckets]));
  fill_.assign(start_.begin(), start_.end() - 1);
  for (std::size_t k = 0; k < boxes.size(); ++k)
    for_each_bucket(boxes[k], region,
                    [&](std::size_t b) { list_[static_cast<std::size_t>(fill_[b]++)] = static_cast<std::int32_t>(k); });
}

}  // namespace polynya::contact
