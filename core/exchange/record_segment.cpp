#include "core/exchange/record_segment.hpp"

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

/// Takes the next array of a series out again, in the order in which they went in.
void take(ArraySeries& series, std::size_t& taken, std::int64_t message, Array& array) {
  if (taken >= series.message.size() || series.message[taken] != message || !continues(series, array))
    throw ProtocolError("the record's array '" + array.name + "' does not follow the headers of its messages");
  array.bytes = std::move(series.values[taken++]);
  if (array.bytes.size() != byte_count(array))
    throw ProtocolError("the record's array '" + array.name + "' has not the shape " + shape_text(array));
}

}  // namespace

bool RecordSegment::fits(const Message& message) const {
  for (const Array& array : message.arrays) {
    const auto found = series.find({message.kind(), array.name});
    if (found != series.end() && !continues(found->second, array)) return false;
  }
  return true;
}

void RecordSegment::append(RecordedMessage&& recorded, const std::string& run) {
  Message& message = recorded.message;
  header.push_back(encode_header(message, {protocol_version, run}));
  sender.push_back(static_cast<std::uint8_t>(recorded.sender));
  window.push_back(recorded.window);
  time.push_back(recorded.time);
  bytes += header.back().size();
  const std::string kind = message.kind();
  for (Array& array : message.arrays) {
    ArraySeries& all = series[{kind, array.name}];
    if (all.message.empty()) {
      all.type = array.type;
      all.scalar = array.shape.empty();
      all.trailing = trailing_extents(array);
    }
    all.message.push_back(static_cast<std::int64_t>(header.size()) - 1);
    all.first.push_back(all.first.back() + (array.shape.empty() ? 1 : array.shape.front()));
    bytes += array.bytes.size();
    all.values.push_back(std::move(array.bytes));
  }
}

std::vector<RecordedMessage> RecordSegment::take_messages() {
  std::vector<RecordedMessage> all;
  std::map<std::pair<std::string, std::string>, std::size_t> taken;
  for (std::size_t i = 0; i < header.size(); ++i) {
    Envelope envelope;
    RecordedMessage recorded{static_cast<Sender>(sender[i]), window[i], time[i], decode_header(header[i], envelope)};
    for (Array& array : recorded.message.arrays) {
      const std::pair key(recorded.message.kind(), array.name);
      const auto found = series.find(key);
      if (found == series.end()) throw ProtocolError("the record lacks the array '" + array.name + "'");
      take(found->second, taken[key], static_cast<std::int64_t>(i), array);
    }
    all.push_back(std::move(recorded));
  }
  *this = {};
  return all;
}

}  // namespace polynya::exchange
