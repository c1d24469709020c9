// What of the messages between coupler and solvers is recorded.
#include <sstream>

#include "core/scene/parts.hpp"

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

}  // namespace

void read_record(const Values& values, Scene& scene) {
  if (values.text("record.interface") != "true") return;
  if (scene.participants.size() < 2)
    values.fail("record.interface", "there are no messages to record where one solver runs alone; allowed here: false");
  Record& record = scene.record.emplace();
  record.participants = chosen_participants(values, scene);
  record.from = values.number("record.from");
  record.until = values.given("record.until");
  if (record.until && *record.until < record.from) values.fail("record.until", "must not be before record.from");
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
