#include "core/scene/units.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace polynya::scene {
namespace {

struct Unit {
  std::string_view symbol;
  double factor;
  Dimension dimension;
  bool takes_prefix;
};

constexpr Dimension energy{2, 1, -2, 0}, power{2, 1, -3, 0}, temperature{0, 0, 0, 1};

constexpr std::array units{
    Unit{"m", 1, dimension::length, true},
    Unit{"g", 1e-3, dimension::mass, true},
    Unit{"t", 1e3, dimension::mass, false},
    Unit{"s", 1, dimension::time, true},
    Unit{"min", 60, dimension::time, false},
    Unit{"h", 3600, dimension::time, false},
    Unit{"K", 1, temperature, true},
    Unit{"Hz", 1, dimension::frequency, true},
    Unit{"N", 1, dimension::force, true},
    Unit{"Pa", 1, dimension::pressure, true},
    Unit{"bar", 1e5, dimension::pressure, true},
    Unit{"atm", 101325, dimension::pressure, false},
    Unit{"J", 1, energy, true},
    Unit{"W", 1, power, true},
    Unit{"rad", 1, dimension::none, true},
    Unit{"deg", std::numbers::pi / 180, dimension::none, false},
    Unit{"%", 0.01, dimension::none, false},
    Unit{"1", 1, dimension::none, false},
};

struct Prefix {
  std::string_view symbol;
  double factor;
};
constexpr std::array prefixes{Prefix{"n", 1e-9}, Prefix{"u", 1e-6}, Prefix{"µ", 1e-6}, Prefix{"m", 1e-3},
                              Prefix{"c", 1e-2}, Prefix{"k", 1e3},  Prefix{"M", 1e6},  Prefix{"G", 1e9}};

Unit find_unit(std::string_view symbol) {
  for (const Unit& unit : units)
    if (unit.symbol == symbol) return unit;
  for (const Prefix& prefix : prefixes) {
    if (!symbol.starts_with(prefix.symbol)) continue;
    for (const Unit& unit : units)
      if (unit.takes_prefix && unit.symbol == symbol.substr(prefix.symbol.size()))
        return {symbol, prefix.factor * unit.factor, unit.dimension, false};
  }
  throw std::invalid_argument("unknown unit \"" + std::string(symbol) + "\"");
}

std::string_view without_blanks(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// Cuts the next factor "symbol" or "symbol^exponent" off the front of the text.
std::string_view take_factor(std::string_view& text) {
  const auto end = std::min(text.find_first_of(" \t*/"), text.size());
  const auto factor = text.substr(0, end);
  text.remove_prefix(end);
  return factor;
}

int exponent_of(std::string_view factor) {
  const auto caret = factor.find('^');
  if (caret == std::string_view::npos) return 1;
  const auto digits = factor.substr(caret + 1);
  int exponent = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), exponent);
  if (error != std::errc() || end != digits.data() + digits.size())
    throw std::invalid_argument("\"" + std::string(factor) + "\" has no whole exponent");
  return exponent;
}

/// Multiplies quantity by the unit expression: factors separated by blanks, * or /.
void apply_units(Quantity& quantity, std::string_view text) {
  bool divide = false, first = true;
  while (!(text = without_blanks(text)).empty()) {
    if (text.front() == '*' || text.front() == '/') {
      divide = text.front() == '/';
      if (first && !divide) throw std::invalid_argument("a unit cannot start with *");
      text = without_blanks(text.substr(1));
    }
    const auto factor = take_factor(text);
    if (factor.empty()) throw std::invalid_argument("a unit is missing after * or /");
    const Unit unit = find_unit(factor.substr(0, factor.find('^')));
    const int exponent = divide ? -exponent_of(factor) : exponent_of(factor);
    quantity.value *= std::pow(unit.factor, exponent);
    quantity.dimension.length += exponent * unit.dimension.length;
    quantity.dimension.mass += exponent * unit.dimension.mass;
    quantity.dimension.time += exponent * unit.dimension.time;
    quantity.dimension.temperature += exponent * unit.dimension.temperature;
    divide = first = false;
  }
}

struct Name {
  Dimension dimension;
  const char* text;
};
const std::array names{
    Name{dimension::none, "a plain number such as 0.35"},
    Name{dimension::length, "a length such as \"10 mm\""},
    Name{dimension::mass, "a mass such as \"5 g\""},
    Name{dimension::time, "a time such as \"1.5 ms\""},
    Name{dimension::speed, "a speed such as \"40 m/s\""},
    Name{dimension::acceleration, "an acceleration such as \"9.81 m/s^2\""},
    Name{dimension::frequency, "a frequency or rate such as \"20 kHz\" or \"1 1/s\""},
    Name{dimension::density, "a density such as \"900 kg/m^3\""},
    Name{dimension::pressure, "a pressure or stress such as \"1 MPa\""},
    Name{dimension::energy_per_area, "an energy per area such as \"2 J/m^2\""},
};

}  // namespace

Quantity parse_quantity(std::string_view text) {
  text = without_blanks(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  Quantity quantity;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), quantity.value);
  if (error != std::errc() || !std::isfinite(quantity.value))
    throw std::invalid_argument("\"" + std::string(text) + "\" does not start with a number");
  const auto rest = without_blanks(text.substr(end - text.data()));
  quantity.bare = rest.empty();
  apply_units(quantity, rest);
  return quantity;
}

std::string describe(const Dimension& dimension) {
  for (const Name& name : names)
    if (name.dimension == dimension) return name.text;
  return "a quantity in " + unit_name(dimension);
}

std::string unit_name(const Dimension& dimension) {
  if (dimension == dimension::force) return "N";
  if (dimension == dimension::pressure) return "Pa";
  const std::array<std::pair<int, const char*>, 4> parts{
      {{dimension.mass, "kg"}, {dimension.length, "m"}, {dimension.time, "s"}, {dimension.temperature, "K"}}};
  std::string above, below;
  for (const auto& [exponent, symbol] : parts) {
    if (exponent == 0) continue;
    std::string& text = exponent > 0 ? above : below;
    if (exponent > 0 && !text.empty()) text += ' ';
    if (exponent < 0) text += '/';
    text += symbol;
    if (std::abs(exponent) != 1) text.append("^").append(std::to_string(std::abs(exponent)));
  }
  return above.empty() && !below.empty() ? '1' + below : above + below;
}

}  // namespace polynya::scene
