#include "core/scene/values.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>

#include "core/scene/scene_error.hpp"
#include "core/scene/schema.hpp"

namespace polynya::scene {
namespace {

std::string as_written(const Entry& entry) {
  std::ostringstream stream;
  std::visit(
      [&](const auto& value) {
        using T = std::decay_t<decltype(value)>;
        if constexpr (std::is_same_v<T, bool>)
          stream << (value ? "true" : "false");
        else if constexpr (std::is_same_v<T, std::string>)
          stream << '"' << value << '"';
        else
          stream << value;
      },
      entry.value);
  return stream.str();
}

const KeyRule& rule_of(const std::string& path) {
  const KeyRule* rule = find_rule(path);
  if (!rule) throw std::logic_error("scene key " + path + " is not in the schema");
  return *rule;
}

bool is_table(const std::string& path) {
  const std::string general = general_path(path) + ".";
  for (const KeyRule& rule : schema())
    if (rule.path.starts_with(general)) return true;
  return path == "materials" || path.starts_with("materials.");
}

std::vector<std::string> known_paths() {
  std::vector<std::string> paths;
  for (const KeyRule& rule : schema()) paths.push_back(rule.path);
  return paths;
}

std::vector<std::string> known_tables() {
  std::vector<std::string> tables{"level.quick", "level.standard", "level.fine", "materials"};
  for (const KeyRule& rule : schema())
    for (auto dot = rule.path.find('.'); dot != std::string::npos; dot = rule.path.find('.', dot + 1))
      if (tables.back() != rule.path.substr(0, dot)) tables.push_back(rule.path.substr(0, dot));
  return tables;
}

/// Keys directly in the table that `path` lies in, for a message; empty if that table is unknown.
std::string siblings(const std::string& path) {
  const auto dot = path.rfind('.');
  const std::string prefix = dot == std::string::npos ? "" : path.substr(0, dot + 1);
  std::string list;
  for (const KeyRule& rule : schema())
    if (rule.path.starts_with(prefix) && rule.path.find('.', prefix.size()) == std::string::npos)
      list += (list.empty() ? "" : ", ") + rule.path.substr(prefix.size());
  return list;
}

std::string last_part(const std::string& path) {
  return path.substr(path.rfind('.') + 1);
}

/// Tables directly in the table that `path` lies in, if it lies in one.
std::string sibling_tables(const std::string& path) {
  const auto dot = path.rfind('.');
  if (dot == std::string::npos) return {};
  const std::string prefix = path.substr(0, dot + 1);
  std::string list, last;
  for (const KeyRule& rule : schema()) {
    const auto end = rule.path.find('.', prefix.size());
    if (!rule.path.starts_with(prefix) || end == std::string::npos) continue;
    const std::string table = rule.path.substr(0, end);
    if (table != last) list += (list.empty() ? "" : ", ") + table;
    last = table;
  }
  return list;
}

/// A key elsewhere whose last part holds that of `path`: "speed" -> "vehicle.speed".
std::string elsewhere(const std::string& path) {
  if (last_part(path).size() < 4) return {};
  for (const KeyRule& rule : schema())
    if (last_part(rule.path).find(last_part(path)) != std::string::npos) return rule.path;
  return {};
}

[[noreturn]] void fail_unknown(const std::string& where, const std::string& given, const std::string& kind,
                               const std::vector<std::string>& candidates) {
  std::string message = where + ": unknown " + kind + " '" + given + "'";
  const std::string path = general_path(given);
  if (const auto tables = sibling_tables(path); kind == "table" && !tables.empty())
    throw SceneError(message + "; allowed here: " + tables);
  auto near = nearest(path, candidates);
  if (near.empty()) near = elsewhere(path);
  if (!near.empty())
    message += "; did you mean '" + near + "'?";
  else if (const auto list = siblings(path); !list.empty())
    message += "; allowed here: " + list;
  throw SceneError(message);
}

}  // namespace

void check_keys(const Document& document) {
  for (const auto& [path, where] : document.tables) {
    if (is_table(path)) continue;
    if (find_rule(path))
      throw SceneError(where + ": " + path + ": is a table here, but must be " + allowed(rule_of(path)));
    fail_unknown(where, path, "table", known_tables());
  }
  for (const auto& [path, entry] : document.values) {
    if (find_rule(path) || path.starts_with("materials.")) continue;
    if (is_table(path)) throw SceneError(entry.where + ": " + path + ": must be a table, [" + path + "]");
    fail_unknown(entry.where, path, "key", known_paths());
  }
}

Values::Values(const Document& document) : document_(document) {
  check_keys(document);
}

void Values::fail(const std::string& path, const std::string& what) const {
  if (const auto entry = document_.values.find(path); entry != document_.values.end())
    throw SceneError(entry->second.where + ": " + path + " = " + as_written(entry->second) + ": " + what);
  const auto table = document_.tables.find(path.substr(0, std::max<std::size_t>(path.rfind('.'), 1)));
  const auto where = table != document_.tables.end() ? table->second : document_.file.string();
  throw SceneError(where + ": " + path + ": " + what);
}

std::vector<std::string> Values::tables_below(const std::string& table) const {
  std::vector<std::string> names;
  for (const auto& [path, where] : document_.tables)
    if (path.starts_with(table + ".") && path.find('.', table.size() + 1) == std::string::npos)
      names.push_back(path.substr(table.size() + 1));
  return names;
}

std::vector<std::string> Values::keys_below(const std::string& table) const {
  std::vector<std::string> names;
  for (const auto& [path, entry] : document_.values)
    if (path.starts_with(table + ".")) names.push_back(path.substr(table.size() + 1));
  return names;
}

std::optional<double> Values::given(const std::string& path) const {
  const KeyRule& rule = rule_of(path);
  const auto found = document_.values.find(path);
  if (found == document_.values.end()) {
    if (rule.fallback == "required") fail(path, "missing; must be " + allowed(rule));
    return std::nullopt;
  }
  Quantity quantity{.value = 0, .dimension = rule.dimension, .bare = true};
  const auto& value = found->second.value;
  if (const auto* text = std::get_if<std::string>(&value)) {
    if (*text == "auto" && rule.fallback == "auto") return std::nullopt;
    try {
      quantity = parse_quantity(*text);
    } catch (const std::invalid_argument& error) {
      fail(path, std::string(error.what()) + "; must be " + allowed(rule));
    }
  } else if (const auto* number = std::get_if<double>(&value)) {
    quantity.value = *number;
  } else if (const auto* whole = std::get_if<long>(&value)) {
    quantity.value = static_cast<double>(*whole);
  } else {
    fail(path, "must be " + allowed(rule));
  }
  if (!quantity.bare && quantity.dimension != rule.dimension)
    fail(path, "wrong dimension, found " +
                   (quantity.dimension == Dimension{} ? "a plain number" : unit_name(quantity.dimension)) +
                   "; must be " + allowed(rule));
  const bool too_small = quantity.value < rule.lower || (rule.lower_open && quantity.value == rule.lower);
  const bool broken = rule.kind == Kind::integer && quantity.value != std::floor(quantity.value);
  if (!std::isfinite(quantity.value) || too_small || quantity.value > rule.upper || broken)
    fail(path, "must be " + allowed(rule));
  return quantity.value;
}

double Values::number(const std::string& path, double computed) const {
  return given(path).value_or(computed);
}

double Values::number(const std::string& path) const {
  if (const auto value = given(path)) return *value;
  return parse_quantity(rule_of(path).fallback).value;
}

std::string Values::text(const std::string& path) const {
  const KeyRule& rule = rule_of(path);
  const auto found = document_.values.find(path);
  if (found == document_.values.end()) {
    if (rule.fallback == "required") fail(path, "missing; must be " + allowed(rule));
    return rule.fallback;
  }
  // true and false may be choices, and are written without quotes then.
  if (const auto* flag = std::get_if<bool>(&found->second.value); flag && rule.kind == Kind::choice) {
    const std::string word = *flag ? "true" : "false";
    for (const auto& choice : rule.choices)
      if (choice == word) return word;
  }
  const auto* text = std::get_if<std::string>(&found->second.value);
  if (!text) fail(path, "must be " + allowed(rule));
  if (rule.kind != Kind::choice) return *text;
  for (const auto& choice : rule.choices)
    if (choice == *text) return *text;
  const auto near = nearest(*text, rule.choices);
  fail(path, "must be " + allowed(rule) + (near.empty() ? "" : "; did you mean " + near + "?"));
}

}  // namespace polynya::scene
