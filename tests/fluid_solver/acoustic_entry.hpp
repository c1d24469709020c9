#pragma once
#include <cmath>
#include <numbers>

/// A wedge that enters compressible water at constant speed V, in Wagner's theory: the wetted part is a flat plate that grows
/// at a constant rate in a half-plane of linear acoustics (the problem of Skalak & Feit 1966).
///
/// The potential is of degree one in (x, y, t), so by Smirnov's and Sobolev's functions of t/x, as for a crack in antiplane
/// shear that grows from a point (Broberg): with the edge at x = a t, M = a / sound speed,
///   potential on the plate  V sqrt(a^2 t^2 - x^2) / E(k),  k^2 = 1 - M^2, E the complete elliptic integral;
///   Wagner's condition      a tan(deadrise) = V (1 + J / E(k)),  J = Int_M^1 sqrt(s^2 - M^2) / ((1 + s) sqrt(1 - s^2)) ds.
/// For M = 0 that is Wagner's a = pi V / (2 tan(deadrise)).
namespace polynya::fluid::test {

/// Compressible over incompressible.
struct AcousticEntry {
  double edge_mach;  ///< of the edge, compressible
  double half_width;
  double force;
};

/// `mach`: speed of the wedge over sound speed; the edge must stay below it.
inline AcousticEntry acoustic_entry(double deadrise, double mach) {
  const double pi = std::numbers::pi, slope = std::tan(deadrise * pi / 180), wagner = mach / slope * pi / 2;
  const auto integral = [&](double edge) {  // s = sin(angle)
    const int points = 4000;
    const double from = std::asin(edge), part = (pi / 2 - from) / points;
    double sum = 0;
    for (int i = 0; i < points; ++i) {
      const double s = std::sin(from + (i + 0.5) * part);
      sum += std::sqrt(s * s - edge * edge) / (1 + s) * part;
    }
    return sum;
  };
  const auto elliptic = [](double edge) { return std::comp_ellint_2(std::sqrt(1 - edge * edge)); };
  double edge = wagner;
  for (int i = 0; i < 60; ++i) edge = mach / slope * (1 + integral(edge) / elliptic(edge));
  const double half_width = edge / wagner;
  return {edge, half_width, half_width * half_width / elliptic(edge)};
}

}  // namespace polynya::fluid::test
