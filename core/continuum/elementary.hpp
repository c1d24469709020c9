#pragma once
#include <bit>
#include <cmath>
#include <cstdint>

#include "core/continuum/number.hpp"

/// log2 and exp2 by polynomials, lane by lane without a call: the powers of a constitutive law at a few nanoseconds.
/// Relative error below 4e-16 (exp2) and, for log2, absolute below 4e-16 times max(1, |result|); no special values.
namespace polynya::continuum {

namespace detail {

/// x = 2^exponent * mantissa with mantissa in [1/sqrt 2, sqrt 2); x positive and normal.
POLYNYA_INLINE void split(double x, double& mantissa, double& exponent) {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  // Subtracting the bits of 1/sqrt 2 makes the exponent field count from there.
  const std::uint64_t origin = std::bit_cast<std::uint64_t>(0.70710678118654752);
  const std::int64_t power = static_cast<std::int64_t>(bits - origin) >> 52;
  mantissa = std::bit_cast<double>(bits - (static_cast<std::uint64_t>(power) << 52));
  exponent = static_cast<double>(power);
}
POLYNYA_INLINE double power_of_two(double whole) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(static_cast<std::int64_t>(whole) + 1023) << 52);
}
POLYNYA_INLINE double nearest(double x) {
  return std::nearbyint(x);
}

template <PackNumber T>
struct Bits {
  typedef std::int64_t Integers __attribute__((vector_size(sizeof(T))));
  typedef double Doubles __attribute__((vector_size(sizeof(T))));
};
template <PackNumber T>
POLYNYA_INLINE void split(const T& x, T& mantissa, T& exponent) {
  using Integers = typename Bits<T>::Integers;
  const Integers bits = std::bit_cast<Integers>(x);
  const Integers origin = Integers{} + std::bit_cast<std::int64_t>(0.70710678118654752);
  const Integers power = (bits - origin) >> 52;
  mantissa = std::bit_cast<T>(bits - (power << 52));
  exponent = std::bit_cast<T>(__builtin_convertvector(power, typename Bits<T>::Doubles));
}
template <PackNumber T>
POLYNYA_INLINE T power_of_two(const T& whole) {
  const auto value = std::bit_cast<typename Bits<T>::Doubles>(whole);
  return std::bit_cast<T>((__builtin_convertvector(value, typename Bits<T>::Integers) + 1023) << 52);
}
template <PackNumber T>
POLYNYA_INLINE T nearest(const T& x) {
  const T shift = 6755399441055744.0;  // 1.5 * 2^52: adding it leaves no room for a fraction
  return (x + shift) - shift;
}

}  // namespace detail

/// Logarithm to base 2 of a positive normal number.
template <class T>
POLYNYA_INLINE T log2_of(const T& x) {
  T mantissa, exponent;
  detail::split(x, mantissa, exponent);
  // ln m = 2 atanh s, s = (m - 1)/(m + 1), |s| < 0.172
  const T s = (mantissa - 1.0) / (mantissa + 1.0);
  const T z = s * s;
  T sum = T(1.0 / 23.0);
  for (int k = 21; k >= 1; k -= 2) sum = sum * z + 1.0 / k;
  return exponent + s * sum * 2.8853900817779268;  // 2 / ln 2
}

/// 2^x; 0 below -1000, meaningless above 1000.
template <class T>
POLYNYA_INLINE T exp2_of(const T& x) {
  const T bounded = maximum(x, T(-1000.0));
  const T whole = detail::nearest(bounded);
  const T y = (bounded - whole) * 0.69314718055994531;
  T sum = T(1.0 / 6227020800.0);
  constexpr double inverse_factorial[] = {1.0 / 479001600.0,
                                          1.0 / 39916800.0,
                                          1.0 / 3628800.0,
                                          1.0 / 362880.0,
                                          1.0 / 40320.0,
                                          1.0 / 5040.0,
                                          1.0 / 720.0,
                                          1.0 / 120.0,
                                          1.0 / 24.0,
                                          1.0 / 6.0,
                                          0.5,
                                          1.0,
                                          1.0};
  for (double coefficient : inverse_factorial) sum = sum * y + coefficient;
  return select(x < T(-1000.0), T(0.0), sum * detail::power_of_two(whole));
}

}  // namespace polynya::continuum
