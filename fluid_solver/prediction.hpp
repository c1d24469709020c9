#pragma once

/// How far into a step the pressure that acts in it is predicted: theta, 0 its beginning, 1 its end.
namespace polynya::fluid {

inline constexpr double whole_cell_prediction = 0.85;  ///< of strain that is not smooth; half of what is
inline constexpr double group_prediction = 0.6;
inline constexpr double quadratic_viscosity = 1.5;  ///< of the reference, over density times (length x strain)^2

}  // namespace polynya::fluid
