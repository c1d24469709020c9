#include "core/results/process_report.hpp"

#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/results/durable_file.hpp"

namespace polynya::results {
namespace {

double in_seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

std::string table_of(const std::map<std::string, Waits>& waits) {
  std::ostringstream text;
  text.precision(std::numeric_limits<double>::max_digits10);
  text << "from [s],to [s],for\n";
  for (const auto& [whom, list] : waits)
    for (const auto& [from, to] : list) text << from << ',' << to << ',' << whom << '\n';
  return text.str();
}

}  // namespace

void ProcessReport::set_headings(const std::map<std::string, double>& wall, const std::map<std::string, double>& cpu) {
  seconds = wall;
  cpu_seconds = cpu;
  if (const auto messages = seconds.find("messages"); messages != seconds.end()) messages->second -= waiting_time();
}

double ProcessReport::wall_time() {
  // "pid (command) state ...", field 22: start in clock ticks since boot. The command may contain anything.
  std::ifstream file("/proc/self/stat");
  const std::string stat{std::istreambuf_iterator<char>(file), {}};
  std::istringstream fields(stat.substr(stat.rfind(')') + 1));
  std::string field;
  for (int number = 3; number <= 22; ++number) fields >> field;
  timespec now{};
  clock_gettime(CLOCK_BOOTTIME, &now);
  const double start = std::stod(field) / static_cast<double>(sysconf(_SC_CLK_TCK));
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec) - start;
}

double ProcessReport::waiting_time() const {
  double sum = 0;
  for (const auto& [whom, list] : waits)
    for (const auto& [from, to] : list) sum += to - from;
  return sum;
}

double ProcessReport::cpu_time() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  return in_seconds(used.ru_utime) + in_seconds(used.ru_stime);
}

double ProcessReport::peak_memory() {
  // Not ru_maxrss: a process inherits that of the one that started it.
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (double kibibytes = 0; word == "VmHWM:" && status >> kibibytes) return 1024 * kibibytes;
  return 0;
}

void ProcessReport::write(const std::string& run_folder, const std::string& name) const {
  const nlohmann::json report = {
      {"wall_time", wall_time()},     {"cpu_time", cpu_time()}, {"waiting_time", waiting_time()}, {"threads", threads},
      {"peak_memory", peak_memory()}, {"seconds", seconds},     {"cpu_seconds", cpu_seconds},     {"counts", counts}};
  replace_text(run_folder + "/logs/" + name + ".json", report.dump(1) + "\n");
  if (!waits.empty()) replace_text(run_folder + "/logs/" + name + "_waits.csv", table_of(waits));
}

}  // namespace polynya::results
