#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/scene/document.hpp"

namespace polynya::scene {

/// Typed access to a document by the schema: defaults, dimensions, bounds and choices are checked here, and every
/// error names the place. Keys asked for must be in the schema (std::logic_error otherwise).
class Values {
 public:
  /// Checks that every key and table of the document is known. Throws SceneError with the nearest valid spelling.
  explicit Values(const Document& document);

  /// The value given, or nothing if the key is absent or "auto". Bare numbers are SI.
  std::optional<double> given(const std::string& path) const;
  /// The value given or the schema's default; `computed` where that is "auto".
  double number(const std::string& path, double computed) const;
  double number(const std::string& path) const;
  /// A text or choice, or the schema's default.
  std::string text(const std::string& path) const;
  /// True if the file has the table.
  bool has(const std::string& table) const { return document_.tables.contains(table); }
  /// True if the file has the key.
  bool is_given(const std::string& path) const { return document_.values.contains(path); }
  /// Names of the tables directly below one that holds tables of the user's names.
  std::vector<std::string> tables_below(const std::string& table) const;
  /// Names of the keys directly below a table whose keys are the user's names, ascending.
  std::vector<std::string> keys_below(const std::string& table) const;
  /// Where relative paths of the scene start.
  std::filesystem::path folder() const { return document_.file.parent_path(); }
  /// Throws SceneError: place, key and value, then `what`.
  [[noreturn]] void fail(const std::string& path, const std::string& what) const;

 private:
  const Document& document_;
};

/// Throws SceneError unless every key and table is one of the schema's or below materials.
void check_keys(const Document& document);

}  // namespace polynya::scene
