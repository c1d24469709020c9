#pragma once
#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace polynya::coupler {

/// Finds vertices of a surface by their ids. Fast for ids that are asked for in nearly the order in which they ascend,
/// as those of the same surface a window earlier are.
class VertexIndex {
 public:
  explicit VertexIndex(std::span<const std::int64_t> ids) {
    entries_.reserve(ids.size());
    for (std::size_t v = 0; v < ids.size(); ++v) entries_.emplace_back(ids[v], static_cast<std::ptrdiff_t>(v));
    if (!std::is_sorted(entries_.begin(), entries_.end())) std::sort(entries_.begin(), entries_.end());
  }

  /// Number of the vertex, -1 if there is none of this id.
  std::ptrdiff_t find(std::int64_t id) {
    if (next_ == entries_.size() || entries_[next_].first != id)
      next_ = static_cast<std::size_t>(
          std::lower_bound(entries_.begin(), entries_.end(), std::pair(id, std::ptrdiff_t{0})) - entries_.begin());
    if (next_ == entries_.size() || entries_[next_].first != id) return -1;
    return entries_[next_++].second;
  }

 private:
  std::vector<std::pair<std::int64_t, std::ptrdiff_t>> entries_;  ///< id and number, by id
  std::size_t next_ = 0;                                          ///< behind what was found last
};

}  // namespace polynya::coupler
