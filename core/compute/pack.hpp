#pragma once
#include <cstddef>
#include <experimental/simd>

namespace polynya::compute {

/// A pack of doubles as wide as the processor the file is compiled for: 4 with AVX2, 8 with AVX-512, 2 with SSE2.
using Pack = std::experimental::native_simd<double>;
inline constexpr std::size_t pack_width = Pack::size();
inline constexpr auto aligned = std::experimental::element_aligned;

/// number rounded up to whole packs.
constexpr std::size_t padded(std::size_t number) {
  return (number + pack_width - 1) / pack_width * pack_width;
}

}  // namespace polynya::compute
