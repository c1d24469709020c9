// What of the messages between coupler and solvers is recorded.
#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "core/scene/parts.hpp"
#include "core/scene/units.hpp"

namespace polynya::scene {
namespace {

std::string trimmed(const std::string& word) {
  const auto first = word.find_first_not_of(" \t"), last = word.find_last_not_of(" \t");
  return first == std::string::npos ? "" : word.substr(first, last - first + 1);
}

/// The names between commas, checked; empty for all.
std::string chosen_participants(const Values& values, const Scene& scene) {
  const std::string text = values.text("record.participants");
  if (text == "all") return {};
  std::string names;
  std::istringstream words(text);
  for (std::string word; std::getline(words, word, ',');) {
    const std::string name = trimmed(word);
    std::string known;
    for (const auto& [participant, command] : scene.participants) known += (known.empty() ? "" : ", ") + participant;
    if (!scene.participants.contains(name))
      values.fail("record.participants",
                  "'" + name + "' takes no part in this scene; allowed here: all, or some of " + known);
    names += (names.empty() ? "" : ",") + name;
  }
  if (names.empty()) values.fail("record.participants", "must be all, or names with commas between them");
  return names;
}

/// "A to B, C, D to end" as [A, B, C, C, D]. `read` gives a value or nothing, or throws.
template <class T, class Read>
std::vector<T> intervals(const Values& values, const std::string& key, Read&& read) {
  const std::string text = values.text(key);
  std::vector<T> ends;
  if (text == "all") return ends;
  const auto refuse = [&](const std::string& what) {
    values.fail(key, what + "; allowed here: all, or intervals such as " +
                         (key == "record.times" ? "\"0 to 20 us, 0.1 ms to end\"" : "\"0 to 100, 250, 300 to end\""));
  };
  const auto take = [&](const std::string& word) {
    std::optional<T> value;
    try {
      value = read(trimmed(word));
    } catch (const std::invalid_argument&) {
    }
    if (!value || *value < 0)
      refuse("'" + trimmed(word) + "' is not " + (key == "record.times" ? "a time" : "a window"));
    ends.push_back(*value);
  };
  std::istringstream list(text);
  for (std::string part; std::getline(list, part, ',');) {
    if (ends.size() % 2 == 1) refuse("nothing comes after the end");
    const auto middle = part.find(" to ");
    take(part.substr(0, middle));
    const std::string last = middle == std::string::npos ? part : part.substr(middle + 4);
    if (trimmed(last) != "end") take(last);
  }
  if (ends.empty()) refuse("names nothing");
  if (!std::is_sorted(ends.begin(), ends.end())) refuse("times and windows must ascend");
  return ends;
}

}  // namespace

void read_record(const Values& values, Scene& scene) {
  if (values.text("record.interface") != "true") return;
  if (scene.participants.size() < 2)
    values.fail("record.interface", "there are no messages to record where one solver runs alone; allowed here: false");
  Record& record = scene.record.emplace();
  record.participants = chosen_participants(values, scene);
  record.compression = values.text("record.compression");
  record.times = intervals<double>(values, "record.times", [](const std::string& word) -> std::optional<double> {
    const Quantity time = parse_quantity(word);
    return time.bare || time.dimension == dimension::time ? std::optional(time.value) : std::nullopt;
  });
  record.windows = intervals<std::int64_t>(values, "record.windows", [](const std::string& word) {
    std::int64_t number = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    const bool whole = error == std::errc() && end == word.data() + word.size();
    return whole ? std::optional(number) : std::nullopt;
  });
  if (!record.times.empty() && !record.windows.empty())
    values.fail("record.windows", "must not be given together with record.times");
  const auto side = [&](const std::string& name) { return values.given("record.region." + name); };
  record.x_min = side("x_min"), record.x_max = side("x_max");
  record.y_min = side("y_min"), record.y_max = side("y_max");
  record.z_min = side("z_min"), record.z_max = side("z_max");
  for (const auto& [low, high, name] : {std::tuple(record.x_min, record.x_max, "x"),
                                        {record.y_min, record.y_max, "y"},
                                        {record.z_min, record.z_max, "z"}})
    if (low && high && *high < *low)
      values.fail(std::string("record.region.") + name + "_max", "must not be below the other side of the box");
}

}  // namespace polynya::scene
