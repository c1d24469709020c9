#include "coupler/recording.hpp"

#include <spdlog/spdlog.h>

#include <limits>
#include <sstream>

namespace polynya::coupler {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

exchange::Recorder::Options options_of(const scene::Record& record) {
  exchange::Recorder::Options options;
  std::istringstream names(record.participants);
  for (std::string name; std::getline(names, name, ',');) options.participants.push_back(name);
  options.selection = {record.times, record.windows};
  options.compression = record.compression == "deflate" ? exchange::Compression::deflate : exchange::Compression::none;
  if (record.has_region())
    options.region = {record.x_min.value_or(-infinity), record.y_min.value_or(-infinity),
                      record.z_min.value_or(-infinity), record.x_max.value_or(infinity),
                      record.y_max.value_or(infinity),  record.z_max.value_or(infinity)};
  return options;
}

}  // namespace

std::unique_ptr<exchange::Recorder> start_recorder(const scene::Scene& scene, const std::string& run_folder,
                                                   const std::string& run_id, exchange::Hub& hub) {
  if (!scene.record) return nullptr;
  exchange::Recorder::Options options = options_of(*scene.record);
  options.folder = run_folder + "/record";
  options.run = run_id;
  auto recorder = std::make_unique<exchange::Recorder>(std::move(options));
  hub.record(*recorder);
  return recorder;
}

void finish_recorder(exchange::Recorder& recorder) {
  const exchange::Recorder::Statistics s = recorder.close();
  spdlog::info(
      "record: {} messages, {:.1f} MB; took the coupler {:.2f} s in all windows and {:.2f} s at the end, and {:.2f} s "
      "of "
      "processor time beside it",
      s.messages, 1e-6 * static_cast<double>(s.bytes), s.noting_seconds, s.closing_seconds, s.busy_seconds);
}

}  // namespace polynya::coupler
