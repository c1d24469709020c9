#include "core/exchange/message.hpp"

#include <algorithm>

#include "core/exchange/errors.hpp"
#include "core/exchange/wire.hpp"

namespace polynya::exchange {
namespace {

template <class T>
constexpr const char* type_name() {
  if constexpr (std::is_same_v<T, double>) return "f8";
  if constexpr (std::is_same_v<T, std::int64_t>) return "i8";
  if constexpr (std::is_same_v<T, std::int32_t>) return "i4";
  if constexpr (std::is_same_v<T, std::uint8_t>) return "u1";
}

}  // namespace

bool Message::has(std::string_view name) const {
  return std::any_of(arrays.begin(), arrays.end(), [&](const Array& a) { return a.name == name; });
}

const Array& Message::array(std::string_view name) const {
  const auto found = std::find_if(arrays.begin(), arrays.end(), [&](const Array& a) { return a.name == name; });
  if (found == arrays.end()) throw ProtocolError("message '" + kind() + "' has no array '" + std::string(name) + "'");
  return *found;
}

void Message::add_bytes(std::string name, const char* type, std::vector<std::int64_t> shape, std::size_t count,
                        Bytes bytes) {
  Array array{std::move(name), type, std::move(shape), std::move(bytes)};
  if (byte_count(array) != array.bytes.size())
    throw ProtocolError("array '" + array.name + "' of message '" + kind() + "': shape " + shape_text(array) +
                        " does not hold " + std::to_string(count) + " values");
  if (has(array.name)) throw ProtocolError("message '" + kind() + "' has two arrays '" + array.name + "'");
  arrays.push_back(std::move(array));
}

template <class T>
void Message::add(std::string name, std::vector<std::int64_t> shape, std::span<const T> data) {
  add_bytes(std::move(name), type_name<T>(), std::move(shape), data.size(), Bytes(std::as_bytes(data)));
}

template <class T>
void Message::add(std::string name, std::vector<std::int64_t> shape, std::vector<T>&& data) {
  const std::size_t count = data.size();
  add_bytes(std::move(name), type_name<T>(), std::move(shape), count, Bytes(std::move(data)));
}

template <class T>
std::span<const T> Message::view(std::string_view name) const {
  const Array& found = array(name);
  if (found.type != type_name<T>())
    throw ProtocolError("array '" + found.name + "' of message '" + kind() + "' is of type " + found.type + ", not " +
                        type_name<T>());
  if (found.bytes.size() != byte_count(found))
    throw ProtocolError("array '" + found.name + "' of message '" + kind() + "' has " +
                        std::to_string(found.bytes.size()) + " bytes, its shape " + shape_text(found) + " needs " +
                        std::to_string(byte_count(found)));
  return {reinterpret_cast<const T*>(found.bytes.data()), found.bytes.size() / sizeof(T)};
}

template void Message::add(std::string, std::vector<std::int64_t>, std::span<const double>);
template void Message::add(std::string, std::vector<std::int64_t>, std::vector<double>&&);
template void Message::add(std::string, std::vector<std::int64_t>, std::span<const std::int64_t>);
template void Message::add(std::string, std::vector<std::int64_t>, std::vector<std::int64_t>&&);
template void Message::add(std::string, std::vector<std::int64_t>, std::span<const std::int32_t>);
template void Message::add(std::string, std::vector<std::int64_t>, std::vector<std::int32_t>&&);
template void Message::add(std::string, std::vector<std::int64_t>, std::span<const std::uint8_t>);
template void Message::add(std::string, std::vector<std::int64_t>, std::vector<std::uint8_t>&&);
template std::span<const double> Message::view(std::string_view) const;
template std::span<const std::int64_t> Message::view(std::string_view) const;
template std::span<const std::int32_t> Message::view(std::string_view) const;
template std::span<const std::uint8_t> Message::view(std::string_view) const;

}  // namespace polynya::exchange
