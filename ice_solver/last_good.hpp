#pragma once
#include "ice_solver/fields.hpp"

namespace polynya::ice {

/// What the field frames show of the ice, kept every twenty steps.
class LastGood {
 public:
  /// internal_forces(ice, dt). An element that inverts, or whose stress is not finite, puts the ice back to the state
  /// kept last, makes that a frame unless it is one, and throws std::runtime_error with the element's words and where
  /// the frame is.
  void internal_forces(IceBody& ice, double dt, IceFrames& frames);

  /// At the start and after loading a checkpoint; between them internal_forces does.
  void keep(const IceBody& ice);

 private:
  void put_back(IceBody& ice) const;

  long steps_ = 0;    ///< since the start of this process
  double time_ = -1;  ///< s, negative: nothing kept
  std::vector<double> positions_, velocities_;
  std::vector<std::uint8_t> living_elements_;
  continuum::ElementState element_;
  Particles particles_;
};

}  // namespace polynya::ice
