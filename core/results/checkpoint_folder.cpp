#include "core/results/checkpoint_folder.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/results/durable_file.hpp"
#include "core/results/error.hpp"

namespace polynya::results {
namespace {

constexpr const char* manifest = "manifest.json";
constexpr double infinity = std::numeric_limits<double>::infinity();

/// All checkpoints but the last two valid ones; what is in work has a higher number and none of our concern.
void remove_older(const std::filesystem::path& folder, const std::string& newest) {
  std::vector<std::filesystem::path> older;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.is_directory() && entry.path().filename() < newest) older.push_back(entry.path());
  std::sort(older.rbegin(), older.rend());
  bool kept = false;
  for (const std::filesystem::path& path : older) {
    if (!kept && std::filesystem::exists(path / manifest)) {
      kept = true;
      continue;
    }
    std::error_code ignored;  // a checkpoint that stays costs disk space only
    // Without its manifest it is no checkpoint any more, however far the removal comes.
    std::filesystem::remove(path / manifest, ignored);
    std::filesystem::remove_all(path, ignored);
  }
}

}  // namespace

std::string checkpoint_folder(std::int64_t step) {
  char digits[32];
  std::snprintf(digits, sizeof digits, "checkpoints/%09lld", static_cast<long long>(step));
  return digits;
}

void commit_checkpoint(const std::string& run_folder, std::int64_t step, double time,
                       const std::vector<std::string>& files) {
  const std::filesystem::path folder = std::filesystem::path(run_folder) / checkpoint_folder(step);
  nlohmann::json content{{"step", step}, {"time", time}, {"files", nlohmann::json::object()}};
  for (const std::string& file : files) {
    std::error_code failed;
    const auto size = std::filesystem::file_size(folder / file, failed);
    if (failed) throw ResultsError((folder / file).string() + ": is not there, so the checkpoint is not valid");
    content["files"][file] = size;
  }
  replace_text((folder / manifest).string(), content.dump(1) + "\n");
  remove_older(folder.parent_path(), folder.filename().string());
}

CheckpointSchedule::CheckpointSchedule(double interval, double wall_interval, double time)
    : interval_(interval), wall_interval_(wall_interval), next_(interval > 0 ? time + interval : infinity) {}

bool CheckpointSchedule::due(double time) const {
  if (time >= next_) return true;
  return wall_interval_ > 0 && std::chrono::duration<double>(Clock::now() - last_).count() >= wall_interval_;
}

void CheckpointSchedule::taken(double time) {
  last_ = Clock::now();
  if (interval_ > 0)
    while (next_ <= time) next_ += interval_;
}

}  // namespace polynya::results
