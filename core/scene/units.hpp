#pragma once
#include <string>
#include <string_view>

namespace polynya::scene {

/// Exponents of metre, kilogram, second and kelvin.
struct Dimension {
  int length = 0, mass = 0, time = 0, temperature = 0;
  bool operator==(const Dimension&) const = default;
};

namespace dimension {
inline constexpr Dimension none{}, length{1, 0, 0, 0}, mass{0, 1, 0, 0}, time{0, 0, 1, 0}, speed{1, 0, -1, 0},
    acceleration{1, 0, -2, 0}, frequency{0, 0, -1, 0}, density{-3, 1, 0, 0}, pressure{-1, 1, -2, 0},
    force{1, 1, -2, 0}, energy_per_area{0, 1, -2, 0};
}

struct Quantity {
  double value = 0;  ///< SI
  Dimension dimension;
  bool bare = false;  ///< a number without a unit: SI of whatever is expected
};

/// Reads "10 mm", "40 m/s", "9.81 m/s^2", "1e3 kg m^-3", "0.35", "30 deg", "5 %". Units may carry a metric prefix.
/// Throws std::invalid_argument saying what is wrong with the text.
Quantity parse_quantity(std::string_view text);

/// "a length", "a speed", ... with an example: `a speed such as "40 m/s"`.
std::string describe(const Dimension& dimension);

/// The SI unit: "m", "m/s", "kg/m^3", "1/s", "Pa", ...; empty for a plain number.
std::string unit_name(const Dimension& dimension);

}  // namespace polynya::scene
