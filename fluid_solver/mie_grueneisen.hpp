#pragma once
#include <algorithm>

namespace polynya::fluid {

/// What an equation of state says at one point: pressure (Pa) and its partial derivatives with respect to density
/// (at constant energy) and to specific internal energy (at constant density).
struct Response {
  double pressure, by_density, by_energy;
};

/// Mie-Grueneisen equation of state of water: a shock Hugoniot in compression, linear in expansion.
/// Pressure is linear in the specific internal energy, which is 0 at the reference density and zero pressure.
struct MieGrueneisen {
  double density = 1000, sound_speed = 1480;   ///< reference density, kg/m^3; m/s
  double s1 = 2.56, s2 = -1.986, s3 = 0.2268;  ///< shock slope coefficients
  double gamma0 = 0.5, a = 0;                  ///< Grueneisen coefficient and its volume correction

  Response operator()(double rho, double e) const {
    const double mu = rho / density - 1.0, up = std::max(mu, 0.0), down = std::min(mu, 0.0);
    const double stiffness = density * sound_speed * sound_speed, inverse = 1.0 / (1.0 + up), r = up * inverse;
    const double top = up * (1.0 + (1.0 - 0.5 * gamma0) * up - 0.5 * a * up * up);
    const double top_slope = 1.0 + (2.0 - gamma0) * up - 1.5 * a * up * up;
    const double bottom = 1.0 - (s1 - 1.0) * up - s2 * up * r - s3 * up * r * r;
    const double bottom_slope = -(s1 - 1.0) - s2 * r * (2.0 + up) * inverse - s3 * r * r * (3.0 + up) * inverse;
    const double over = 1.0 / bottom;
    const double cold = stiffness * (top * over * over + down);
    const double cold_slope = stiffness * (top_slope * bottom - 2.0 * top * bottom_slope) * over * over * over;
    const double gamma = gamma0 + a * mu;
    return {cold + gamma * density * e, cold_slope / density + a * e, gamma * density};
  }
};

}  // namespace polynya::fluid
