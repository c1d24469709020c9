#include "geometry/hull/surface_reader.hpp"

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>

#include "geometry/error.hpp"

namespace polynya::geometry {
namespace {

static_assert(std::endian::native == std::endian::little, "binary files are read as they lie in memory");

struct Source {
  std::string path, bytes;

  [[noreturn]] void fail(const std::string& what) const { throw GeometryError(path + ": " + what); }
};

/// Words of a text, with the line that each stands in.
class Words {
 public:
  explicit Words(const Source& source) : source_(source) {}

  /// The words of the next line that has some; false at the end.
  bool line(std::vector<std::string>& words) {
    words.clear();
    while (at_ < source_.bytes.size() && words.empty()) {
      const std::size_t end = std::min(source_.bytes.find('\n', at_), source_.bytes.size());
      std::istringstream text(source_.bytes.substr(at_, end - at_));
      for (std::string word; text >> word;) words.push_back(word);
      at_ = end + 1, ++number_;
    }
    return !words.empty();
  }
  double real(const std::string& word) const {
    char* end = nullptr;
    const double value = std::strtod(word.c_str(), &end);
    if (end == word.c_str() || *end != 0) fail("'" + word + "' is no number");
    return value;
  }
  [[noreturn]] void fail(const std::string& what) const {
    source_.fail("line " + std::to_string(number_) + ": " + what);
  }
  std::size_t behind() const { return at_; }

 private:
  const Source& source_;
  std::size_t at_ = 0, number_ = 0;
};

void add_fan(TriangleSoup& soup, const std::vector<std::size_t>& corners) {
  for (std::size_t i = 2; i < corners.size(); ++i) soup.triangles.push_back({corners[0], corners[i - 1], corners[i]});
}

/// Points without numbers, as STL has them: equal coordinates are one point.
class PointList {
 public:
  explicit PointList(TriangleSoup& soup) : soup_(soup) {}
  std::size_t number(Point p) {
    for (double& x : p) x += 0.0;  // minus zero is zero
    const auto [found, fresh] = numbers_.try_emplace(p, soup_.points.size());
    if (fresh) soup_.points.push_back(p);
    return found->second;
  }

 private:
  TriangleSoup& soup_;
  std::map<Point, std::size_t> numbers_;
};

TriangleSoup read_binary_stl(const Source& source, std::uint32_t count) {
  TriangleSoup soup;
  PointList points(soup);
  for (std::uint32_t t = 0; t < count; ++t) {
    float values[12];
    std::memcpy(values, source.bytes.data() + 84 + 50 * std::size_t{t}, sizeof values);
    Triangle triangle;
    for (std::size_t c = 0; c < 3; ++c) {
      const Point p{values[3 + 3 * c], values[4 + 3 * c], values[5 + 3 * c]};
      if (!std::all_of(p.begin(), p.end(), [](double x) { return std::isfinite(x); }))
        source.fail("triangle " + std::to_string(t) + " has a corner that is not finite");
      triangle[c] = points.number(p);
    }
    soup.triangles.push_back(triangle);
  }
  return soup;
}

TriangleSoup read_text_stl(const Source& source) {
  TriangleSoup soup;
  PointList points(soup);
  Words text(source);
  std::vector<std::size_t> corners;
  for (std::vector<std::string> words; text.line(words);) {
    if (words[0] == "vertex") {
      if (words.size() != 4) text.fail("a vertex has three coordinates");
      corners.push_back(points.number({text.real(words[1]), text.real(words[2]), text.real(words[3])}));
    } else if (words[0] == "endloop" || words[0] == "endfacet") {
      if (words[0] == "endloop" && corners.size() != 3) text.fail("a facet has three corners");
      if (corners.size() == 3) soup.triangles.push_back({corners[0], corners[1], corners[2]});
      corners.clear();
    }
  }
  return soup;
}

TriangleSoup read_stl(const Source& source) {
  if (source.bytes.size() >= 84) {
    std::uint32_t count = 0;
    std::memcpy(&count, source.bytes.data() + 80, sizeof count);
    if (source.bytes.size() == 84 + 50 * std::size_t{count}) return read_binary_stl(source, count);
    if (!source.bytes.starts_with("solid"))
      source.fail("binary STL of " + std::to_string(count) + " triangles must have " +
                  std::to_string(84 + 50 * std::size_t{count}) + " bytes, it has " +
                  std::to_string(source.bytes.size()));
  }
  return read_text_stl(source);
}

TriangleSoup read_obj(const Source& source) {
  TriangleSoup soup;
  Words text(source);
  for (std::vector<std::string> words; text.line(words);) {
    if (words[0] == "v") {
      if (words.size() < 4) text.fail("a vertex has three coordinates");
      soup.points.push_back({text.real(words[1]), text.real(words[2]), text.real(words[3])});
    } else if (words[0] == "f") {
      std::vector<std::size_t> corners;
      for (std::size_t i = 1; i < words.size(); ++i) {
        const double number = text.real(words[i].substr(0, words[i].find('/')));
        const double index = number < 0 ? static_cast<double>(soup.points.size()) + number : number - 1;
        if (index < 0 || index != std::floor(index)) text.fail("'" + words[i] + "' names no vertex");
        corners.push_back(static_cast<std::size_t>(index));
      }
      if (corners.size() < 3) text.fail("a face has at least three corners");
      add_fan(soup, corners);
    }
  }
  return soup;
}

struct PlyProperty {
  std::string name, type, count_type;  ///< count_type: of a list
};
struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;
};

/// Numbers of a PLY body, text or binary.
class PlyBody {
 public:
  PlyBody(const Source& source, std::size_t at, bool text, bool swapped)
      : source_(source), at_(at), text_(text), swapped_(swapped) {}

  double number(const std::string& type) {
    if (text_) return word();
    if (type == "float" || type == "float32") return take<float>();
    if (type == "double" || type == "float64") return take<double>();
    if (type == "char" || type == "int8") return take<std::int8_t>();
    if (type == "uchar" || type == "uint8") return take<std::uint8_t>();
    if (type == "short" || type == "int16") return take<std::int16_t>();
    if (type == "ushort" || type == "uint16") return take<std::uint16_t>();
    if (type == "int" || type == "int32") return take<std::int32_t>();
    if (type == "uint" || type == "uint32") return take<std::uint32_t>();
    source_.fail("unknown type '" + type + "' in the header");
  }

 private:
  double word() {
    const char* begin = source_.bytes.c_str() + at_;
    char* end = nullptr;
    const double value = std::strtod(begin, &end);
    if (end == begin) source_.fail("byte " + std::to_string(at_) + ": a number is missing");
    at_ += static_cast<std::size_t>(end - begin);
    return value;
  }
  template <class T>
  double take() {
    if (at_ + sizeof(T) > source_.bytes.size()) source_.fail("ends before its last element");
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), source_.bytes.data() + at_, sizeof(T));
    if (swapped_) std::reverse(bytes.begin(), bytes.end());
    at_ += sizeof(T);
    return static_cast<double>(std::bit_cast<T>(bytes));
  }

  const Source& source_;
  std::size_t at_;
  bool text_, swapped_;
};

void read_ply_element(const Source& source, PlyBody& body, const PlyElement& element, TriangleSoup& soup) {
  Point point{};
  std::vector<std::size_t> corners;
  for (const PlyProperty& property : element.properties) {
    const bool list = !property.count_type.empty();
    const auto count = list ? static_cast<std::size_t>(body.number(property.count_type)) : std::size_t{1};
    for (std::size_t i = 0; i < count; ++i) {
      const double value = body.number(property.type);
      if (element.name == "face" && list && property.name.starts_with("vertex_ind"))
        corners.push_back(static_cast<std::size_t>(value));
      if (element.name == "vertex" && !list && property.name.size() == 1 && property.name[0] >= 'x' &&
          property.name[0] <= 'z')
        point[static_cast<std::size_t>(property.name[0] - 'x')] = value;
    }
  }
  if (element.name == "vertex") soup.points.push_back(point);
  if (element.name != "face") return;
  if (corners.size() < 3) source.fail("a face has at least three corners");
  add_fan(soup, corners);
}

TriangleSoup read_ply(const Source& source) {
  Words text(source);
  std::vector<std::string> words;
  if (!text.line(words) || words[0] != "ply") source.fail("does not begin with 'ply'");
  std::string format;
  std::vector<PlyElement> elements;
  while (text.line(words) && words[0] != "end_header") {
    if (words[0] == "format" && words.size() > 1) format = words[1];
    if (words[0] == "element" && words.size() == 3)
      elements.push_back({words[1], static_cast<std::size_t>(text.real(words[2])), {}});
    if (words[0] == "property" && elements.empty()) text.fail("a property without an element");
    if (words[0] == "property" && words.size() == 3) elements.back().properties.push_back({words[2], words[1], ""});
    if (words[0] == "property" && words.size() == 5)
      elements.back().properties.push_back({words[4], words[3], words[2]});
  }
  if (format != "ascii" && format != "binary_little_endian" && format != "binary_big_endian")
    source.fail("format '" + format + "' is not ascii, binary_little_endian or binary_big_endian");
  PlyBody body(source, text.behind(), format == "ascii", format == "binary_big_endian");
  TriangleSoup soup;
  for (const PlyElement& element : elements)
    for (std::size_t i = 0; i < element.count; ++i) read_ply_element(source, body, element, soup);
  return soup;
}

void check(const Source& source, const TriangleSoup& soup) {
  if (soup.triangles.empty()) source.fail("holds no triangle");
  for (std::size_t v = 0; v < soup.points.size(); ++v)
    for (const double x : soup.points[v])
      if (!std::isfinite(x)) source.fail("vertex " + std::to_string(v) + " is not finite");
  for (std::size_t t = 0; t < soup.triangles.size(); ++t)
    for (const std::size_t v : soup.triangles[t])
      if (v >= soup.points.size())
        source.fail("triangle " + std::to_string(t) + " names vertex " + std::to_string(v) + ", there are " +
                    std::to_string(soup.points.size()));
}

}  // namespace

TriangleSoup read_surface(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw GeometryError(path + ": cannot be read");
  const Source source{path, {std::istreambuf_iterator<char>(file), {}}};
  std::string ending = path.substr(std::min(path.rfind('.'), path.size()));
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  TriangleSoup soup;
  if (ending == ".stl")
    soup = read_stl(source);
  else if (ending == ".obj")
    soup = read_obj(source);
  else if (ending == ".ply")
    soup = read_ply(source);
  else
    source.fail("its name must end with .stl, .obj or .ply");
  check(source, soup);
  return soup;
}

}  // namespace polynya::geometry
