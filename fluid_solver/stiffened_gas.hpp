#pragma once
#include "fluid_solver/mie_grueneisen.hpp"

namespace polynya::fluid {

/// P = (gamma - 1) rho e - gamma P_inf.
struct StiffenedGas {
  double gamma = 4.4, stiffness = 6.0e8;  ///< stiffness: P_inf, Pa

  Response operator()(double rho, double e) const {
    return {(gamma - 1.0) * rho * e - gamma * stiffness, (gamma - 1.0) * e, (gamma - 1.0) * rho};
  }
};

}  // namespace polynya::fluid
