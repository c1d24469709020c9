#pragma once
#include <cstdint>
#ifdef __AVX2__
#include <immintrin.h>
#endif

#include "core/compute/pack.hpp"

namespace polynya::ice {

/// Records of 16 doubles; eight columns of one pack of records are read at once: column c, lane k is
/// records[16 * index[k] + first + c]. Whole rows are loaded and transposed in registers, which is several times
/// faster than the processor's gather instructions.
struct RecordColumns {
  static constexpr std::size_t stride = 16;
  compute::Pack column[8];

  RecordColumns(const double* records, const std::int32_t* index, std::size_t first) {
    load(records + first, index, std::integral_constant<std::size_t, compute::pack_width>{});
  }

 private:
  template <std::size_t width>
  void load(const double* records, const std::int32_t* index, std::integral_constant<std::size_t, width>) {
    for (std::size_t c = 0; c < 8; ++c)
      column[c] = compute::Pack([&](auto lane) { return records[stride * static_cast<std::size_t>(index[lane]) + c]; });
  }

#if defined(__AVX512F__)
  void load(const double* records, const std::int32_t* index, std::integral_constant<std::size_t, 8>) {
    __m512d row[8], pair[8], quad[8];
    for (int k = 0; k < 8; ++k) row[k] = _mm512_loadu_pd(records + stride * static_cast<std::size_t>(index[k]));
    for (int k = 0; k < 8; k += 2) {
      pair[k] = _mm512_shuffle_pd(row[k], row[k + 1], 0x00);      // columns 0 2 4 6 of two rows
      pair[k + 1] = _mm512_shuffle_pd(row[k], row[k + 1], 0xff);  // columns 1 3 5 7
    }
    for (int odd = 0; odd < 2; ++odd)
      for (int half = 0; half < 2; ++half) {
        const __m512d a = pair[4 * half + odd], b = pair[4 * half + 2 + odd];
        quad[4 * half + 2 * odd] = _mm512_shuffle_f64x2(a, b, 0x88);      // columns 0 4 (1 5) of four rows
        quad[4 * half + 2 * odd + 1] = _mm512_shuffle_f64x2(a, b, 0xdd);  // columns 2 6 (3 7)
      }
    for (int odd = 0; odd < 2; ++odd)
      for (int two = 0; two < 2; ++two) {
        const __m512d a = quad[2 * odd + two], b = quad[4 + 2 * odd + two];
        column[2 * two + odd] = compute::Pack(_mm512_shuffle_f64x2(a, b, 0x88));
        column[4 + 2 * two + odd] = compute::Pack(_mm512_shuffle_f64x2(a, b, 0xdd));
      }
  }
#elif defined(__AVX2__)
  void load(const double* records, const std::int32_t* index, std::integral_constant<std::size_t, 4>) {
    for (std::size_t block = 0; block < 8; block += 4) {
      __m256d row[4];
      for (int k = 0; k < 4; ++k)
        row[k] = _mm256_loadu_pd(records + stride * static_cast<std::size_t>(index[k]) + block);
      const __m256d a = _mm256_unpacklo_pd(row[0], row[1]), b = _mm256_unpackhi_pd(row[0], row[1]);
      const __m256d c = _mm256_unpacklo_pd(row[2], row[3]), d = _mm256_unpackhi_pd(row[2], row[3]);
      column[block] = compute::Pack(_mm256_permute2f128_pd(a, c, 0x20));
      column[block + 1] = compute::Pack(_mm256_permute2f128_pd(b, d, 0x20));
      column[block + 2] = compute::Pack(_mm256_permute2f128_pd(a, c, 0x31));
      column[block + 3] = compute::Pack(_mm256_permute2f128_pd(b, d, 0x31));
    }
  }
#endif
};

}  // namespace polynya::ice
