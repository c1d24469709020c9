#include "core/exchange/wire.hpp"

#include <array>
#include <bit>
#include <utility>

#include "core/exchange/errors.hpp"

static_assert(std::endian::native == std::endian::little, "arrays travel in little-endian order, without conversion");

namespace polynya::exchange {
namespace {

using nlohmann::json;

constexpr std::array<const char*, 5> reserved_fields{"protocol", "run", "part", "parts", "arrays"};

std::size_t item_size(const std::string& type, const std::string& name) {
  if (type == "f8" || type == "i8") return 8;
  if (type == "i4") return 4;
  if (type == "u1") return 1;
  throw ProtocolError("array '" + name + "' has the unknown type '" + type + "'; known are f8, i8, i4 and u1");
}

const json& field(const json& object, const char* name, json::value_t type, const std::string& where) {
  const auto found = object.find(name);
  const bool integer = type == json::value_t::number_integer;
  if (found == object.end() || (integer ? !found->is_number_integer() : found->type() != type))
    throw ProtocolError(where + " lacks the field '" + name + "' of type " +
                        (integer ? "integer" : json(type).type_name()));
  return *found;
}

json parse(std::string_view frame) {
  json header = json::parse(frame.begin(), frame.end(), nullptr, false);
  if (!header.is_object()) throw ProtocolError("the first frame of a message is not a JSON object");
  return header;
}

std::string dump(const json& value) {
  return value.dump(-1, ' ', false, json::error_handler_t::replace);
}

/// Written directly: there are several in every message, and their values are few.
void append_descriptor(std::string& text, const Array& array) {
  text.append("{\"name\":").append(dump(array.name)).append(",\"type\":\"").append(array.type).append("\",\"shape\":[");
  for (const std::int64_t extent : array.shape) text.append(std::to_string(extent)) += ',';
  if (!array.shape.empty()) text.pop_back();
  text.append("]}");
}

Array decode_descriptor(const json& descriptor, const std::string& where) {
  if (!descriptor.is_object()) throw ProtocolError(where + " has an array descriptor that is not an object");
  Array array;
  array.name = field(descriptor, "name", json::value_t::string, where + ", an array descriptor");
  const std::string owner = where + ", array '" + array.name + "',";
  array.type = field(descriptor, "type", json::value_t::string, owner);
  for (const json& extent : field(descriptor, "shape", json::value_t::array, owner)) {
    if (!extent.is_number_integer()) throw ProtocolError(owner + " has a shape that is not a list of integers");
    array.shape.push_back(extent);
  }
  byte_count(array);
  return array;
}

void check_parts(const json& header, const std::string& where) {
  const json& part = field(header, "part", json::value_t::number_integer, where);
  const json& parts = field(header, "parts", json::value_t::number_integer, where);
  if (part != 1 || parts != 1)
    throw ProtocolError(where + " is part " + part.dump() + " of " + parts.dump() +
                        "; this version takes messages in one part only");
}

}  // namespace

std::size_t byte_count(const Array& array) {
  constexpr std::int64_t limit = std::int64_t{1} << 62;
  std::int64_t count = static_cast<std::int64_t>(item_size(array.type, array.name));
  for (const std::int64_t extent : array.shape) {
    if (extent < 0) throw ProtocolError("array '" + array.name + "' has a negative extent in " + shape_text(array));
    if (extent > 0 && count > limit / extent)
      throw ProtocolError("array '" + array.name + "' is too large: " + shape_text(array));
    count *= extent;
  }
  return static_cast<std::size_t>(count);
}

std::string shape_text(const Array& array) {
  std::string text;
  for (const std::int64_t extent : array.shape) text.append("[").append(std::to_string(extent)).append("]");
  return text.empty() ? "[]" : text;
}

std::string encode_header(const Message& message, const Envelope& envelope) {
  for (const char* name : reserved_fields)
    if (message.header.contains(name))
      throw ProtocolError("message '" + message.kind() + "' may not have a field '" + name + "': the name is reserved");
  std::string text = dump(message.header);
  text.pop_back();  // the brace
  if (!message.header.empty()) text += ',';
  text.append("\"protocol\":").append(std::to_string(envelope.protocol)).append(",\"run\":").append(dump(envelope.run));
  text.append(",\"part\":1,\"parts\":1,\"arrays\":[");
  for (const Array& array : message.arrays) {
    if (array.bytes.size() != byte_count(array))
      throw ProtocolError("array '" + array.name + "' of message '" + message.kind() + "' has " +
                          std::to_string(array.bytes.size()) + " bytes, its shape " + shape_text(array) + " needs " +
                          std::to_string(byte_count(array)));
    append_descriptor(text, array);
    text += ',';
  }
  if (!message.arrays.empty()) text.pop_back();
  return text.append("]}");
}

Message decode_header(std::string_view frame, Envelope& envelope) {
  json header = parse(frame);
  Message message(field(header, "kind", json::value_t::string, "a message header").get<std::string>());
  const std::string where = "message '" + message.kind() + "'";
  envelope.protocol = field(header, "protocol", json::value_t::number_integer, where);
  envelope.run = field(header, "run", json::value_t::string, where);
  check_parts(header, where);
  for (const json& descriptor : field(header, "arrays", json::value_t::array, where)) {
    Array array = decode_descriptor(descriptor, where);
    if (message.has(array.name)) throw ProtocolError(where + " has two arrays '" + array.name + "'");
    message.arrays.push_back(std::move(array));
  }
  for (const char* name : reserved_fields) header.erase(name);
  message.header = std::move(header);
  return message;
}

void fill(Array& array, Bytes frame, std::string_view kind) {
  if (frame.size() != byte_count(array))
    throw ProtocolError("array '" + array.name + "' of message '" + std::string(kind) + "' came with " +
                        std::to_string(frame.size()) + " bytes, its shape " + shape_text(array) + " needs " +
                        std::to_string(byte_count(array)));
  array.bytes = std::move(frame);
}

void expect_kind(const Message& message, std::string_view kind) {
  if (message.kind() != kind)
    throw ProtocolError("expected a message '" + std::string(kind) + "', received '" + message.kind() + "'");
}

}  // namespace polynya::exchange
