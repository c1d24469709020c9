#include "fluid_solver/pressure_equilibrium.hpp"

#include <algorithm>
#include <cmath>

namespace polynya::fluid {
namespace {

struct Side {
  double pressure, slope, bulk;  ///< slope: of the pressure with the material's own volume
};

Side side(const EquationOfState& law, double floor, double mass, double energy, double volume,
          double exchange_pressure) {
  const double rho = mass / volume;
  const Response r = respond(law, rho, energy / mass);
  if (r.pressure <= floor) return {floor, 0.0, 0.0};
  return {r.pressure, -rho / volume * r.by_density - exchange_pressure / mass * r.by_energy, bulk_modulus(rho, r)};
}

/// How much energy volume takes along when it changes hands.
struct Exchange {
  double pressure = 0;  ///< of the volume that changes hands now
  int expands = -1;     ///< the material that expands reversibly, if one does
  double exponent = 0;  ///< of its isentrope: energy ~ volume^-exponent
  Mixture initial;

  /// Two gases: the one at the higher pressure expands reversibly, the other takes what that sets free, as behind a
  /// shock. Else the softer material's pressure, which its own volume feels most, holds for both. A material at its
  /// lower bound is partly void: the other expands into it against that bound only. At the other's pressure the work
  /// would go into the little mass there and spoil it.
  Exchange(const std::array<EquationOfState, 2>& law, const std::array<double, 2>& floor, const Mixture& mixture)
      : initial(mixture) {
    const Side a = side(law[0], floor[0], initial.mass[0], initial.energy[0], initial.volume[0], 0);
    const Side b = side(law[1], floor[1], initial.mass[1], initial.energy[1], initial.volume[1], 0);
    const int high = a.pressure > b.pressure ? 0 : 1;
    if (is_gas(law[0]) && is_gas(law[1]) && initial.energy[high] > 0) {
      expands = high;
      exponent = (high == 0 ? a : b).pressure * initial.volume[high] / initial.energy[high];
      return;
    }
    const bool first_yields = a.bulk == 0 || (b.bulk > 0 && a.bulk < b.bulk);
    pressure = std::max(0.0, first_yields ? a.pressure : b.pressure);
  }

  /// Sets the energies when material m has gained the volume `moved` and the other has lost it.
  void apply(Mixture& mixture, int m, double moved) {
    double given = pressure * moved;
    if (expands >= 0) {
      const double start = initial.energy[expands], sign = expands == m ? 1.0 : -1.0;
      const double freed = -start * std::expm1(-exponent * std::log1p(sign * moved / initial.volume[expands]));
      pressure = exponent * (start - freed) / mixture.volume[expands];
      given = sign * freed;
    }
    mixture.energy[m] = initial.energy[m] - given;
    mixture.energy[1 - m] = initial.energy[1 - m] + given;
  }
};

}  // namespace

PointState point_state(const EquationOfState& law, double floor, double mass, double energy, double volume) {
  const double rho = mass / volume;
  const Response r = respond(law, rho, energy / mass);
  const double bulk = std::max(0.0, bulk_modulus(rho, r));
  return {std::max(r.pressure, floor), r.pressure > floor ? bulk : 0.0, sound_speed(law, rho, r)};
}

PointState equilibrate(const std::array<EquationOfState, 2>& law, const std::array<double, 2>& floor,
                       Mixture& mixture) {
  const double total = mixture.volume[0] + mixture.volume[1];
  // A trace that arrived without volume starts from a volume far too small rather than from none.
  for (int m = 0; m < 2; ++m) {
    if (mixture.volume[m] > 1e-15 * total) continue;
    mixture.volume[m] = 1e-15 * total;
    mixture.volume[1 - m] = total * (1.0 - 1e-15);
  }
  const int minor = mixture.volume[0] < mixture.volume[1] ? 0 : 1, major = 1 - minor;
  Exchange exchange(law, floor, mixture);
  double low = 0, high = total, x = mixture.volume[minor];
  Side small{}, large{};
  for (int iteration = 0; iteration < 200; ++iteration) {
    mixture.volume[minor] = x;
    mixture.volume[major] = total - x;
    exchange.apply(mixture, minor, x - exchange.initial.volume[minor]);
    const auto of = [&](int m) {
      return side(law[m], floor[m], mixture.mass[m], mixture.energy[m], mixture.volume[m], exchange.pressure);
    };
    small = of(minor);
    large = of(major);
    const double excess = small.pressure - large.pressure;
    if (std::abs(excess) <= 1e-11 * (std::abs(small.pressure) + std::abs(large.pressure))) break;
    (excess > 0 ? low : high) = x;
    if (high - low <= 4e-16 * high) break;
    const double slope = small.slope + large.slope;
    double next = slope < 0 ? x - excess / slope : -1.0;
    if (!(next > low && next < high))
      next =
          low > 0 || high < total ? 0.5 * (low + high) : (excess > 0 ? std::min(2 * x, 0.5 * (x + total)) : 0.25 * x);
    x = next;
  }
  PointState state;
  double compliance = 0, weighted = 0;
  for (int m = 0; m < 2; ++m) {
    const PointState own = point_state(law[m], floor[m], mixture.mass[m], mixture.energy[m], mixture.volume[m]);
    const double share = mixture.volume[m] / total / std::max(own.bulk_modulus, 1e-3 * std::max(own.pressure, 1.0));
    compliance += share;
    weighted += share * own.pressure;
    // A trace by mass neither carries waves nor limits the step.
    if (mixture.mass[m] > 1e-3 * mixture.mass[1 - m]) state.sound_speed = std::max(state.sound_speed, own.sound_speed);
  }
  state.pressure = weighted / compliance;
  state.bulk_modulus = 1.0 / compliance;
  return state;
}

PointState settle(const std::array<EquationOfState, 2>& law, const std::array<double, 2>& floor, double volume,
                  Mixture& mixture) {
  const double held = mixture.volume[0] + mixture.volume[1];
  std::array<bool, 2> active{};
  for (int m = 0; m < 2; ++m)
    active[m] = mixture.mass[m] > void_density * volume && mixture.volume[m] > dormant_fraction * held;
  if (active[0] && active[1]) {
    for (double& own : mixture.volume) own *= volume / held;
    return equilibrate(law, floor, mixture);
  }
  const int only = active[0] ? 0 : active[1] ? 1 : mixture.mass[0] >= mixture.mass[1] ? 0 : 1;
  mixture.volume[only] = volume;
  mixture.volume[1 - only] = 0;
  return point_state(law[only], floor[only], mixture.mass[only], mixture.energy[only], volume);
}

std::array<double, 2> volume_shares(const std::array<EquationOfState, 2>& law, const std::array<double, 2>& floor,
                                    const Mixture& mixture, double change) {
  const double total = mixture.volume[0] + mixture.volume[1];
  if (!(mixture.volume[0] > 0) || !(mixture.mass[0] > 0)) return {0.0, 1.0};
  if (!(mixture.volume[1] > 0) || !(mixture.mass[1] > 0)) return {1.0, 0.0};
  const std::array<double, 2> fraction{mixture.volume[0] / total, mixture.volume[1] / total};
  std::array<double, 2> compliance{};
  for (int m = 0; m < 2; ++m) {
    const PointState own = point_state(law[m], floor[m], mixture.mass[m], mixture.energy[m], mixture.volume[m]);
    if (!(own.bulk_modulus > 0)) return fraction;
    compliance[m] = fraction[m] / own.bulk_modulus;
  }
  const double first = compliance[0] / (compliance[0] + compliance[1]);
  const std::array<double, 2> share{first, 1.0 - first};
  for (int m = 0; m < 2; ++m) {
    if (std::abs(share[m] * change) > 0.2 * mixture.volume[m]) return fraction;
  }
  return share;
}

}  // namespace polynya::fluid
