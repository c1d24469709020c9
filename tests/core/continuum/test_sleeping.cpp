// Elements that no disturbance has reached are not stepped.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/continuum/equilibrium.hpp"
#include "core/continuum/explicit_solid.hpp"
#include "tests/core/continuum/block.hpp"

namespace polynya::continuum {
namespace {

using tests::block;

const Elastic ice{900, 8.1254e9, 4.4444e9};
constexpr double size = 0.01;

struct Plate {
  ExplicitSolid solid;
  std::vector<double> load;
  double dt = 0;
};

/// length x 24 x 2 elements, in chunks that follow one another along z, the axis of its length.
Plate plate(double threshold, Integration integration = Integration::one_point, int length = 96) {
  Numerics numerics;
  numerics.integration = integration;
  HexMesh mesh = block({2, 24, length}, {2 * size, 24 * size, length * size});
  Plate plate{make_solid("plate", std::move(mesh), ice, numerics), {}};
  plate.solid.sleeping.threshold = threshold;
  plate.load.assign(3 * plate.solid.node_count(), 0.0);
  plate.dt = 0.8 * stable_step(plate.solid);
  return plate;
}

void begin(Plate& plate) {
  internal_forces(plate.solid, 0);
  let_sleep(plate.solid, plate.load, plate.dt);
  advance_velocities(plate.solid, plate.load, 0, plate.dt);
}

void advance(Plate& plate, int steps) {
  for (int n = 0; n < steps; ++n) {
    advance_positions(plate.solid, plate.dt);
    internal_forces(plate.solid, plate.dt);
    advance_velocities(plate.solid, plate.load, plate.dt, plate.dt);
  }
}

/// A blow of ten steps on one corner, then free motion while the wave crosses a part of the plate.
Plate struck(double threshold, int steps = 60, Integration integration = Integration::one_point) {
  Plate p = plate(threshold, integration);
  p.load[0] = p.load[2] = 2000;
  begin(p);
  advance(p, 10);
  std::fill(p.load.begin(), p.load.end(), 0.0);
  advance(p, steps - 10);
  return p;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0;
  for (std::size_t k = 0; k < a.size(); ++k) most = std::max(most, std::abs(a[k] - b[k]));
  return most;
}

void expect_difference_goes_with_threshold(Integration integration, int steps) {
  const Plate whole = struck(0, steps, integration);
  const double c = longitudinal_wave_speed(whole.solid.law);
  EXPECT_EQ(whole.solid.sleeping.share_awake(), 1);
  double before = 1e300, share_before = 0;
  for (const double threshold : {1e-4, 1e-6, 1e-8}) {
    const Plate part = struck(threshold, steps, integration);
    const double off = largest_difference(whole.solid.velocities, part.solid.velocities);
    std::printf("threshold %g: velocities differ by %.2e of the wave speed, %.0f %% stepped\n", threshold, off / c,
                100 * part.solid.sleeping.share_awake());
    EXPECT_LT(off, threshold * c);
    EXPECT_LT(off, 0.2 * before);
    EXPECT_LT(largest_difference(whole.solid.positions, part.solid.positions), threshold * c * part.solid.time);
    EXPECT_LT(part.solid.sleeping.share_awake(), 0.9);
    EXPECT_GT(part.solid.sleeping.share_awake(), share_before);
    const EnergyAccount all = energies(whole.solid), some = energies(part.solid);
    EXPECT_LT(std::abs(some.balance()), 1e-12 * some.external_work);
    EXPECT_LT(std::abs(some.kinetic - all.kinetic), threshold * c * all.kinetic);
    before = off, share_before = part.solid.sleeping.share_awake();
  }
}

TEST(SolidSleeping, DifferenceToThePlateAwakeGoesWithTheThreshold) {
  expect_difference_goes_with_threshold(Integration::one_point, 60);
}

TEST(SolidSleeping, DifferenceGoesWithTheThresholdInFullyIntegratedElements) {
  expect_difference_goes_with_threshold(Integration::full, 40);
}

TEST(SolidSleeping, LoadOnASleepingNodeMovesItInTheSameStep) {
  Plate asleep = plate(1e-8), awake = plate(0);
  const std::size_t n = asleep.solid.node_count() / 2;
  for (Plate* p : {&asleep, &awake}) {
    begin(*p);
    advance(*p, 5);
    p->load[3 * n + 1] = 10;
  }
  EXPECT_EQ(asleep.solid.sleeping.elements_awake, 0u);
  for (Plate* p : {&asleep, &awake}) advance(*p, 1);
  EXPECT_GT(asleep.solid.velocities[3 * n + 1], 0);
  EXPECT_EQ(asleep.solid.velocities, awake.solid.velocities);
  EXPECT_GT(asleep.solid.sleeping.elements_awake, 0u);
  EXPECT_LT(asleep.solid.sleeping.elements_awake, asleep.solid.element_count() / 2);
}

TEST(SolidSleeping, LoadBelowTheThresholdWakesNothing) {
  Plate p = plate(1e-6);
  const std::size_t n = p.solid.node_count() / 2;
  const double bound = 1e-6 * longitudinal_wave_speed(p.solid.law) * p.solid.masses[n] / (1000 * p.dt);
  begin(p);
  p.load[3 * n] = 0.99 * bound;
  advance(p, 3);
  EXPECT_EQ(p.solid.sleeping.elements_awake, 0u);
  p.load[3 * n] = 1.01 * bound;
  advance(p, 1);
  EXPECT_GT(p.solid.sleeping.elements_awake, 0u);
}

TEST(SolidSleeping, PlateInEquilibriumSleepsAsAWholeAndDoesNotDrift) {
  // Afloat and bent: its weight, borne by pressure from below that is larger under the middle than under the ends, and
  // pulled along its length.
  Plate p = plate(1e-7, Integration::one_point, 24);
  const auto& x = p.solid.mesh.nodes;
  double weight = 0, borne = 0;
  std::vector<double> push(p.solid.node_count());
  for (std::size_t n = 0; n < push.size(); ++n) {
    weight += 9.81 * p.solid.masses[n];
    if (x[3 * n] == 0) push[n] = 1 + 0.2 * std::sin(M_PI * x[3 * n + 2] / (24 * size));
    borne += push[n];
  }
  for (std::size_t n = 0; n < push.size(); ++n) {
    p.load[3 * n] = push[n] * weight / borne - 9.81 * p.solid.masses[n];
    if (x[3 * n + 2] == 0) p.load[3 * n + 2] = -0.05;
    if (x[3 * n + 2] == 24 * size) p.load[3 * n + 2] = 0.05;
  }
  bring_into_equilibrium(p.solid, p.load);
  const std::vector<double> start = p.solid.positions;
  const auto stress = p.solid.element.stress;
  EXPECT_GT(*std::max_element(stress[5].begin(), stress[5].end()), 0);
  begin(p);
  EXPECT_EQ(p.solid.sleeping.elements_awake, 0u);
  advance(p, 200);
  EXPECT_EQ(p.solid.positions, start);
  EXPECT_EQ(p.solid.element.stress, stress);
  EXPECT_EQ(p.solid.sleeping.elements_stepped, 0);
  EXPECT_NEAR(p.solid.time, 200 * p.dt, 1e-12);
}

TEST(SolidSleeping, WeightThatNothingBearsKeepsThePlateAwake) {
  Plate p = plate(1e-7);
  for (std::size_t n = 0; n < p.solid.node_count(); ++n) p.load[3 * n] = -9.81 * p.solid.masses[n];
  begin(p);
  EXPECT_TRUE(p.solid.sleeping.all_awake);
}

TEST(SolidSleeping, NonReflectingBoundaryThatCarriesTheRestSleepsAndTakesTheWaveThatComes) {
  Plate p = plate(1e-8), whole = plate(0);
  for (Plate* each : {&p, &whole}) {
    add_non_reflecting_boundary(each->solid, {{0, 0, 1}, 96 * size});
    for (std::size_t n = 0; n < each->solid.node_count(); ++n)
      if (each->solid.mesh.nodes[3 * n + 2] == 96 * size) each->load[3 * n + 2] = 5;
    internal_forces(each->solid, 0);
    hold_boundary_at_rest(each->solid, each->load);
    begin(*each);
  }
  EXPECT_EQ(p.solid.sleeping.elements_awake, 0u);
  const std::size_t near = p.solid.node_count() - 3 * 25 * 6;
  for (Plate* each : {&p, &whole}) {
    each->load[3 * near + 2] = 1000;
    advance(*each, 60);
  }
  EXPECT_GT(energies(whole.solid).boundary_flux, 0);
  EXPECT_NEAR(energies(p.solid).boundary_flux, energies(whole.solid).boundary_flux,
              1e-6 * energies(whole.solid).boundary_flux);
  EXPECT_LT(p.solid.sleeping.share_awake(), 0.9);
}

TEST(SolidSleeping, ElementsAroundOneThatIsRemovedWake) {
  Plate p = plate(1e-8);
  begin(p);
  remove_element(p.solid, 0);
  EXPECT_GT(p.solid.sleeping.elements_awake, 0u);
  EXPECT_FALSE(p.solid.sleeping.node_sleeps(0));
}

}  // namespace
}  // namespace polynya::continuum
