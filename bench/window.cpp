#include "bench/kernels.hpp"
#include "core/exchange/bench_window.hpp"

namespace polynya::bench {

/// One coupling window of 2,000 and of 80,000 vertices each way over a local socket, median wall time of 2,000 windows,
/// us.
std::vector<Figure> window() {
  return {{"coupling.window_us", exchange::window_microseconds(2000)},
          {"coupling.window_80000_us", exchange::window_microseconds(80000)}};
}

}  // namespace polynya::bench
