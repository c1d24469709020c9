#pragma once
#include <cmath>

#include "fluid_solver/mie_grueneisen.hpp"

namespace polynya::fluid {

/// Tait's equation of state of water: P = P0 + B ((rho/rho0)^n - 1), whatever the energy. (Constants: Liu, Khoo & Xie
/// 2004.)
struct Tait {
  double density = 1000;            ///< at the reference pressure, kg/m^3
  double reference_pressure = 1e5;  ///< P0, Pa
  double stiffness = 3.31e8;        ///< B, Pa
  double exponent = 7.15;           ///< n

  Response operator()(double rho, double) const {
    const double power = std::pow(rho / density, exponent);
    return {reference_pressure + stiffness * (power - 1.0), exponent * stiffness * power / rho, 0.0};
  }
};

}  // namespace polynya::fluid
