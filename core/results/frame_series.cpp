#include "core/results/frame_series.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/results/durable_file.hpp"
#include "core/results/error.hpp"

namespace polynya::results {

FrameSeries::FrameSeries(std::string run_folder, std::string name)
    : folder_(std::move(run_folder) + "/fields"), name_(std::move(name)) {}

void FrameSeries::write(int number, const UnstructuredFields& fields, double time) {
  if (number < 0) throw ResultsError("frames of " + name_ + " are numbered from 0, not " + std::to_string(number));
  char digits[16];
  std::snprintf(digits, sizeof digits, "_%04d", number);
  const std::string file = name_ + digits + ".vtkhdf";
  if (std::exchange(cut_, false)) remove_others();
  write_frame(folder_ + "/" + file, fields, time);
  std::erase_if(entries_, [&](const Entry& entry) { return entry.file == file; });
  entries_.push_back({file, time});
  write_index();
}

void FrameSeries::list_state(compute::StateArchive& archive) {
  archive.item("frames", entries_);
  cut_ = archive.loading();
}

void FrameSeries::remove_others() const {
  if (!std::filesystem::is_directory(folder_)) return;
  for (const auto& found : std::filesystem::directory_iterator(folder_)) {
    const std::string file = found.path().filename().string();
    const bool ours = file.starts_with(name_ + "_") && file.ends_with(".vtkhdf");
    if (ours && std::none_of(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.file == file; }))
      std::filesystem::remove(found.path());
  }
}

void FrameSeries::write_index() const {
  nlohmann::json frames = nlohmann::json::array();
  for (const Entry& entry : entries_) frames.push_back({{"file", entry.file}, {"time", entry.time}});
  replace_text(folder_ + "/" + name_ + ".json", nlohmann::json{{"frames", std::move(frames)}}.dump(1) + "\n");
}

}  // namespace polynya::results
