#include <cstddef>
#include <vector>

#include "bench/kernels.hpp"

namespace polynya::bench {

/// a = b + s c over arrays far larger than the caches; 24 bytes per entry are counted, as in STREAM.
std::vector<Figure> machine_triad() {
  const std::size_t count = 1 << 24;
  std::vector<double> a(count, 0.0), b(count, 1.0), c(count, 2.0);
  double s = 3.0;
  const double time = shortest_time(5, [&] {
    double* to = a.data();
    const double *x = b.data(), *y = c.data();
    for (std::size_t i = 0; i < count; ++i) to[i] = x[i] + s * y[i];
    s += a[count / 2] * 1e-30;  // keeps the loop
  });
  return {{"machine.triad_GB_s", 24e-9 * static_cast<double>(count) / time}};
}

}  // namespace polynya::bench
