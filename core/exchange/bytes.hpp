#pragma once
#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace polynya::exchange {

/// Bytes that nobody changes any more. Copies share them: a message on its way, its receiver and the record read the
/// same memory, which lasts as long as the last of them.
class Bytes {
 public:
  Bytes() = default;
  /// Those of an array, which moves here.
  template <class T>
  explicit Bytes(std::vector<T>&& values) {
    const auto kept = std::make_shared<const std::vector<T>>(std::move(values));
    view_ = std::as_bytes(std::span<const T>(*kept));
    owner_ = kept;
  }
  explicit Bytes(std::span<const std::byte> values) : Bytes(std::vector<std::byte>(values.begin(), values.end())) {}
  /// Memory that `owner` keeps.
  Bytes(std::span<const std::byte> view, std::shared_ptr<const void> owner) : view_(view), owner_(std::move(owner)) {}

  const std::byte* data() const { return view_.data(); }
  std::size_t size() const { return view_.size(); }
  bool empty() const { return view_.empty(); }
  auto begin() const { return view_.begin(); }
  auto end() const { return view_.end(); }
  friend bool operator==(const Bytes& a, const Bytes& b) { return std::ranges::equal(a.view_, b.view_); }

 private:
  std::span<const std::byte> view_;
  std::shared_ptr<const void> owner_;
};

}  // namespace polynya::exchange
