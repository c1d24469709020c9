#include "core/scene/rows.hpp"

#include <sstream>
#include <stdexcept>

namespace polynya::scene {
namespace {

std::vector<std::string> split(const std::string& text, char mark) {
  std::vector<std::string> parts;
  std::istringstream words(text);
  for (std::string word; std::getline(words, word, mark);) parts.push_back(word);
  return parts;
}

/// One number with its dimension; `example` shows what the key may hold.
double number_in(const Values& values, const std::string& key, const std::string& word, const Dimension& dimension,
                 const std::string& example) {
  try {
    const Quantity quantity = parse_quantity(word);
    if (quantity.bare || quantity.dimension == dimension) return quantity.value;
  } catch (const std::invalid_argument&) {
  }
  values.fail(key, "'" + word + "' is not " + describe(dimension) + "; write \"" + example + "\"");
}

}  // namespace

std::vector<double> row_in(const Values& values, const std::string& key, const std::string& text, std::size_t count,
                           const Dimension& dimension, const std::string& example) {
  std::vector<double> row;
  for (const std::string& word : split(text, ',')) row.push_back(number_in(values, key, word, dimension, example));
  if (row.size() != count)
    values.fail(key, "'" + text + "' has " + std::to_string(row.size()) + " numbers, must have " +
                         std::to_string(count) + "; write \"" + example + "\"");
  return row;
}

void read_table(const Values& values, const std::string& key, std::size_t count, const Dimension& dimension,
                const std::string& example, std::vector<double>& times, std::vector<double>& rows) {
  const std::string text = values.text(key);
  for (const std::string& entry : split(text, ';')) {
    const auto at = entry.find(" at ");
    if (at == std::string::npos && text.find(';') != std::string::npos)
      values.fail(key, "'" + entry + "' has no time; write \"" + example + "\"");
    const auto row = row_in(values, key, entry.substr(0, at), count, dimension, example);
    rows.insert(rows.end(), row.begin(), row.end());
    times.push_back(at == std::string::npos ? 0.0
                                            : number_in(values, key, entry.substr(at + 4), dimension::time, example));
    if (times.size() == 1 ? times[0] != 0 : times.back() <= times[times.size() - 2])
      values.fail(key, times.size() == 1 ? "the first time must be 0"
                                         : "times must rise from entry to entry; that of '" + entry + "' does not");
  }
}

}  // namespace polynya::scene
