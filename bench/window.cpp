#include "bench/kernels.hpp"
#include "core/exchange/bench_window.hpp"

namespace polynya::bench {

/// One coupling window of 2,000 vertices each way over a local socket, median wall time, us.
std::vector<Figure> window() { return {{"coupling.window_us", exchange::window_microseconds(2000)}}; }

}  // namespace polynya::bench
