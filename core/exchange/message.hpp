#pragma once
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/exchange/bytes.hpp"

namespace polynya::exchange {

/// One named, typed, shaped array: little-endian, C order. Types: "f8", "i8", "i4", "u1".
struct Array {
  std::string name;
  std::string type;
  std::vector<std::int64_t> shape;
  Bytes bytes;
};

/// A header of scalars and any number of arrays. On the wire: one JSON frame and one raw frame per array.
struct Message {
  nlohmann::json header = nlohmann::json::object();
  std::vector<Array> arrays;

  explicit Message(std::string_view kind = {}) { header["kind"] = kind; }
  std::string kind() const { return header.value("kind", std::string{}); }
  bool has(std::string_view name) const;

  /// Adds a copy of data (double, int64_t, int32_t or uint8_t).
  template <class T>
  void add(std::string name, std::vector<std::int64_t> shape, std::span<const T> data);
  /// The same without a copy: the memory of data becomes the message's.
  template <class T>
  void add(std::string name, std::vector<std::int64_t> shape, std::vector<T>&& data);
  /// Read-only view of an array. Throws ProtocolError naming the message and the array when it is missing or of
  /// another type.
  template <class T>
  std::span<const T> view(std::string_view name) const;
  const Array& array(std::string_view name) const;

 private:
  void add_bytes(std::string name, const char* type, std::vector<std::int64_t> shape, std::size_t count, Bytes bytes);
};

}  // namespace polynya::exchange
