#include "core/exchange/growing_bytes.hpp"

#include <sys/mman.h>

#include <algorithm>
#include <new>
#include <utility>

namespace polynya::exchange {
namespace {

constexpr std::size_t granule = 1 << 16;  // bytes; a multiple of any page

/// Pages that are not touched take no room, so doubling costs addresses alone.
std::byte* enlarge(std::byte* data, std::size_t from, std::size_t to) {
  void* pages = data == nullptr ? mmap(nullptr, to, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0)
                                : mremap(data, from, to, MREMAP_MAYMOVE);
  if (pages == MAP_FAILED) throw std::bad_alloc();
  return static_cast<std::byte*>(pages);
}

}  // namespace

GrowingBytes::GrowingBytes(GrowingBytes&& other) noexcept
    : data_(std::exchange(other.data_, nullptr)),
      size_(std::exchange(other.size_, 0)),
      capacity_(std::exchange(other.capacity_, 0)) {}

GrowingBytes& GrowingBytes::operator=(GrowingBytes&& other) noexcept {
  std::swap(data_, other.data_);
  std::swap(size_, other.size_);
  std::swap(capacity_, other.capacity_);
  return *this;
}

GrowingBytes::~GrowingBytes() {
  if (data_ != nullptr) munmap(data_, capacity_);
}

std::byte* GrowingBytes::extend(std::size_t bytes) {
  if (bytes > capacity_ - size_) {
    const std::size_t least = std::max(size_ + bytes, 2 * capacity_);
    const std::size_t capacity = (least + granule - 1) / granule * granule;
    data_ = enlarge(data_, capacity_, capacity);
    capacity_ = capacity;
  }
  std::byte* begin = data_ + size_;
  size_ += bytes;
  return begin;
}

void GrowingBytes::append(std::span<const std::byte> bytes) {
  if (!bytes.empty()) std::copy(bytes.begin(), bytes.end(), extend(bytes.size()));
}

}  // namespace polynya::exchange
