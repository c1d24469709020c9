#pragma once
#include <cstddef>
#include <string>
#include <string_view>

#include "core/exchange/message.hpp"

namespace polynya::exchange {

/// Version of the wire format and of the conversation in docs/protocol.md.
inline constexpr int protocol_version = 2;

/// What every header carries besides the message's own fields.
struct Envelope {
  int protocol = 0;
  std::string run;
};

/// Bytes that an array of this type and shape takes. Throws ProtocolError for an unknown type, a negative extent, or
/// a size beyond 2^62.
std::size_t byte_count(const Array& array);

/// "[2000][3]"; "[]" for a scalar.
std::string shape_text(const Array& array);

/// The JSON header frame: the message's fields, the envelope, and one descriptor per array. Throws ProtocolError when
/// an array's bytes do not fit its shape or a field has a reserved name.
std::string encode_header(const Message& message, const Envelope& envelope);

/// A message without the bytes of its arrays from a header frame. Checks everything but the envelope's values, which
/// are the receiver's matter. Throws ProtocolError.
Message decode_header(std::string_view frame, Envelope& envelope);

/// Gives a frame to the array that its descriptor announced. Throws ProtocolError when the sizes differ.
void fill(Array& array, Bytes frame, std::string_view kind);

/// Throws ProtocolError unless the message is of this kind.
void expect_kind(const Message& message, std::string_view kind);

}  // namespace polynya::exchange
