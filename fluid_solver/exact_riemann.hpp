#pragma once
#include <array>

namespace polynya::fluid {

/// One side of a Riemann problem: a stiffened gas (an ideal gas with stiffness 0).
struct RiemannState {
  double density = 0, velocity = 0, pressure = 0, gamma = 1.4, stiffness = 0;
};

/// The exact solution of two stiffened gases in contact (Toro 2009, section 4, with p + P_inf for p).
class ExactRiemann {
 public:
  /// Throws std::runtime_error if the states would open a vacuum.
  ExactRiemann(const RiemannState& left, const RiemannState& right);

  struct Sample {
    double density, velocity, pressure;
  };
  /// State on the ray x/t = speed from the diaphragm.
  Sample sample(double speed) const;
  double star_pressure() const { return star_pressure_; }
  double star_velocity() const { return star_velocity_; }

 private:
  std::array<RiemannState, 2> side_;
  double star_pressure_ = 0, star_velocity_ = 0;
};

}  // namespace polynya::fluid
