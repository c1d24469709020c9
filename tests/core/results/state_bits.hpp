#pragma once
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include "core/compute/state_archive.hpp"
#include "core/results/checkpoint_file.hpp"
#include "tests/core/results/temporary_folder.hpp"

namespace polynya::testing {

/// Every value that a state lists, as bytes. Types that are mere bytes may hold padding, which is nobody's: they are
/// left out here, what they say shows in the numbers after further steps.
class StateBits final : public compute::StateArchive {
 public:
  template <class T>
  explicit StateBits(T& state) : StateArchive(false) {
    item("state", state);
  }
  const std::map<std::string, std::vector<unsigned char>>& values() const { return values_; }

  /// Name of the first value that differs; empty if all are equal bit for bit.
  std::string difference(const StateBits& other) const {
    if (values_.size() != other.values_.size()) return "the number of values";
    for (const auto& [name, bytes] : values_) {
      const auto found = other.values_.find(name);
      if (found == other.values_.end() || found->second != bytes) return name;
    }
    return {};
  }

 private:
  std::size_t stored(const std::string&, Entry) override { return 0; }
  void transfer(const std::string& name, Entry entry, void* data, std::size_t count) override {
    if (entry.kind == Kind::bytes) return;
    std::vector<unsigned char>& bytes = values_[name];
    bytes.resize(count * entry.size);
    if (!bytes.empty()) std::memcpy(bytes.data(), data, bytes.size());
  }

  std::map<std::string, std::vector<unsigned char>> values_;
};

template <class T>
std::string state_difference(T& one, T& other) {
  return StateBits(one).difference(StateBits(other));
}

/// Through a file: what `from` lists goes to `to`, which was made afresh.
template <class T>
void carry_over(T& from, T& to) {
  const TemporaryFolder folder;
  const std::string path = folder / "checkpoints/000000001/test.h5";
  results::save_checkpoint(path, {"test", "{}", 0, 1}, from);
  results::CheckpointReader(path, "test", "{}").load(to);
}

}  // namespace polynya::testing
