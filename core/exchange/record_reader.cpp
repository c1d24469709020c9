#include "core/exchange/record_reader.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>

#include "core/exchange/errors.hpp"
#include "core/exchange/record_file.hpp"

namespace polynya::exchange {

std::vector<std::string> recorded_participants(const std::string& folder) {
  const std::string first_file = "-00000.h5";
  std::vector<std::string> names;
  if (!std::filesystem::is_directory(folder)) return names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.ends_with(first_file)) names.push_back(name.substr(0, name.size() - first_file.size()));
  }
  std::sort(names.begin(), names.end());
  return names;
}

RecordReader::RecordReader(std::string folder, std::string participant)
    : folder_(std::move(folder)), participant_(std::move(participant)) {
  const std::vector<std::string> names = recorded_participants(folder_);
  if (names.empty())
    throw RecordError(folder_ + ": there is no record; run the scene again with record.interface = true (--record)");
  if (std::find(names.begin(), names.end(), participant_) == names.end()) {
    std::string list;
    for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
    throw RecordError(folder_ + ": nothing of " + participant_ + " is on record; recorded are " + list);
  }
  open_next();
}

bool RecordReader::open_next() {
  const std::string path = segment_path(folder_, participant_, files_);
  if (files_ > 0 && !std::filesystem::exists(path)) return false;
  ++files_;
  std::vector<RecordedMessage> all = read_segment(path, label_).take_messages();
  std::move(all.begin(), all.end(), std::back_inserter(messages_));
  return true;
}

const RecordedMessage* RecordReader::look() {
  while (messages_.empty())
    if (!open_next()) return nullptr;
  return &messages_.front();
}

std::optional<RecordedMessage> RecordReader::next() {
  if (look() == nullptr) return std::nullopt;
  RecordedMessage message = std::move(messages_.front());
  messages_.pop_front();
  return message;
}

void check_replayable(const std::string& folder, const std::string& participant) {
  RecordReader reader(folder, participant);
  if (reader.label().region)
    throw RecordError(folder +
                      ": holds only what lay in record.region; such a record is to look at and cannot be "
                      "replayed; run the scene again without record.region");
  const RecordSelection& selection = reader.label().selection;
  if (selection.from_the_start()) return;
  const bool by_time = !selection.times.empty();
  const nlohmann::json first =
      by_time ? nlohmann::json(selection.times.front()) : nlohmann::json(selection.windows.front());
  throw RecordError(folder + ": begins at " + (by_time ? "t = " : "window ") + first.dump() + (by_time ? " s" : "") +
                    "; a replay needs the run from its start; run the scene again with record." +
                    (by_time ? "times" : "windows") + " that begin at 0");
}

}  // namespace polynya::exchange
