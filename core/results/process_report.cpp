#include "core/results/process_report.hpp"

#include <sys/resource.h>

#include <nlohmann/json.hpp>

#include "core/results/durable_file.hpp"

namespace polynya::results {
namespace {

rusage usage() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  return used;
}

double in_seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

double ProcessReport::wall_time() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

double ProcessReport::cpu_time() {
  const rusage used = usage();
  return in_seconds(used.ru_utime) + in_seconds(used.ru_stime);
}

double ProcessReport::peak_memory() {
  return 1024.0 * static_cast<double>(usage().ru_maxrss);
}  // Linux counts kibibytes

void ProcessReport::write(const std::string& run_folder, const std::string& name) const {
  const nlohmann::json report = {{"wall_time", wall_time()},     {"cpu_time", cpu_time()},
                                 {"peak_memory", peak_memory()}, {"waiting_time", waiting_time},
                                 {"seconds", seconds},           {"counts", counts}};
  replace_text(run_folder + "/logs/" + name + ".json", report.dump(1) + "\n");
}

}  // namespace polynya::results
