#pragma once
#include <algorithm>
#include <cmath>

namespace polynya::compute {

/// The next of equal steps, none longer than `largest`, that fill what is left of a stretch of time. The last of them
/// is what is left, exactly.
inline double equal_step(double left, double largest) {
  return left / std::max(1.0, std::ceil(left / largest));
}

}  // namespace polynya::compute
