#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "core/compute/state_archive.hpp"

namespace polynya::fluid {

/// Where solids cut the grid, at one time, as the coupler sends it. Cells sorted by index (i + nx*(j + ny*k)); cells
/// and faces that are absent are free of solid. Bodies: 0 vehicle, 1 ice.
struct Overlap {
  std::vector<std::int64_t> cell;
  std::vector<double> solid_volume;               ///< m^3, at most the cell's volume
  std::vector<double> debris_volume;              ///< m^3 displaced by particles, not part of solid_volume
  std::array<std::vector<std::int64_t>, 3> face;  ///< x-, y-, z-faces
  std::array<std::vector<double>, 3> face_solid;  ///< their solid fraction, 0..1
  std::vector<std::int64_t> walled;               ///< the cells that hold wall, ascending
  std::vector<double> wall_area;                  ///< [m][2][3] area vector of each body, pointing into the body, m^2
  std::vector<double> wall_velocity;              ///< [m][2][3] mean velocity of that piece of wall, m/s
  std::vector<double> wall_size;  ///< [m] m^2 of wall whichever way it faces; empty: the lengths of wall_area
  /// [m][2] volume that the wall gives way per time, m^3/s: the integral of velocity over area, which the product of
  /// the two misses where parts of the wall move apart. Empty: the product.
  std::vector<double> wall_sweep;

  POLYNYA_STATE(cell, solid_volume, debris_volume, face, face_solid, walled, wall_area, wall_velocity, wall_size,
                wall_sweep)
};

}  // namespace polynya::fluid
