#include "core/exchange/record_segment.hpp"

#include <cstring>
#include <memory>

#include "core/exchange/errors.hpp"
#include "core/exchange/wire.hpp"

namespace polynya::exchange {
namespace {

std::vector<std::int64_t> trailing_extents(const Array& array) {
  if (array.shape.empty()) return {};
  return {array.shape.begin() + 1, array.shape.end()};
}

bool continues(const ArraySeries& series, const Array& array) {
  return series.type == array.type && series.scalar == array.shape.empty() &&
         series.trailing == trailing_extents(array);
}

/// Whether the array is the same as the last one of the series.
bool repeats(const ArraySeries& series, const Array& array, std::int64_t rows) {
  if (series.rows.empty() || rows != series.rows.back().last - series.rows.back().first) return false;
  const std::size_t first = static_cast<std::size_t>(series.rows.back().first) * series.row_bytes();
  return std::memcmp(series.values.data() + first, array.bytes.data(), array.bytes.size()) == 0;
}

/// Returns how many bytes it took.
std::size_t add(ArraySeries& series, const Array& array, std::int64_t message) {
  if (series.rows.empty()) {
    series.type = array.type;
    series.scalar = array.shape.empty();
    series.trailing = trailing_extents(array);
  }
  const std::int64_t rows = array.shape.empty() ? 1 : array.shape.front();
  if (array.bytes.empty() || !repeats(series, array, rows)) {
    series.rows.push_back({message, series.count, series.count + rows});
    series.count += rows;
    series.values.append({array.bytes.data(), array.bytes.size()});
    return array.bytes.size();
  }
  series.rows.push_back({message, series.rows.back().first, series.rows.back().last});
  return 0;
}

/// A series on its way out, in the order in which it went in.
struct Outgoing {
  std::shared_ptr<const ArraySeries> series;
  std::size_t taken = 0;

  void take(std::int64_t message, Array& array) {
    if (taken >= series->rows.size() || series->rows[taken].message != message || !continues(*series, array))
      throw ProtocolError("the record's array '" + array.name + "' does not follow the headers of its messages");
    const auto [number, first, last] = series->rows[taken++];
    const std::size_t size = series->row_bytes(), begin = static_cast<std::size_t>(first) * size;
    array.bytes = Bytes({series->values.data() + begin, static_cast<std::size_t>(last - first) * size}, series);
    if (array.bytes.size() != byte_count(array))
      throw ProtocolError("the record's array '" + array.name + "' has not the shape " + shape_text(array));
  }
};

}  // namespace

std::size_t ArraySeries::row_bytes() const {
  return byte_count({{}, type, trailing, {}});
}

bool RecordSegment::fits(const Message& message) const {
  for (const Array& array : message.arrays) {
    const auto found = series.find({message.kind(), array.name});
    if (found != series.end() && !found->second.rows.empty() && !continues(found->second, array)) return false;
  }
  return true;
}

void RecordSegment::append(const RecordedMessage& recorded, const std::string& run) {
  const Message& message = recorded.message;
  header.push_back(encode_header(message, {protocol_version, run}));
  sender.push_back(static_cast<std::uint8_t>(recorded.sender));
  window.push_back(recorded.window);
  time.push_back(recorded.time);
  bytes += header.back().size();
  const std::string kind = message.kind();
  for (const Array& array : message.arrays)
    bytes += add(series[{kind, array.name}], array, static_cast<std::int64_t>(header.size()) - 1);
}

void RecordSegment::clear() {
  header.clear(), sender.clear(), window.clear(), time.clear();
  bytes = 0;
  for (auto& [key, all] : series) {
    all.rows.clear(), all.values.clear();
    all.count = 0;
  }
}

std::vector<RecordedMessage> RecordSegment::take_messages() {
  std::vector<RecordedMessage> all;
  std::map<std::pair<std::string, std::string>, Outgoing> outgoing;
  for (auto& [key, values] : series) outgoing[key].series = std::make_shared<const ArraySeries>(std::move(values));
  for (std::size_t i = 0; i < header.size(); ++i) {
    Envelope envelope;
    RecordedMessage recorded{static_cast<Sender>(sender[i]), window[i], time[i], decode_header(header[i], envelope)};
    for (Array& array : recorded.message.arrays) {
      const auto found = outgoing.find({recorded.message.kind(), array.name});
      if (found == outgoing.end()) throw ProtocolError("the record lacks the array '" + array.name + "'");
      found->second.take(static_cast<std::int64_t>(i), array);
    }
    all.push_back(std::move(recorded));
  }
  *this = {};
  return all;
}

}  // namespace polynya::exchange
