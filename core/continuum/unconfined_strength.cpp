#include <cmath>
#include <limits>

#include "core/continuum/johnson_holmquist_2.hpp"

namespace polynya::continuum {
namespace {

/// Root of q = strength(pressure_per_stress q): the surface starts above the path at q = 0 and is concave for N < 1, so
/// the root is unique; bisection in the logarithm of q.
double root(const JohnsonHolmquist2& law, double rate, double pressure_per_stress) {
  const auto surplus = [&](double q) { return strength(law, pressure_per_stress * q, rate, false, false).intact - q; };
  double low = 1e-6 * law.stress_at_hugoniot_elastic_limit, high = low;
  while (surplus(low) < 0 && low > 1e-300) low *= 0.1;
  while (surplus(high) > 0) {
    high *= 2;
    if (high > 1e6 * law.stress_at_hugoniot_elastic_limit) return std::numeric_limits<double>::infinity();
  }
  for (int k = 0; k < 200 && high > low * (1 + 1e-14); ++k) {
    const double middle = std::sqrt(low * high);
    (surplus(middle) > 0 ? low : high) = middle;
  }
  return high;
}

}  // namespace

double unconfined_compressive_strength(const JohnsonHolmquist2& law, double rate) {
  return root(law, rate, 1.0 / 3.0);
}

double uniaxial_tensile_strength(const JohnsonHolmquist2& law, double rate) {
  return root(law, rate, -1.0 / 3.0);
}

}  // namespace polynya::continuum
