#pragma once
#include <sys/mman.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace polynya::compute {

/// `count` zeros in memory for which the kernel is asked to take large pages (Linux, madvise(2)): loops that stream
/// tens of arrays at once then seldom miss the processor's table of pages. Where it has none to give, nothing changes.
inline std::vector<double> zeros_in_large_pages(std::size_t count) {
  std::vector<double> values;
  values.reserve(count);
  constexpr std::uintptr_t page = std::uintptr_t{1} << 21;
  const std::uintptr_t begin = reinterpret_cast<std::uintptr_t>(values.data()), end = begin + count * sizeof(double);
  const std::uintptr_t first = (begin + page - 1) / page * page, last = end / page * page;
  // Before the first touch; what is not whole large pages stays as it is.
  if (first < last) madvise(reinterpret_cast<void*>(first), last - first, MADV_HUGEPAGE);
  values.assign(count, 0.0);
  return values;
}

}  // namespace polynya::compute
