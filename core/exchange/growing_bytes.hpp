#pragma once
#include <cstddef>
#include <span>

namespace polynya::exchange {

/// Bytes one behind the other from the beginning of a page on, as writing past the kernel's cache needs them. Grows
/// without a copy, and keeps its memory when emptied: memory that the kernel has yet to find costs more than copying
/// into it. Throws std::bad_alloc.
class GrowingBytes {
 public:
  GrowingBytes() = default;
  GrowingBytes(GrowingBytes&& other) noexcept;
  GrowingBytes& operator=(GrowingBytes&& other) noexcept;
  ~GrowingBytes();

  const std::byte* data() const { return data_; }
  std::size_t size() const { return size_; }
  /// Adds room for so many more bytes and tells where it begins.
  std::byte* extend(std::size_t bytes);
  void append(std::span<const std::byte> bytes);
  void clear() { size_ = 0; }

 private:
  std::byte* data_ = nullptr;
  std::size_t size_ = 0, capacity_ = 0;
};

}  // namespace polynya::exchange
