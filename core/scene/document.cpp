#include "core/scene/document.hpp"

#include <algorithm>
#include <fstream>
#include <numeric>
#include <sstream>
#include <toml.hpp>
#include <utility>

#include "core/scene/scene_error.hpp"

namespace polynya::scene {
namespace {

/// toml11 draws its messages over several lines; the notes under the source text say what is wrong.
std::string one_line(const std::string& drawn) {
  std::string notes;
  for (const std::string_view mark : {"^--- ", "~~ "})
    for (auto at = drawn.find(mark); at != std::string::npos; at = drawn.find(mark, at + 1)) {
      const auto start = at + mark.size(), end = std::min(drawn.find('\n', start), drawn.size());
      notes += (notes.empty() ? "" : ", ") + drawn.substr(start, end - start);
    }
  if (!notes.empty()) return notes;
  std::string text = drawn;
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

void flatten(const toml::value& value, const std::string& path, const std::string& fixed_where, Document& document) {
  const std::string where =
      !fixed_where.empty() ? fixed_where : document.file.string() + ":" + std::to_string(value.location().line());
  if (value.is_table()) {
    if (!path.empty()) document.tables[path] = where;
    for (const auto& [key, member] : value.as_table())
      flatten(member, path.empty() ? key : path + "." + key, fixed_where, document);
  } else if (value.is_boolean()) {
    document.values[path] = {value.as_boolean(), where};
  } else if (value.is_integer()) {
    document.values[path] = {static_cast<long>(value.as_integer()), where};
  } else if (value.is_floating()) {
    document.values[path] = {value.as_floating(), where};
  } else if (value.is_string()) {
    document.values[path] = {value.as_string().str, where};
  } else {
    throw SceneError(where + ": " + path + ": lists and dates have no meaning here; give a number, a text or a table");
  }
}

bool below(const std::string& path, const std::string& prefix) {
  return path.size() > prefix.size() && path.starts_with(prefix) && path[prefix.size()] == '.';
}

std::string in_quotes(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + '"';
}

std::size_t edits(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] != b[j - 1]);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
    }
  }
  return row.back();
}

}  // namespace

Document read_document(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream || !std::filesystem::is_regular_file(file))
    throw SceneError(file.string() + ": no such file; give a folder with a scene.toml, or a TOML file");
  Document document{.file = file, .values = {}, .tables = {}};
  try {
    flatten(toml::parse(stream, file.string()), "", "", document);
  } catch (const toml::exception& error) {
    throw SceneError(file.string() + ":" + std::to_string(error.location().line()) +
                     ": not valid TOML: " + one_line(error.what()));
  }
  return document;
}

Document read_setting(std::string_view setting) {
  const std::string where = "--set " + std::string(setting);
  const auto equals = setting.find('=');
  if (equals == 0 || equals == std::string_view::npos)
    throw SceneError(where + ": must be key=value, for example --set vehicle.speed=60");
  const std::string key(setting.substr(0, equals)), value(setting.substr(equals + 1));
  for (const std::string& text : {key + " = " + value, key + " = " + in_quotes(value)}) {
    std::istringstream stream(text);
    Document document;
    try {
      flatten(toml::parse(stream, where), "", where, document);
      return document;
    } catch (const toml::exception&) {
      continue;
    }
  }
  throw SceneError(where + ": " + key +
                   " is no dotted key; quote a part that holds a dot, e.g. materials.\"ice.paper\".density");
}

void merge(Document& base, const Document& over) {
  for (const auto& [path, entry] : over.values) base.values[path] = entry;
  for (const auto& [path, where] : over.tables) base.tables.try_emplace(path, where);
}

Document take_below(Document& document, const std::string& prefix) {
  Document part{.file = document.file, .values = {}, .tables = {}};
  for (const auto& [path, entry] : document.values)
    if (below(path, prefix)) part.values[path.substr(prefix.size() + 1)] = entry;
  for (const auto& [path, where] : document.tables)
    if (below(path, prefix)) part.tables[path.substr(prefix.size() + 1)] = where;
  std::erase_if(document.values, [&](const auto& item) { return below(item.first, prefix); });
  std::erase_if(document.tables, [&](const auto& item) { return below(item.first, prefix) || item.first == prefix; });
  return part;
}

std::string nearest(std::string_view word, const std::vector<std::string>& candidates) {
  std::string best;
  std::size_t fewest = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (const std::string& candidate : candidates) {
    const std::size_t count = edits(word, candidate);
    const bool longer = count == fewest && candidate.starts_with(word);  // a word cut short is the likelier slip
    if (count < fewest || longer) fewest = count, best = candidate;
  }
  return best;
}

}  // namespace polynya::scene
