#pragma once
#include "fluid_solver/mie_grueneisen.hpp"

namespace polynya::fluid {

/// P = (gamma - 1) rho e.
struct IdealGas {
  double gamma = 1.4;

  Response operator()(double rho, double e) const {
    return {(gamma - 1.0) * rho * e, (gamma - 1.0) * e, (gamma - 1.0) * rho};
  }
};

}  // namespace polynya::fluid
