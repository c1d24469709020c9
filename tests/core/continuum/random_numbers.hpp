#pragma once
#include <cstdint>

namespace polynya::tests {

/// The same numbers on every machine.
struct Random {
  std::uint64_t state = 0x9e3779b97f4a7c15ull;
  /// Uniform in [0, 1).
  double unit() {
    state = state * 6364136223846793005ull + 1442695040888963407ull;
    return static_cast<double>(state >> 11) / 9007199254740992.0;
  }
  /// Uniform in [-1, 1).
  double symmetric() { return 2 * unit() - 1; }
};

}  // namespace polynya::tests
