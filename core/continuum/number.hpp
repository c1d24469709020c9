#pragma once
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <experimental/simd>

/// For the small functions of kernels: a pack that is handed over through memory costs more than the arithmetic on it.
#define POLYNYA_INLINE [[gnu::always_inline]] inline

/// What kernels ask of a number, for plain doubles and for packs of them, so that one source serves both.
namespace polynya::continuum {

namespace stdx = std::experimental;

template <class T>
concept PackNumber = stdx::is_simd_v<T>;

template <class T>
struct NumberTraits {
  static constexpr std::size_t width = 1;
};
template <PackNumber T>
struct NumberTraits<T> {
  static constexpr std::size_t width = T::size();
};
/// How many doubles a number holds.
template <class T>
inline constexpr std::size_t width_of = NumberTraits<T>::width;

/// condition ? yes : no, lane by lane.
POLYNYA_INLINE double select(bool condition, double yes, double no) {
  return condition ? yes : no;
}
template <PackNumber T>
POLYNYA_INLINE T select(const typename T::mask_type& condition, const T& yes, const T& no) {
  T result = no;
  stdx::where(condition, result) = yes;
  return result;
}

POLYNYA_INLINE bool any(bool condition) {
  return condition;
}
template <class M>
requires stdx::is_simd_mask_v<M> POLYNYA_INLINE bool any(const M& condition) {
  return stdx::any_of(condition);
}

template <class T>
POLYNYA_INLINE T maximum(const T& a, const T& b) {
  return select(a > b, a, b);
}
template <class T>
POLYNYA_INLINE T minimum(const T& a, const T& b) {
  return select(a < b, a, b);
}

POLYNYA_INLINE double square_root(double x) {
  return std::sqrt(x);
}
// gcc 12 calls the undefined operand of its own AVX-512 square root uninitialized.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
template <PackNumber T>
POLYNYA_INLINE T square_root(const T& x) {
  return stdx::sqrt(x);
}
#pragma GCC diagnostic pop

template <class T>
POLYNYA_INLINE T load(const double* from) {
  if constexpr (PackNumber<T>)
    return T(from, stdx::element_aligned);
  else
    return *from;
}
template <class T>
POLYNYA_INLINE void store(const T& value, double* to) {
  if constexpr (PackNumber<T>)
    value.copy_to(to, stdx::element_aligned);
  else
    *to = value;
}

POLYNYA_INLINE double sum_of_lanes(double x) {
  return x;
}
template <PackNumber T>
POLYNYA_INLINE double sum_of_lanes(const T& x) {
  return stdx::reduce(x);
}
POLYNYA_INLINE double smallest_lane(double x) {
  return x;
}
template <PackNumber T>
POLYNYA_INLINE double smallest_lane(const T& x) {
  return stdx::hmin(x);
}

/// from[index[lane]] for each lane.
template <class T>
POLYNYA_INLINE T gather(const double* from, const std::int32_t* index) {
  if constexpr (PackNumber<T>)
    return T([&](auto lane) { return from[index[lane]]; });
  else
    return from[*index];
}

}  // namespace polynya::continuum
