// Newton's method for bodies that start under load, beside exact solutions and beside relaxation.
#include <gtest/gtest.h>

#include <cmath>

#include "block.hpp"
#include "core/continuum/equilibrium.hpp"
#include "core/continuum/rigid_modes.hpp"

namespace polynya::continuum {
namespace {

constexpr double gravity = 9.81, size = 0.01;
const Elastic elastic{900, 8.1254e9, 4.4444e9};
const J2Plastic ductile{900, 8.1254e9, 4.4444e9, 2e6, 1e9};

JohnsonHolmquist2 brittle() {
  JohnsonHolmquist2 law;
  law.density = 900, law.bulk_modulus = 8.1254e9, law.shear_modulus = 4.4444e9;
  law.stress_at_hugoniot_elastic_limit = 2.6429e9, law.pressure_at_hugoniot_elastic_limit = 3.4381e9;
  law.intact_strength_constant = 1.4, law.intact_strength_exponent = 0.8918;
  law.maximum_tensile_pressure = 1e6, law.damage_constant = 0.05, law.damage_exponent = 0.5;
  return law;
}

double young(const Elastic& e) {
  return 9 * e.bulk_modulus * e.shear_modulus / (3 * e.bulk_modulus + e.shear_modulus);
}

ExplicitSolid body(std::array<int, 3> cells, const Law& law, Integration integration = Integration::one_point) {
  Numerics numerics;
  numerics.integration = integration;
  return make_solid("block", tests::block(cells, {size * cells[0], size * cells[1], size * cells[2]}), law, numerics);
}

std::vector<double> weight_of(const ExplicitSolid& solid) {
  std::vector<double> loads(solid.positions.size(), 0.0);
  for (std::size_t n = 0; n < solid.node_count(); ++n) loads[3 * n + 2] = -gravity * solid.masses[n];
  return loads;
}

double largest(std::span<const double> values) {
  double result = 0;
  for (const double value : values) result = std::max(result, std::abs(value));
  return result;
}

/// Way of node n from the shape without stress to the present one, m.
std::array<double, 3> way(const ExplicitSolid& solid, std::size_t n) {
  return {solid.positions[3 * n] - solid.mesh.nodes[3 * n], solid.positions[3 * n + 1] - solid.mesh.nodes[3 * n + 1],
          solid.positions[3 * n + 2] - solid.mesh.nodes[3 * n + 2]};
}

/// Standing on its base; sideways held, or free.
ExplicitSolid standing_column(std::array<int, 3> cells, const Law& law, Integration integration, bool held_sideways) {
  ExplicitSolid solid = body(cells, law, integration);
  for (std::size_t n = 0; n < solid.node_count(); ++n)
    solid.fixed[n] = (held_sideways ? 3 : 0) | (solid.mesh.nodes[3 * n + 2] == 0 ? 4 : 0);
  return solid;
}

/// A plate under its weight and a pressure from below that is larger amidst: it bends, and hangs in balance.
struct Afloat {
  ExplicitSolid solid;
  std::vector<double> loads;
  double weight = 0;  ///< N
  explicit Afloat(const Law& law, std::array<int, 3> cells = {10, 8, 2}) : solid(body(cells, law)) {
    std::vector<double> borne = weight_of(solid);
    for (std::size_t n = 0; n < solid.node_count(); ++n) {
      weight += gravity * solid.masses[n];
      if (solid.mesh.nodes[3 * n + 2] == 0)
        borne[3 * n + 2] += 2 * cells[2] * gravity * solid.masses[n] *
                            (1 + 0.5 * std::cos(2 * M_PI * solid.mesh.nodes[3 * n] / (size * cells[0])));
    }
    loads = without_rigid_acceleration(solid, borne);
  }
};

TEST(NewtonEquilibrium, ColumnThatMayNotSpreadSinksByWhatTheSumOverItsElementsSays) {
  // Linear elements with lumped weight: the sum of (weight above the middle) h / M, just rho g L^2 / (2 M) at the top.
  constexpr int layers = 20;
  const double length = layers * size, modulus = elastic.bulk_modulus + 4.0 / 3.0 * elastic.shear_modulus,
               sinking = elastic.density * gravity * length * length / (2 * modulus);
  for (const Law& law : {Law(elastic), Law(ductile), Law(brittle())})
    for (const Integration integration : {Integration::one_point, Integration::full}) {
      ExplicitSolid solid = standing_column({2, 2, layers}, law, integration, true);
      const auto report = bring_into_equilibrium(solid, weight_of(solid));
      EXPECT_EQ(report.method, EquilibriumMethod::newton);
      EXPECT_EQ(report.factorisations, 1);
      EXPECT_LE(report.iterations, 3);
      // The node rounds to 2^-53 of its height, 3e-8 of what it sinks.
      EXPECT_NEAR(way(solid, solid.node_count() - 1)[2] / sinking, -1, 1e-6);
      for (std::size_t e = 0; e < solid.element_count(); ++e)
        EXPECT_NEAR(solid.element.stress[2][e], -elastic.density * gravity * (length - element_centre(solid, e)[2]),
                    1e-6 * 900 * gravity * length);
    }
}

TEST(NewtonEquilibrium, SlenderColumnSinksByHalfItsWeightOverYoungsModulus) {
  constexpr int layers = 30;
  const double length = layers * size, sinking = elastic.density * gravity * length * length / (2 * young(elastic));
  ExplicitSolid solid = standing_column({2, 2, layers}, elastic, Integration::one_point, false);
  bring_into_equilibrium(solid, weight_of(solid));
  double mean = 0;
  for (std::size_t k = 0; k < 9; ++k) mean += way(solid, solid.node_count() - 1 - k)[2] / 9;
  EXPECT_NEAR(mean / sinking, -1, 2e-3);  // the base is plane, not bulged by nu rho g r^2 / (2 E): (r / L)^2
}

TEST(NewtonEquilibrium, ColumnPressedBeyondYieldShortensAsHardeningAllows) {
  ExplicitSolid solid = standing_column({1, 1, 8}, ductile, Integration::one_point, false);
  const double stress = 3e6, area = size * size;
  std::vector<double> loads(solid.positions.size(), 0.0);
  for (std::size_t n = solid.node_count() - 4; n < solid.node_count(); ++n) loads[3 * n + 2] = -stress * area / 4;
  const auto report = bring_into_equilibrium(solid, loads);
  const double strain = stress / young(elastic) + (stress - ductile.yield_stress) / ductile.hardening_modulus;
  // Strains are logarithmic over the step, K acts on the density: second order in 1.2e-3.
  EXPECT_NEAR(way(solid, solid.node_count() - 1)[2] / (8 * size * strain), -1, 3e-3);
  EXPECT_NEAR(solid.element.plastic_strain[3], (stress - ductile.yield_stress) / ductile.hardening_modulus, 2e-6);
  EXPECT_LE(report.iterations, 8);
}

TEST(NewtonEquilibrium, AgreesWithRelaxationToWhatThatLeaves) {
  for (const Law& law : {Law(elastic), Law(brittle())}) {
    Afloat one(law), other(law);
    bring_into_equilibrium(one.solid, one.loads, EquilibriumMethod::newton);
    const auto report = bring_into_equilibrium(other.solid, other.loads, EquilibriumMethod::relaxation);
    EXPECT_EQ(report.method, EquilibriumMethod::relaxation);
    double furthest = 0, apart = 0;
    for (std::size_t n = 0; n < one.solid.node_count(); ++n)
      for (std::size_t i = 0; i < 3; ++i) {
        furthest = std::max(furthest, std::abs(way(one.solid, n)[i]));
        apart = std::max(apart, std::abs(way(one.solid, n)[i] - way(other.solid, n)[i]));
      }
    EXPECT_LT(apart, 1e-5 * furthest);
    const auto &stress = one.solid.element.stress[0], &relaxed = other.solid.element.stress[0];
    for (std::size_t e = 0; e < one.solid.element_count(); ++e)
      EXPECT_NEAR(stress[e], relaxed[e], 1e-5 * largest(stress));
  }
}

TEST(NewtonEquilibrium, PlateAfloatStartsInBalanceAndStaysAtRest) {
  for (const Law& law : {Law(elastic), Law(ductile), Law(brittle())}) {
    Afloat p(law);
    bring_into_equilibrium(p.solid, p.loads);
    internal_forces(p.solid, 0);
    std::array<double, 3> net{};
    double most = 0;
    for (std::size_t i = 0; i < p.loads.size(); ++i) {
      net[i % 3] += p.solid.internal_force[i] + p.loads[i];
      most = std::max(most, std::abs(p.solid.internal_force[i] + p.loads[i]));
    }
    EXPECT_LT(largest(net), 1e-10 * p.weight);
    EXPECT_LT(most, 2e-9 * p.weight);  // 2^-52 of the positions over strains of 1e-8: what volumes can tell
    double bent = 0;
    for (std::size_t n = 0; n < p.solid.node_count(); ++n) bent = std::max(bent, std::abs(way(p.solid, n)[2]));
    const std::vector<double> start = p.solid.positions;
    const double dt = 0.9 * stable_step(p.solid);
    advance_velocities(p.solid, p.loads, 0, dt);
    double moved = 0;
    for (int step = 0; step < 5000; ++step) {
      advance_positions(p.solid, dt);
      internal_forces(p.solid, dt);
      advance_velocities(p.solid, p.loads, dt, dt);
      for (std::size_t i = 0; i < start.size(); ++i) moved = std::max(moved, std::abs(p.solid.positions[i] - start[i]));
    }
    EXPECT_LT(moved, 1e-5 * bent);
  }
}

TEST(NewtonEquilibrium, RemovesWhatWouldMoveTheBodyAsAWholeAndNothingElse) {
  ExplicitSolid solid = body({3, 4, 2}, elastic);
  std::vector<double> loads(solid.positions.size(), 0.0);
  loads[3 * 7] = 5, loads[3 * 11 + 1] = -3, loads[3 * 30 + 2] = 2;
  const auto balanced = without_rigid_acceleration(solid, loads);
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();
  for (std::size_t n = 0; n < solid.node_count(); ++n) {
    const Eigen::Map<const Eigen::Vector3d> f(&balanced[3 * n]), x(&solid.positions[3 * n]);
    force += f, moment += x.cross(f);
  }
  EXPECT_LT(force.norm(), 1e-14);
  EXPECT_LT(moment.norm(), 1e-15);
  for (std::uint8_t& held : solid.fixed) held = 3;  // one way is free: up
  EXPECT_EQ(free_rigid_modes(solid).cols(), 1);
  solid.fixed.assign(solid.node_count(), 0);
  for (std::size_t n = 0; n < solid.node_count(); ++n)
    if (solid.mesh.nodes[3 * n] == 0) solid.fixed[n] = 1;  // symmetry: along y, along z, about x
  EXPECT_EQ(free_rigid_modes(solid).cols(), 3);
  for (std::size_t n = 0; n < solid.node_count(); ++n)
    if (solid.mesh.nodes[3 * n + 2] == 0) solid.fixed[n] = 7;
  EXPECT_EQ(free_rigid_modes(solid).cols(), 0);
  EXPECT_EQ(without_rigid_acceleration(solid, loads), loads);
}

TEST(NewtonEquilibrium, SaysSoWhereThereIsNone) {
  const auto message = [](ExplicitSolid solid, std::span<const double> loads, EquilibriumMethod method) {
    try {
      bring_into_equilibrium(solid, loads, method);
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string("found one");
  };
  // A column of ice pulled by more than it bears.
  ExplicitSolid torn = standing_column({1, 1, 4}, brittle(), Integration::one_point, false);
  std::vector<double> loads(torn.positions.size(), 0.0);
  for (std::size_t n = torn.node_count() - 4; n < torn.node_count(); ++n) loads[3 * n + 2] = 5e7 * size * size / 4;
  EXPECT_EQ(message(torn, loads, EquilibriumMethod::newton).substr(0, 15), "no equilibrium:");
  // One pressed by a thousand times its stiffness.
  ExplicitSolid crushed = standing_column({1, 1, 4}, elastic, Integration::one_point, false);
  for (double& load : loads) load *= -1e6;
  for (const EquilibriumMethod method : {EquilibriumMethod::newton, EquilibriumMethod::automatic})
    EXPECT_EQ(message(crushed, loads, method).substr(0, 15), "no equilibrium:");
  // Two cubes that hang together by an edge, as by a hinge, pushed so that it turns.
  HexMesh hinge = tests::block({2, 1, 2}, {2 * size, size, 2 * size});
  hinge.elements.erase(hinge.elements.begin() + 8, hinge.elements.begin() + 24);
  ExplicitSolid folding = make_solid("hinge", hinge, elastic);
  loads.assign(folding.positions.size(), 0.0);
  for (std::size_t n = 0; n < folding.node_count(); ++n)
    loads[3 * n] = folding.masses[n] * (folding.mesh.nodes[3 * n + 2] == size ? -1.0 : 1.0);
  const std::string loose = message(folding, loads, EquilibriumMethod::newton);
  EXPECT_NE(loose.find("can move without straining"), std::string::npos) << loose;
  EXPECT_EQ(message(folding, loads, EquilibriumMethod::automatic).substr(0, 15), "no equilibrium:");
}

TEST(NewtonEquilibrium, LeavesPartsThatAreInBalanceEachAloneToRelaxation) {
  HexMesh two = tests::block({3, 1, 1}, {3 * size, size, size});
  two.elements.erase(two.elements.begin() + 8, two.elements.begin() + 16);
  ExplicitSolid solid = make_solid("two", two, elastic);
  std::vector<double> loads(solid.positions.size(), 0.0);
  for (std::size_t n = 0; n < solid.node_count(); ++n)
    loads[3 * n + 2] = solid.masses[n] * (solid.mesh.nodes[3 * n + 2] == 0 ? 10.0 : -10.0);
  const std::vector<double> start = solid.positions;
  EXPECT_THROW(bring_into_equilibrium(solid, loads, EquilibriumMethod::newton), std::runtime_error);
  EXPECT_EQ(bring_into_equilibrium(solid, loads).method, EquilibriumMethod::relaxation);
  EXPECT_EQ(solid.positions, start);
  EXPECT_LT(solid.element.stress[2][0], 0);
}

}  // namespace
}  // namespace polynya::continuum
