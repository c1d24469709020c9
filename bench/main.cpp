#include <omp.h>
#include <time.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <exception>
#include <limits>

#include "bench/kernels.hpp"

namespace polynya::bench {

namespace {
double processor_seconds() {
  timespec time;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double wall_seconds(const std::function<void()>& call) {
  const auto start = std::chrono::steady_clock::now();
  call();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}
}  // namespace

double time_of(const std::function<void()>& call) {
  const double start = processor_seconds();
  call();
  return processor_seconds() - start;
}

double shortest_time(int repetitions, const std::function<void()>& call) {
  call();
  double shortest = std::numeric_limits<double>::infinity();
  for (int k = 0; k < repetitions; ++k) shortest = std::min(shortest, time_of(call));
  return shortest;
}

double speedup_of_two_threads(int repetitions, const std::function<void()>& call) {
  std::array<double, 2> shortest{1e300, 1e300};
  for (int k = 0; k < repetitions; ++k) {
    for (int threads = 1; threads <= 2; ++threads) {
      omp_set_num_threads(threads);
      shortest[threads - 1] = std::min(shortest[threads - 1], wall_seconds(call));
    }
  }
  omp_set_num_threads(1);
  return shortest[0] / shortest[1];
}

namespace {

struct Kernel {
  const char* name;
  std::vector<Figure> (*run)();
};

/// All benchmarks; --only selects by name.
const Kernel kernels[] = {
    {"machine.triad", machine_triad},
    {"ice.hexahedron_elastic", hexahedron_elastic},
    {"ice.hexahedron_jh2", hexahedron_jh2},
    {"ice.hexahedron_scaling", hexahedron_scaling},
    {"ice.particle", particle},
    {"geometry.clip, geometry.refit", clip},
    {"contact.evaluate", contact_evaluate},
    {"coupling.window", window},
    {"fluid.cell", fluid_step},
    {"fluid.sleeping", fluid_sleeping},
    {"ice.sleeping", solid_sleeping},
};

int run(int argc, char** argv) {
  CLI::App app{"Speed of the kernels, on one thread unless a figure says otherwise"};
  bool json = false;
  std::string only;
  app.add_flag("--json", json, "print one flat JSON object");
  app.add_option("--only", only, "run the kernels whose name contains this");
  CLI11_PARSE(app, argc, argv);

  omp_set_num_threads(1);
  std::vector<Figure> figures;
  for (const Kernel& kernel : kernels) {
    if (std::string(kernel.name).find(only) == std::string::npos) continue;
    const auto measured = kernel.run();
    figures.insert(figures.end(), measured.begin(), measured.end());
  }
  for (std::size_t k = 0; k < figures.size(); ++k) {
    if (json)
      std::printf("%s\"%s\": %.6g", k ? ", " : "{", figures[k].name.c_str(), figures[k].value);
    else
      std::printf("%-32s %12.4g\n", figures[k].name.c_str(), figures[k].value);
  }
  if (json) std::puts(figures.empty() ? "{}" : "}");
  return 0;
}

}  // namespace
}  // namespace polynya::bench

int main(int argc, char** argv) {
  try {
    return polynya::bench::run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "polynya_bench: %s\n", error.what());
    return 1;
  }
}
