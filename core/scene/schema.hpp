#pragma once
#include <limits>
#include <string>
#include <vector>

#include "core/scene/units.hpp"

namespace polynya::scene {

enum class Kind { quantity, integer, choice, text };

/// One key of a scene file: what it may hold and what happens when it is absent.
struct KeyRule {
  std::string path;
  Kind kind = Kind::quantity;
  Dimension dimension = dimension::none;
  std::string fallback;  ///< as written in a file; "auto": computed, "required": none
  std::string meaning;
  double lower = -std::numeric_limits<double>::infinity();  ///< smallest allowed (SI)
  double upper = std::numeric_limits<double>::infinity();   ///< largest allowed (SI)
  bool lower_open = false;                                  ///< lower itself is not allowed
  std::vector<std::string> choices;
};

/// Every key of a scene file except [level.*] and [materials.*], in the order of the documentation.
const std::vector<KeyRule>& schema();

/// The path under which the schema has a key or table: the user's names of bodies become NAME.
std::string general_path(const std::string& path);

/// The rule of a key, null if there is none.
const KeyRule* find_rule(const std::string& path);

/// "a speed such as ..., above 0", "one of ...": for messages.
std::string allowed(const KeyRule& rule);

/// The schema as the Markdown table of docs/scene.md.
std::string schema_as_markdown();

}  // namespace polynya::scene
