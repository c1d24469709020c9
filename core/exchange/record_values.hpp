#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace polynya::exchange {

/// Where the values of an array series lie in a file, and in memory.
struct PlacedValues {
  std::uint64_t offset = 0;           ///< bytes from the beginning of the file
  std::span<const std::byte> values;  ///< from the beginning of a page on
};

/// Of a large series: a copy into the kernel's cache, which writes it when it likes, costs a processor; straight to the
/// disk costs patience alone.
enum class Route { through_cache, past_cache };

/// From so many bytes on, values whose offset is a multiple of `disk_block` go past the cache if that is the route.
constexpr std::size_t least_past_cache = 1 << 18, disk_block = 4096;

/// Writes values to their places in a file that exists. A file system that knows no way past its cache gets all of them
/// through it. Throws results::ResultsError naming the file.
void write_placed_values(const std::string& path, const std::vector<PlacedValues>& series, Route route);

}  // namespace polynya::exchange
