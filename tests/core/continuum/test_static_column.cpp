// A column that stands on a non-reflecting boundary: it must carry the weight for good, and let waves through still.
#include <gtest/gtest.h>

#include <cmath>

#include "block.hpp"
#include "core/continuum/equilibrium.hpp"

namespace polynya::continuum {
namespace {

constexpr int layers = 80;
constexpr double size = 0.01, length = layers * size, gravity = 9.81;
const Elastic material{900, 8.1254e9, 4.4444e9};
const double modulus = material.bulk_modulus + 4.0 / 3.0 * material.shear_modulus,
             speed = std::sqrt(modulus / material.density);

JohnsonHolmquist2 brittle() {
  JohnsonHolmquist2 law;
  law.density = material.density, law.bulk_modulus = material.bulk_modulus, law.shear_modulus = material.shear_modulus;
  law.stress_at_hugoniot_elastic_limit = 2.6429e9, law.pressure_at_hugoniot_elastic_limit = 3.4381e9;
  law.intact_strength_constant = 1.4, law.intact_strength_exponent = 0.8918;
  law.maximum_tensile_pressure = 1e6, law.damage_constant = 0.05, law.damage_exponent = 0.5;
  return law;
}

struct Column {
  ExplicitSolid solid;
  std::vector<double> loads;
  double dt = 0;

  /// Its base held while it comes into equilibrium, then given to the boundary. Sideways held: plane waves.
  explicit Column(const Law& law, EquilibriumMethod method = EquilibriumMethod::newton)
      : solid(make_solid("column", tests::block({1, 1, layers}, {size, size, length}), law)) {
    loads.assign(solid.positions.size(), 0.0);
    for (std::size_t n = 0; n < solid.node_count(); ++n) {
      solid.fixed[n] = is_base(n) ? 7 : 3;
      loads[3 * n + 2] = -gravity * solid.masses[n];
    }
    bring_into_equilibrium(solid, loads, method);
    for (std::uint8_t& held : solid.fixed) held = 3;
    add_non_reflecting_boundary(solid, {{0, 0, 1}, 0});
    internal_forces(solid, 0);
    hold_boundary_at_rest(solid, loads);
    dt = 0.9 * stable_step(solid);
    advance_velocities(solid, loads, 0, dt);
  }
  bool is_base(std::size_t n) const { return n < 4; }

  void step() {
    advance_positions(solid, dt);
    internal_forces(solid, dt);
    advance_velocities(solid, loads, dt, dt);
  }
};

double furthest(const std::vector<double>& one, const std::vector<double>& other) {
  double result = 0;
  for (std::size_t i = 0; i < one.size(); ++i) result = std::max(result, std::abs(one[i] - other[i]));
  return result;
}

struct Drift {
  double early, late;  ///< by the length, in the first 2e4 and the other 8e4 steps
  double stress;       ///< by the weight over the area
};

Drift drift(const Law& law, EquilibriumMethod method) {
  Column column(law, method);
  const std::vector<double> start = column.solid.positions;
  const auto stress = column.solid.element.stress[2];
  for (int step = 0; step < 20000; ++step) column.step();
  const std::vector<double> between = column.solid.positions;
  for (int step = 0; step < 80000; ++step) column.step();
  const Drift result{furthest(between, start) / length, furthest(column.solid.positions, between) / length,
                     furthest(column.solid.element.stress[2], stress) / (material.density * gravity * length)};
  std::printf("drift: %.2e of the length in 2e4 steps, %.2e in 8e4 more; stress changes by %.2e of the weight\n",
              result.early, result.late, result.stress);
  return result;
}

// Dashpots on velocities hold nothing: a force F that the boundary does not carry creeps at F / (rho c A). Rounding of
// 2^-52 of the weight at each of the nodes would be 4e-17 of the length in 1e5 steps.
TEST(StaticColumn, DoesNotDriftInAHundredThousandSteps) {
  const Drift d = drift(material, EquilibriumMethod::newton);
  EXPECT_LT(d.early + d.late, 4e-17);
  EXPECT_LT(d.stress, 1e-9);
}

// Here the start is balanced to 1e-6 of the weight only: by what relaxation leaves, and by pressures that follow
// volumes and so round to 1e-14 K, 1e-7 of the weight. Inside the column settles, 1e-6 of what its weight does to
// it, 2.5e-13 of the length; the boundary carries the sum and does not creep, which without it would go on for good.
TEST(StaticColumn, SettlesWithoutCreepFromAStartThatIsNotQuiteBalanced) {
  for (const Drift& d : {drift(material, EquilibriumMethod::relaxation), drift(brittle(), EquilibriumMethod::newton)}) {
    EXPECT_LT(d.early, 5e-13);
    EXPECT_LT(d.late, 1e-13);
    EXPECT_LT(d.stress, 1e-6);
  }
}

TEST(StaticColumn, LetsAPulseThroughItsBaseAfterwards) {
  Column column(material);
  for (int step = 0; step < 1000; ++step) column.step();
  const auto stress = column.solid.element.stress[2];
  const auto wave_energy = [&] {
    double sum = 0;
    for (std::size_t n = 0; n < column.solid.node_count(); ++n)
      sum += 0.5 * column.solid.masses[n] * std::pow(column.solid.velocities[3 * n + 2], 2);
    for (std::size_t e = 0; e < column.solid.element_count(); ++e)
      sum +=
          std::pow(column.solid.element.stress[2][e] - stress[e], 2) / (2 * modulus) * column.solid.element.volume[e];
    return sum;
  };
  const std::vector<double> weight = column.loads;
  const double lasts = 25 * size / speed, begin = column.solid.time, area = size * size, pressure = 1e4;
  double arriving = 0;
  while (column.solid.time < begin + 1.9 * length / speed) {
    column.loads = weight;
    const double t = column.solid.time - begin;
    for (std::size_t n = column.solid.node_count() - 4; n < column.solid.node_count() && t < lasts; ++n)
      column.loads[3 * n + 2] -= 0.25 * area * pressure * std::pow(std::sin(M_PI * t / lasts), 2);
    column.step();
    if (t < 0.9 * length / speed) arriving = wave_energy();
  }
  std::printf("reflected %.3e of the energy\n", wave_energy() / arriving);
  EXPECT_GT(arriving, 0);
  EXPECT_LT(wave_energy(), 0.01 * arriving);
}

}  // namespace
}  // namespace polynya::continuum
