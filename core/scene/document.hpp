#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace polynya::scene {

/// A value as written, and where: "cases/x/scene.toml:12" or "--set vehicle.speed=60".
struct Entry {
  std::variant<bool, long, double, std::string> value;
  std::string where;
};

/// A TOML file flattened to dotted paths ("vehicle.speed"). Tables are kept too: an empty [water] means something.
struct Document {
  std::filesystem::path file;
  std::map<std::string, Entry> values;
  std::map<std::string, std::string> tables;  ///< path -> where
};

/// Reads a TOML file. Throws SceneError (one line with file and line) for a missing file, broken TOML or a list.
Document read_document(const std::filesystem::path& file);

/// Reads "key=value" of the command line; a value that is no TOML is taken as text. Throws SceneError.
Document read_setting(std::string_view setting);

/// Puts every value and table of `over` into `base`, replacing what is there.
void merge(Document& base, const Document& over);

/// Cuts the part below `prefix` out of the document and returns it with the prefix removed.
Document take_below(Document& document, const std::string& prefix);

/// The candidate that takes the fewest edits to reach, empty if none is near.
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace polynya::scene
