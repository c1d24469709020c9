#include "fluid_solver/equation_range.hpp"

#include <limits>
#include <sstream>

namespace polynya::fluid {
namespace {

/// Cold pressure still rises with the density.
bool rises(const MieGrueneisen& law, double compression) {
  const double r = compression / (1.0 + compression);
  const double bottom = 1.0 - (law.s1 - 1.0) * compression - law.s2 * compression * r - law.s3 * compression * r * r;
  return bottom > 0 && law(law.density * (1.0 + compression), 0.0).by_density > 0;
}

double end_of_hugoniot(const MieGrueneisen& law) {
  constexpr double step = 0.01, farthest = 20;  // beyond twenty-one times the density a fit to shocks has no end
  double good = 0;
  while (good < farthest && rises(law, good + step)) good += step;
  if (good >= farthest) return std::numeric_limits<double>::infinity();
  double bad = good + step;
  for (int halving = 0; halving < 50; ++halving) {
    const double middle = 0.5 * (good + bad);
    (rises(law, middle) ? good : bad) = middle;
  }
  return law.density * (1.0 + good);
}

}  // namespace

double largest_density(const EquationOfState& law) {
  if (const auto* water = std::get_if<MieGrueneisen>(&law)) return end_of_hugoniot(*water);
  return std::numeric_limits<double>::infinity();
}

std::string range_fault(const EquationOfState& law, const Bounds& bounds, double rho, double e) {
  std::ostringstream text;
  if (!(rho > 0)) {
    text << "density " << rho << " kg/m^3, must be above 0";
    return text.str();
  }
  if (is_gas(law) && rho * e < -bounds.rounding) {
    text << "internal energy " << e << " J/kg, a gas has at least 0";
    return text.str();
  }
  if (rho > bounds.largest_density) {
    text << "density " << rho << " kg/m^3, its Mie-Grueneisen law holds up to " << bounds.largest_density << " kg/m^3";
    return text.str();
  }
  const Response state = respond(law, rho, e);
  if (state.pressure > bounds.floor && !is_gas(law) && !(bulk_modulus(rho, state) > 0)) {
    text << "density " << rho << " kg/m^3 and energy " << e << " J/kg, where its law has no real sound speed (pressure "
         << state.pressure << " Pa)";
  }
  return text.str();
}

}  // namespace polynya::fluid
