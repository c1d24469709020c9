#pragma once
#include "fluid_solver/mie_grueneisen.hpp"

namespace polynya::fluid {

/// Linear polynomial equation of state: P = C0 + C1 mu + C2 mu^2 + C3 mu^3 + (C4 + C5 mu + C6 mu^2) E,
/// E the internal energy per reference volume. C4 = C5 = gamma - 1, others 0: an ideal gas.
struct LinearPolynomial {
  double density = 1.2;  ///< reference density, kg/m^3
  double c0 = 0, c1 = 0, c2 = 0, c3 = 0, c4 = 0.4, c5 = 0.4, c6 = 0;

  /// True if the pressure comes from the internal energy alone.
  bool is_gas() const { return c0 == 0 && c1 == 0 && c2 == 0 && c3 == 0; }

  Response operator()(double rho, double e) const {
    const double mu = rho / density - 1.0, energy = density * e;
    const double factor = c4 + mu * (c5 + mu * c6);
    return {c0 + mu * (c1 + mu * (c2 + mu * c3)) + factor * energy,
            (c1 + mu * (2.0 * c2 + 3.0 * mu * c3) + (c5 + 2.0 * c6 * mu) * energy) / density, factor * density};
  }
};

}  // namespace polynya::fluid
