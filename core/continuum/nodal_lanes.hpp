#pragma once
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/continuum/number.hpp"

/// Nodal vectors of the elements of a pack: from records of four doubles per node to one number per component and back.
/// Whole records are loaded and transposed in registers, which costs a third of loading every double by itself.
namespace polynya::continuum {

/// One vector of a node; the fourth entry is room.
struct alignas(32) NodeRecord {
  std::array<double, 4> value{};
};

namespace detail {
typedef double Four __attribute__((vector_size(32)));
typedef double Eight __attribute__((vector_size(64)));

POLYNYA_INLINE Four record(const NodeRecord* nodes, std::uint16_t index) {
  return *reinterpret_cast<const Four*>(nodes[index].value.data());
}
POLYNYA_INLINE void add_to_record(const Four& value, NodeRecord* nodes, std::uint16_t index) {
  auto* to = reinterpret_cast<Four*>(nodes[index].value.data());
  *to = *to + value;
}
POLYNYA_INLINE Eight joined(const Four& low, const Four& high) {
  return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
}
}  // namespace detail

/// The vectors of the nodes index[lane].
template <class T>
POLYNYA_INLINE std::array<T, 3> gather_vectors(const NodeRecord* nodes, const std::uint16_t* index) {
  using detail::record;
  if constexpr (width_of<T> == 8) {
    using detail::Eight, detail::joined;
    const Eight a = joined(record(nodes, index[0]), record(nodes, index[4]));
    const Eight b = joined(record(nodes, index[1]), record(nodes, index[5]));
    const Eight c = joined(record(nodes, index[2]), record(nodes, index[6]));
    const Eight d = joined(record(nodes, index[3]), record(nodes, index[7]));
    const Eight xz = __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14);
    const Eight y_ = __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
    const Eight more_xz = __builtin_shufflevector(c, d, 0, 8, 2, 10, 4, 12, 6, 14);
    const Eight more_y = __builtin_shufflevector(c, d, 1, 9, 3, 11, 5, 13, 7, 15);
    const Eight x = __builtin_shufflevector(xz, more_xz, 0, 1, 8, 9, 4, 5, 12, 13);
    const Eight y = __builtin_shufflevector(y_, more_y, 0, 1, 8, 9, 4, 5, 12, 13);
    const Eight z = __builtin_shufflevector(xz, more_xz, 2, 3, 10, 11, 6, 7, 14, 15);
    return {std::bit_cast<T>(x), std::bit_cast<T>(y), std::bit_cast<T>(z)};
  } else if constexpr (width_of<T> == 4) {
    using detail::Four;
    const Four a = record(nodes, index[0]), b = record(nodes, index[1]), c = record(nodes, index[2]),
               d = record(nodes, index[3]);
    const Four xz = __builtin_shufflevector(a, b, 0, 4, 2, 6), y_ = __builtin_shufflevector(a, b, 1, 5, 3, 7);
    const Four more_xz = __builtin_shufflevector(c, d, 0, 4, 2, 6);
    const Four more_y = __builtin_shufflevector(c, d, 1, 5, 3, 7);
    const Four x = __builtin_shufflevector(xz, more_xz, 0, 1, 4, 5);
    const Four y = __builtin_shufflevector(y_, more_y, 0, 1, 4, 5);
    const Four z = __builtin_shufflevector(xz, more_xz, 2, 3, 6, 7);
    return {std::bit_cast<T>(x), std::bit_cast<T>(y), std::bit_cast<T>(z)};
  } else if constexpr (PackNumber<T>) {
    std::array<T, 3> result;
    for (std::size_t i = 0; i < 3; ++i) result[i] = T([&](auto lane) { return nodes[index[lane]].value[i]; });
    return result;
  } else {
    const auto& value = nodes[*index].value;
    return {value[0], value[1], value[2]};
  }
}

/// Adds the vectors to those of the nodes index[lane], lane after lane.
template <class T>
POLYNYA_INLINE void scatter_vectors(const std::array<T, 3>& vectors, NodeRecord* nodes, const std::uint16_t* index) {
  if constexpr (width_of<T> == 8) {
    using detail::Eight, detail::Four, detail::add_to_record;
    const Eight x = std::bit_cast<Eight>(vectors[0]), y = std::bit_cast<Eight>(vectors[1]),
                z = std::bit_cast<Eight>(vectors[2]);
    const Eight even_xy = __builtin_shufflevector(x, y, 0, 8, 2, 10, 4, 12, 6, 14);
    const Eight odd_xy = __builtin_shufflevector(x, y, 1, 9, 3, 11, 5, 13, 7, 15);
    const Eight even_z = __builtin_shufflevector(z, Eight{}, 0, 8, 2, 10, 4, 12, 6, 14);
    const Eight odd_z = __builtin_shufflevector(z, Eight{}, 1, 9, 3, 11, 5, 13, 7, 15);
    const Eight of02 = __builtin_shufflevector(even_xy, even_z, 0, 1, 8, 9, 2, 3, 10, 11);
    const Eight of13 = __builtin_shufflevector(odd_xy, odd_z, 0, 1, 8, 9, 2, 3, 10, 11);
    const Eight of46 = __builtin_shufflevector(even_xy, even_z, 4, 5, 12, 13, 6, 7, 14, 15);
    const Eight of57 = __builtin_shufflevector(odd_xy, odd_z, 4, 5, 12, 13, 6, 7, 14, 15);
    const auto low = [](const Eight& v) { return __builtin_shufflevector(v, v, 0, 1, 2, 3); };
    const auto high = [](const Eight& v) { return __builtin_shufflevector(v, v, 4, 5, 6, 7); };
    add_to_record(low(of02), nodes, index[0]);
    add_to_record(low(of13), nodes, index[1]);
    add_to_record(high(of02), nodes, index[2]);
    add_to_record(high(of13), nodes, index[3]);
    add_to_record(low(of46), nodes, index[4]);
    add_to_record(low(of57), nodes, index[5]);
    add_to_record(high(of46), nodes, index[6]);
    add_to_record(high(of57), nodes, index[7]);
  } else if constexpr (width_of<T> == 4) {
    using detail::Four, detail::add_to_record;
    const Four x = std::bit_cast<Four>(vectors[0]), y = std::bit_cast<Four>(vectors[1]),
               z = std::bit_cast<Four>(vectors[2]);
    const Four even_xy = __builtin_shufflevector(x, y, 0, 4, 2, 6), odd_xy = __builtin_shufflevector(x, y, 1, 5, 3, 7);
    const Four even_z = __builtin_shufflevector(z, Four{}, 0, 4, 2, 6);
    const Four odd_z = __builtin_shufflevector(z, Four{}, 1, 5, 3, 7);
    add_to_record(__builtin_shufflevector(even_xy, even_z, 0, 1, 4, 5), nodes, index[0]);
    add_to_record(__builtin_shufflevector(odd_xy, odd_z, 0, 1, 4, 5), nodes, index[1]);
    add_to_record(__builtin_shufflevector(even_xy, even_z, 2, 3, 6, 7), nodes, index[2]);
    add_to_record(__builtin_shufflevector(odd_xy, odd_z, 2, 3, 6, 7), nodes, index[3]);
  } else if constexpr (PackNumber<T>) {
    for (std::size_t lane = 0; lane < width_of<T>; ++lane)
      for (std::size_t i = 0; i < 3; ++i) nodes[index[lane]].value[i] += vectors[i][lane];
  } else {
    for (std::size_t i = 0; i < 3; ++i) nodes[*index].value[i] += vectors[i];
  }
}

}  // namespace polynya::continuum
