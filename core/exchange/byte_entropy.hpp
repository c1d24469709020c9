#pragma once
#include <cstddef>
#include <vector>

namespace polynya::exchange {

/// How small arrays of items of this size can become, 0 to 1: mean entropy of the first, second ... bytes of all items
/// (Shannon 1948), in bytes per byte, from a sample. It bounds what byte shuffling and a Huffman code reach; repetition
/// does better. 0 for nothing.
double byte_entropy(const std::vector<std::vector<std::byte>>& arrays, std::size_t item_size);

}  // namespace polynya::exchange
