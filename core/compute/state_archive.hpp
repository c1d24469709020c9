#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

/// What a program has to remember to go on later with the same bits. A type says it once, for saving and for loading:
///     struct Groups { ... POLYNYA_STATE(members, first, sealed) };
/// names all members in their order; one that is missing does not compile. Members that are made anew from the scene,
/// or that every step writes before it reads them, are named once more in front:
///     POLYNYA_STATE_WITHOUT((grid, watch), grid, watch, time, velocity)
/// Types that are mere bytes (no pointers in them) need no list.
/// A type that has more to do than that writes its list_state() itself and calls list_members(), which
/// POLYNYA_STATE_MEMBERS_WITHOUT makes of the same lists.
#define POLYNYA_STATE(...)                                   \
  void list_state(polynya::compute::StateArchive& archive) { \
    auto& [__VA_ARGS__] = *this;                             \
    archive.members("", #__VA_ARGS__, __VA_ARGS__);          \
  }
#define POLYNYA_STATE_WITHOUT(without, ...)                  \
  void list_state(polynya::compute::StateArchive& archive) { \
    auto& [__VA_ARGS__] = *this;                             \
    archive.members(#without, #__VA_ARGS__, __VA_ARGS__);    \
  }
#define POLYNYA_STATE_MEMBERS_WITHOUT(without, ...)            \
  void list_members(polynya::compute::StateArchive& archive) { \
    auto& [__VA_ARGS__] = *this;                               \
    archive.members(#without, #__VA_ARGS__, __VA_ARGS__);      \
  }

namespace polynya::compute {

/// What is stored does not fit what is to be loaded. One sentence, without the place it is stored in.
struct StateError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class StateArchive;
template <class T>
concept ListsState = requires(T& value, StateArchive& archive) {
  value.list_state(archive);
};

/// Takes named values one after the other, out of a state or into it. Derived classes know the store.
class StateArchive {
 public:
  enum class Kind { real, integer, bytes };
  /// How the entries of an array are stored; size in bytes.
  struct Entry {
    Kind kind = Kind::bytes;
    std::size_t size = 0;
    bool operator==(const Entry&) const = default;
  };

  virtual ~StateArchive() = default;
  bool loading() const { return loading_; }

  /// Saves or loads one value. Throws StateError if nothing of this name, type and length is stored: an array that is
  /// not empty when it is loaded must have the length it has.
  template <class T>
  void item(const std::string& name, T& value);
  /// An array of fixed length.
  template <class T>
  void values(const std::string& name, T* first, std::size_t count);
  /// Members by their names ("a, b, c"), less those in `without` ("(b)"). See POLYNYA_STATE.
  template <class... Members>
  void members(std::string_view without, std::string_view names, Members&... all);

 protected:
  explicit StateArchive(bool loading) : loading_(loading) {}
  /// Loading: how many entries are stored. Throws StateError.
  virtual std::size_t stored(const std::string& name, Entry entry) = 0;
  virtual void transfer(const std::string& name, Entry entry, void* data, std::size_t count) = 0;

 private:
  template <class T>
  static constexpr Entry entry_of() {
    if constexpr (std::is_floating_point_v<T>) return {Kind::real, sizeof(T)};
    if constexpr (std::is_integral_v<T> || std::is_enum_v<T>) return {Kind::integer, sizeof(T)};
    return {Kind::bytes, sizeof(T)};
  }
  template <class T>
  void list(const std::string& name, std::vector<T>& value);
  template <class T>
  void list(const std::string& name, std::vector<std::vector<T>>& value);
  template <class T>
  void list(const std::string& name, std::optional<T>& value);
  template <class T, std::size_t n>
  void list(const std::string& name, std::array<T, n>& value);
  void list(const std::string& name, std::string& value);
  /// Makes room for the rows that are stored.
  template <class T>
  void fit(const std::string& name, std::vector<T>& value);

  static std::vector<std::string> split(std::string_view names);

  bool loading_;
  std::string prefix_;
};

namespace state_detail {
template <class T>
inline constexpr bool is_container = false;
template <class T>
inline constexpr bool is_container<std::vector<T>> = true;
template <class T>
inline constexpr bool is_container<std::optional<T>> = true;
template <class T, std::size_t n>
inline constexpr bool is_container<std::array<T, n>> = true;
template <>
inline constexpr bool is_container<std::string> = true;

/// What an entry of an array consists of: `count` values of one type that is mere bytes, side by side.
template <class T>
struct Row {
  using Value = T;
  static constexpr std::size_t count = 1;
  static constexpr bool plain = std::is_trivially_copyable_v<T> && !ListsState<T> && !is_container<T>;
};
template <class T, std::size_t n>
struct Row<std::array<T, n>> {
  using Value = typename Row<T>::Value;
  static constexpr std::size_t count = n * Row<T>::count;
  static constexpr bool plain = n > 0 && Row<T>::plain;
};
}  // namespace state_detail

template <class T>
void StateArchive::item(const std::string& name, T& value) {
  if constexpr (ListsState<T>) {
    const std::string outer = prefix_;
    prefix_ += name + ".";
    value.list_state(*this);
    prefix_ = outer;
  } else if constexpr (std::is_trivially_copyable_v<T> && !std::is_pointer_v<T> && !std::is_const_v<T> &&
                       !state_detail::is_container<T>) {
    values(name, &value, 1);
  } else if constexpr (state_detail::is_container<T>) {
    list(name, value);
  } else {
    throw std::logic_error("state: the type of '" + prefix_ + name + "' lists no members; leave it out or add a list");
  }
}

template <class T>
void StateArchive::values(const std::string& name, T* first, std::size_t count) {
  static_assert(std::is_trivially_copyable_v<T>);
  const std::string full = prefix_ + name;
  if (loading_)
    if (const std::size_t there = stored(full, entry_of<T>()); there != count)
      throw StateError("'" + full + "' holds " + std::to_string(there) + " values, " + std::to_string(count) +
                       " are needed");
  transfer(full, entry_of<T>(), first, count);
}

template <class T>
void StateArchive::fit(const std::string& name, std::vector<T>& value) {
  using Row = state_detail::Row<T>;
  if (!loading_) return;
  const std::size_t there = stored(prefix_ + name, entry_of<typename Row::Value>());
  const std::string found = "'" + prefix_ + name + "' holds " + std::to_string(there) + " values, ";
  if (there % Row::count != 0) throw StateError(found + "which are no whole rows of " + std::to_string(Row::count));
  if (const std::size_t needed = Row::count * value.size(); needed != 0 && needed != there)
    throw StateError(found + std::to_string(needed) + " are needed");
  value.resize(there / Row::count);
}

template <class T>
void StateArchive::list(const std::string& name, std::vector<T>& value) {
  using Row = state_detail::Row<T>;
  if constexpr (Row::plain) {
    fit(name, value);
    values(name, reinterpret_cast<typename Row::Value*>(value.data()), Row::count * value.size());
  } else {
    std::uint64_t count = value.size();
    item(name + ".count", count);
    if (loading_) {
      if (!value.empty() && value.size() != count)
        throw StateError("'" + prefix_ + name + "' holds " + std::to_string(count) + " parts, " +
                         std::to_string(value.size()) + " are needed");
      value.resize(count);
    }
    for (std::size_t i = 0; i < value.size(); ++i) item(name + "[" + std::to_string(i) + "]", value[i]);
  }
}

template <class T>
void StateArchive::list(const std::string& name, std::vector<std::vector<T>>& value) {
  std::vector<std::uint64_t> lengths;
  std::vector<T> joined;
  for (const std::vector<T>& part : value) {
    lengths.push_back(part.size());
    joined.insert(joined.end(), part.begin(), part.end());
  }
  if (loading_) lengths.clear(), joined.clear();
  item(name + ".lengths", lengths);
  item(name, joined);
  if (!loading_) return;
  value.resize(lengths.size());
  auto from = joined.begin();
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    if (lengths[i] > static_cast<std::uint64_t>(joined.end() - from))
      throw StateError("'" + prefix_ + name + "' is shorter than its parts");
    value[i].assign(from, from + static_cast<std::ptrdiff_t>(lengths[i]));
    from += static_cast<std::ptrdiff_t>(lengths[i]);
  }
}

template <class T>
void StateArchive::list(const std::string& name, std::optional<T>& value) {
  std::uint8_t there = value.has_value() ? 1 : 0;
  item(name + ".there", there);
  if (loading_) {
    if (there == 0) value.reset();
    if (there != 0 && !value) {
      if constexpr (std::is_default_constructible_v<T>)
        value.emplace();
      else
        throw StateError("'" + prefix_ + name + "' is stored, but this run has none");
    }
  }
  if (value) item(name, *value);
}

template <class T, std::size_t n>
void StateArchive::list(const std::string& name, std::array<T, n>& value) {
  using Row = state_detail::Row<std::array<T, n>>;
  if constexpr (Row::plain)
    values(name, reinterpret_cast<typename Row::Value*>(value.data()), Row::count);
  else
    for (std::size_t i = 0; i < n; ++i) item(name + "[" + std::to_string(i) + "]", value[i]);
}

inline void StateArchive::list(const std::string& name, std::string& value) {
  std::vector<char> letters;
  if (!loading_) letters.assign(value.begin(), value.end());
  item(name, letters);
  value.assign(letters.begin(), letters.end());
}

inline std::vector<std::string> StateArchive::split(std::string_view names) {
  std::vector<std::string> words(1);
  for (const char letter : names) {
    if (letter == ',')
      words.emplace_back();
    else if (letter != ' ' && letter != '(' && letter != ')')
      words.back() += letter;
  }
  return words;
}

template <class... Members>
void StateArchive::members(std::string_view without, std::string_view names, Members&... all) {
  const std::vector<std::string> left_out = split(without), in_order = split(names);
  for (const std::string& name : left_out)
    if (!name.empty() && std::find(in_order.begin(), in_order.end(), name) == in_order.end())
      throw std::logic_error("state: '" + name + "' is left out, but is no member");
  std::size_t next = 0;
  const auto take = [&](auto& member) {
    const std::string& name = in_order[next++];
    if (std::find(left_out.begin(), left_out.end(), name) == left_out.end()) item(name, member);
  };
  (take(all), ...);
}

}  // namespace polynya::compute
