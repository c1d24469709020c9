#include "core/continuum/fracture_energy.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace polynya::continuum {
namespace {

constexpr double slow = 1e9;           // s per increment: below every reference rate
constexpr int steps_to_strength = 50;  // increments of strain until the strength is reached
constexpr int longest_path = 200000;   // increments: beyond it the card hardly softens
constexpr double residual = 0.1;       // of the peak: where the tail begins

double youngs_modulus(const JohnsonHolmquist2& law) {
  return 9 * law.bulk_modulus * law.shear_modulus / (3 * law.bulk_modulus + law.shear_modulus);
}

PointState<double> stretched(const JohnsonHolmquist2& law, PointState<double> state, double axial, double lateral) {
  state.relative_volume *= std::exp(axial + 2 * lateral);
  advance_stress(law, state, SymmetricTensor<double>{axial, lateral, lateral, 0, 0, 0}, slow);
  return state;
}

/// One increment of axial strain at no lateral stress, which grows with the lateral strain: bisection.
PointState<double> pulled(const JohnsonHolmquist2& law, const PointState<double>& state, double axial) {
  double low = -axial, high = 0;
  while (stretched(law, state, axial, high).stress[1] < 0 && high < 100 * axial) high += axial;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    (stretched(law, state, axial, middle).stress[1] < 0 ? low : high) = middle;
  }
  return stretched(law, state, axial, 0.5 * (low + high));
}

}  // namespace

double tensile_work_to_fracture(const JohnsonHolmquist2& law) {
  const double increment = uniaxial_tensile_strength(law, law.reference_strain_rate) / youngs_modulus(law) /
                           static_cast<double>(steps_to_strength);
  PointState<double> state;
  double work = 0, peak = 0;
  for (int i = 0; i < longest_path && state.stress[0] >= residual * peak; ++i) {
    const PointState<double> next = pulled(law, state, increment);
    work += 0.5 * (state.stress[0] + next.stress[0]) * increment;
    state = next;
    peak = std::max(peak, state.stress[0]);
  }
  return work;
}

JohnsonHolmquist2 regularised(JohnsonHolmquist2 law, double size) {
  const double wanted = law.fracture_energy / size;
  const auto work = [&](double ductility) {
    law.tension_ductility = ductility;
    return tensile_work_to_fracture(law);
  };
  double low = 1e-4, high = 1;
  const double least = work(low);
  if (!(wanted > least))
    throw std::invalid_argument("an ice element of " + std::to_string(size) +
                                " m takes more energy than the card's fracture_energy before it breaks; elements may "
                                "be at most " +
                                std::to_string(law.fracture_energy / least) +
                                " m, or set effects.damage_regularisation to \"off\"");
  while (work(high) < wanted) high *= 2;
  for (int i = 0; i < 30; ++i) {
    const double middle = std::sqrt(low * high);
    (work(middle) < wanted ? low : high) = middle;
  }
  law.tension_ductility = std::sqrt(low * high);
  return law;
}

}  // namespace polynya::continuum
