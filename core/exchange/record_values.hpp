#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "core/exchange/bytes.hpp"

namespace polynya::exchange {

/// Where the values of an array series lie in a file, one message's behind the other.
struct PlacedValues {
  std::uint64_t offset = 0;                    ///< bytes from the beginning of the file
  const std::vector<Bytes>* values = nullptr;  ///< one per message
};

/// Writes values to their places in a file that exists, each straight from where it lies. Throws results::ResultsError
/// naming the file.
void write_placed_values(const std::string& path, const std::vector<PlacedValues>& series);

}  // namespace polynya::exchange
