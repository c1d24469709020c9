#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "core/continuum/explicit_solid.hpp"
#include "structure_solver/launch.hpp"
#include "structure_solver/vehicle_body.hpp"

namespace polynya::structure {

/// Where stress is read: elements behind the tip, and slices at stations along the axis. Chosen once, in the reference
/// configuration, by the depth of the elements' centres below the nose.
///
/// Tip: centres within 2 mm of the nose, or within the depth of the first element's centre if that is deeper (coarse
/// meshes, large bodies). Stations: centres within half an element (at least 1 mm) of the station, or else the nearest
/// slice of elements.
class StressProbe {
 public:
  StressProbe() = default;
  /// Of a mesh that is placed as the launch says.
  StressProbe(const continuum::ExplicitSolid& solid, const Launch& launch);

  double head_average(const continuum::ExplicitSolid& solid) const;                         ///< Pa
  double head_maximum(const continuum::ExplicitSolid& solid) const;                         ///< Pa
  std::array<double, station_count> stations(const continuum::ExplicitSolid& solid) const;  ///< Pa

 private:
  std::vector<std::int32_t> head_;
  std::array<std::vector<std::int32_t>, station_count> slices_;
};

/// von Mises stress of an element, Pa.
double von_mises(const continuum::ExplicitSolid& solid, std::size_t element);

}  // namespace polynya::structure
