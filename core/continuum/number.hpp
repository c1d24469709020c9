#pragma once
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <experimental/simd>

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
inline double select(bool condition, double yes, double no) { return condition ? yes : no; }
template <PackNumber T>
T select(const typename T::mask_type& condition, const T& yes, const T& no) {
  T result = no;
  stdx::where(condition, result) = yes;
  return result;
}

inline bool any(bool condition) { return condition; }
template <class M>
  requires stdx::is_simd_mask_v<M>
bool any(const M& condition) {
  return stdx::any_of(condition);
}

template <class T>
T maximum(const T& a, const T& b) {
  return select(a > b, a, b);
}
template <class T>
T minimum(const T& a, const T& b) {
  return select(a < b, a, b);
}

inline double square_root(double x) { return std::sqrt(x); }
// gcc 12 calls the undefined operand of its own AVX-512 square root uninitialized.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
template <PackNumber T>
T square_root(const T& x) {
  return stdx::sqrt(x);
}
#pragma GCC diagnostic pop

template <class T>
T load(const double* from) {
  if constexpr (PackNumber<T>)
    return T(from, stdx::element_aligned);
  else
    return *from;
}
template <class T>
void store(const T& value, double* to) {
  if constexpr (PackNumber<T>)
    value.copy_to(to, stdx::element_aligned);
  else
    *to = value;
}

/// from[index[lane]] for each lane.
template <class T>
T gather(const double* from, const std::int32_t* index) {
  if constexpr (PackNumber<T>)
    return T([&](auto lane) { return from[index[lane]]; });
  else
    return from[*index];
}

}  // namespace polynya::continuum
