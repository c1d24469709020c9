#include "core/exchange/message_difference.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/exchange/wire.hpp"

namespace polynya::exchange {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// As many digits as tell a number from its neighbours.
template <class T>
std::string text(T number) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, number).ptr};
}

std::string text(std::uint8_t number) {
  return text(static_cast<int>(number));
}

std::string text(const nlohmann::json& value) {
  return value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// "[17][2]" of the value at a place in the array.
std::string index_text(const Array& array, std::size_t place) {
  std::string indices;
  for (auto extent = array.shape.rbegin(); extent != array.shape.rend(); ++extent) {
    const auto size = static_cast<std::size_t>(std::max<std::int64_t>(*extent, 1));
    indices = "[" + std::to_string(place % size) + "]" + indices;
    place /= size;
  }
  return indices;
}

void note(MessageDifference& all, double size, std::string sentence) {
  if (all.first.empty()) all.first = sentence;
  if (!(size > all.size) && !all.largest.empty()) return;
  all.size = size;
  all.largest = std::move(sentence);
}

std::string pair_text(const std::string& what, const std::string& sent, const std::string& recorded) {
  return what + " is " + sent + ", on record is " + recorded;
}

double relative(double sent, double recorded, double scale) {
  const double size = std::abs(sent - recorded) / scale;
  return std::isfinite(size) ? size : sent == recorded ? 0.0 : infinite;
}

/// Of flattened headers: "/account/kinetic" names what lies inside of something else.
void compare_headers(MessageDifference& all, const nlohmann::json& sent, const nlohmann::json& recorded,
                     bool last_words) {
  for (const auto& [name, value] : recorded.items()) {
    const std::string field = "field '" + name.substr(1) + "'";
    if (!sent.contains(name)) {
      note(all, infinite, field + " is missing, on record is " + text(value));
      continue;
    }
    const auto& own = sent[name];
    if (text(own) == text(value)) continue;
    const bool numbers = own.is_number_float() && value.is_number_float();
    const double scale = last_words || !numbers ? infinite : std::abs(value.get<double>());
    const double size = numbers ? relative(own.get<double>(), value.get<double>(), scale) : infinite;
    note(all, size, pair_text(field, text(own), text(value)));
  }
  for (const auto& [name, value] : sent.items())
    if (!recorded.contains(name)) note(all, infinite, "field '" + name.substr(1) + "' is not on record");
}

template <class T>
void compare_values(MessageDifference& all, const Message& sent, const Message& recorded, const Array& array) {
  const auto own = sent.view<T>(array.name), other = recorded.view<T>(array.name);
  double scale = 0;
  if constexpr (std::is_same_v<T, double>)
    for (const double value : other)
      if (std::isfinite(value)) scale = std::max(scale, std::abs(value));
  for (std::size_t i = 0; i < own.size(); ++i) {
    if (std::memcmp(&own[i], &other[i], sizeof(T)) == 0) continue;
    double size = infinite;
    if constexpr (std::is_same_v<T, double>) size = relative(own[i], other[i], scale);
    if (!all.first.empty() && size <= all.size) continue;
    note(all, size,
         pair_text("array '" + array.name + "', value " + index_text(array, i), text(own[i]), text(other[i])));
  }
}

void compare_arrays(MessageDifference& all, const Message& sent, const Message& recorded, const Array& array) {
  const std::string what = "array '" + array.name + "'";
  if (!sent.has(array.name)) return note(all, infinite, what + " is missing");
  const Array& own = sent.array(array.name);
  if (own.type != array.type || own.shape != array.shape)
    return note(all, infinite, pair_text(what, own.type + " " + shape_text(own), array.type + " " + shape_text(array)));
  if (own.bytes == array.bytes) return;
  if (array.type == "f8") return compare_values<double>(all, sent, recorded, array);
  if (array.type == "i8") return compare_values<std::int64_t>(all, sent, recorded, array);
  if (array.type == "i4") return compare_values<std::int32_t>(all, sent, recorded, array);
  compare_values<std::uint8_t>(all, sent, recorded, array);
}

}  // namespace

MessageDifference compare(const Message& sent, const Message& recorded) {
  MessageDifference all;
  compare_headers(all, sent.header.flatten(), recorded.header.flatten(), recorded.kind() == "finished");
  for (const Array& array : recorded.arrays) compare_arrays(all, sent, recorded, array);
  for (const Array& array : sent.arrays)
    if (!recorded.has(array.name)) note(all, infinite, "array '" + array.name + "' is not on record");
  return all;
}

}  // namespace polynya::exchange
