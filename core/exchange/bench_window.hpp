#pragma once
#include <cstddef>

namespace polynya::exchange {

/// Median wall time in microseconds of one coupling window over a local socket: a participant packs and sends
/// positions f8[vertices][3], the hub unpacks them and answers with forces f8[vertices][3], which are unpacked again.
/// Two threads of this process, each with its own transport. Benchmark name: coupling.window_us.
double window_microseconds(std::size_t vertices);

}  // namespace polynya::exchange
