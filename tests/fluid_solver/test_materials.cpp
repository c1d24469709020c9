#include <gtest/gtest.h>

#include <cmath>

#include "fluid_solver/pressure_equilibrium.hpp"

using namespace polynya::fluid;

namespace {

double numerical_slope(const EquationOfState& law, double rho, double e, bool by_density) {
  const double step = by_density ? 1e-6 * rho : std::max(1.0, 1e-6 * std::abs(e));
  const auto p = [&](double s) {
    return respond(law, rho + (by_density ? s : 0.0), e + (by_density ? 0.0 : s)).pressure;
  };
  return (p(step) - p(-step)) / (2 * step);
}

}  // namespace

TEST(EquationOfState, DerivativesAreThoseOfThePressure) {
  const std::vector<std::tuple<EquationOfState, double, double>> points{
      {MieGrueneisen{}, 1100.0, 1e4},
      {MieGrueneisen{}, 970.0, 2e3},
      {MieGrueneisen{1000, 1484, 1.979, 0, 0, 0.11, 0.7}, 1050.0, 5e4},
      {LinearPolynomial{1.2, 10, 20, 30, 40, 0.4, 0.3, 0.2}, 2.0, 2e5},
      {IdealGas{1.4}, 3.0, 1e5},
      {StiffenedGas{4.4, 6e8}, 1000.0, 8e5},
      {Tait{}, 1020.0, 0.0}};
  for (const auto& [law, rho, e] : points) {
    const Response r = respond(law, rho, e);
    EXPECT_NEAR(r.by_density, numerical_slope(law, rho, e, true), 2e-5 * std::abs(r.by_density)) << law.index();
    EXPECT_NEAR(r.by_energy, numerical_slope(law, rho, e, false), 2e-5 * std::abs(r.by_energy)) << law.index();
  }
}

TEST(EquationOfState, WaterHasItsSoundSpeedAndItsHugoniotSlope) {
  const MieGrueneisen law{1000, 1480, 1.8, 0, 0, 0, 0};
  EXPECT_NEAR(std::sqrt(bulk_modulus(1000, law(1000, 0)) / 1000), 1480, 1e-9);
  // Without Grueneisen coefficient the pressure is that of the Hugoniot us = c + s up.
  const double particle = 200, shock = 1480 + 1.8 * particle, rho = 1000 * shock / (shock - particle);
  EXPECT_NEAR(law(rho, 0).pressure, 1000 * shock * particle, 1e-6 * 1000 * shock * particle);
}

TEST(EquationOfState, TaitWaterHasTheSoundSpeedOfItsStiffness) {
  EXPECT_NEAR(std::sqrt(bulk_modulus(1000, Tait{}(1000, 5e4)) / 1000), std::sqrt(7.15 * 3.31e8 / 1000), 1e-9);
  EXPECT_NEAR(Tait{}(density_at(Tait{}, 4e7, 0, 1000), 0).pressure, 4e7, 1e-5);
}

TEST(EquationOfState, AirOfTheCardIsAnIdealGas) {
  const LinearPolynomial air{};
  const double e = 2.533e5 / 1.2;
  EXPECT_NEAR(air(1.2, e).pressure, 101320, 1e-6);
  EXPECT_NEAR(air(3.0, e).pressure, IdealGas{1.4}(3.0, e).pressure, 1e-6);
}

TEST(EquationOfState, DensityAndEnergyInvertThePressure) {
  const EquationOfState water_law = MieGrueneisen{}, gas = IdealGas{};
  EXPECT_NEAR(respond(water_law, density_at(water_law, 5e7, 0, 1000), 0).pressure, 5e7, 1e-5);
  EXPECT_NEAR(respond(gas, 2.0, energy_at(gas, 2.0, 3e5)).pressure, 3e5, 1e-9);
}

TEST(EquationOfState, HotTracesOfWaterInAirLetNoWaveOutrunThoseOfWater) {
  const EquationOfState law = MieGrueneisen{};
  // Met in a cell that ice had closed: nearly all air, and a trace of water at its pressure, heated by work.
  const double density = 0.0045, energy = energy_at(law, density, 1e5);
  const Response r = respond(law, density, energy);
  ASSERT_GT(std::sqrt(bulk_modulus(density, r) / density), 1e5);
  EXPECT_LT(point_state(law, 2339.0, density, energy * density, 1.0).sound_speed, 1480.0 * 1.001);
  EXPECT_NEAR(point_state(law, 2339.0, 1000.0, 0.0, 1.0).sound_speed, 1480.0, 1e-9);
  EXPECT_NEAR(point_state(law, 2339.0, 970.0, 2e3, 1.0).sound_speed,
              std::sqrt(bulk_modulus(970.0, respond(law, 970.0, 2e3 / 970.0)) / 970.0), 1e-9);
  const double thin = 1e-4;  // gases have theirs at any density
  EXPECT_NEAR(point_state(LinearPolynomial{}, 0.0, thin, 2e5 * thin, 1.0).sound_speed, std::sqrt(1.4 * 0.4 * 2e5),
              1e-6);
}

TEST(PressureEquilibrium, ConservesMassVolumeAndTotalEnergy) {
  const std::array<EquationOfState, 2> law{MieGrueneisen{}, LinearPolynomial{}};
  const std::array<double, 2> floor{2339, 0};
  for (const double air_part : {1e-8, 1e-3, 0.3, 0.9, 0.9999}) {
    for (const double water_density : {985.0, 999.99, 1000.05, 1010.0}) {
      for (const double air_density : {0.3, 1.2, 30.0}) {
        const double volume = 8e-9;
        Mixture m;
        m.volume = {volume * (1 - air_part), volume * air_part};
        m.mass = {water_density * m.volume[0], air_density * m.volume[1]};
        m.energy = {m.mass[0] * 100.0, m.mass[1] * 2.1e5};
        const double energy = m.energy[0] + m.energy[1];
        const PointState state = equilibrate(law, floor, m);
        EXPECT_NEAR(m.energy[0] + m.energy[1], energy, 1e-12 * energy);
        EXPECT_NEAR(m.volume[0] + m.volume[1], volume, 1e-14 * volume);
        EXPECT_GT(m.volume[0], 0);
        EXPECT_GT(m.volume[1], 0);
        EXPECT_GT(m.energy[1], 0);
        const double p0 = point_state(law[0], floor[0], m.mass[0], m.energy[0], m.volume[0]).pressure;
        const double p1 = point_state(law[1], floor[1], m.mass[1], m.energy[1], m.volume[1]).pressure;
        // Round-off of the water's density alone is worth a few microbars.
        EXPECT_NEAR(p0, p1, 1e-6 * (p0 + p1) + 10.0) << air_part << ' ' << water_density << ' ' << air_density;
        EXPECT_GE(state.pressure, 0.0);
      }
    }
  }
}

TEST(PressureEquilibrium, LeavesAnEquilibriumAlone) {
  const std::array<EquationOfState, 2> law{MieGrueneisen{}, LinearPolynomial{}};
  Mixture m;
  m.volume = {3e-9, 5e-9};
  const double p = 101325, e = 2.533e5 / 1.2;
  m.mass = {density_at(law[0], p, 0, 1000) * m.volume[0], density_at(law[1], p, e, 1.2) * m.volume[1]};
  m.energy = {0, m.mass[1] * e};
  const Mixture before = m;
  const PointState state = equilibrate(law, {2339, 0}, m);
  EXPECT_NEAR(state.pressure, p, 1e-4);
  EXPECT_NEAR(m.volume[1], before.volume[1], 1e-14 * before.volume[1]);
}

TEST(PressureEquilibrium, GasThatExpandsKeepsItsEntropyAndTheOtherIsHeated) {
  const std::array<EquationOfState, 2> law{IdealGas{1.4}, IdealGas{1.667}};
  const std::array<double, 2> gamma{1.4, 1.667};
  for (const int high : {0, 1}) {
    for (const double part : {1e-6, 0.05, 0.7, 0.999}) {
      for (const double ratio : {1.001, 10.0, 2500.0}) {
        Mixture m;
        m.volume = {part, 1 - part};
        m.mass = {part, 0.5 * (1 - part)};
        const std::array<double, 2> pressure{high == 0 ? ratio : 1.0, high == 0 ? 1.0 : ratio};
        for (int k = 0; k < 2; ++k) m.energy[k] = pressure[k] * m.volume[k] / (gamma[k] - 1);
        const double energy = m.energy[0] + m.energy[1];
        const auto entropy = [&](int k) {  // p V^gamma
          return point_state(law[k], 0, m.mass[k], m.energy[k], m.volume[k]).pressure * std::pow(m.volume[k], gamma[k]);
        };
        const std::array<double, 2> before{entropy(0), entropy(1)};
        equilibrate(law, {0, 0}, m);
        EXPECT_NEAR(m.energy[0] + m.energy[1], energy, 1e-14 * energy);
        EXPECT_NEAR(entropy(high), before[high], 1e-9 * before[high]) << part << ' ' << ratio;
        EXPECT_GT(entropy(1 - high), before[1 - high] * (ratio > 2 ? 1 + 1e-9 : 1 - 1e-9)) << part << ' ' << ratio;
        const double p0 = point_state(law[0], 0, m.mass[0], m.energy[0], m.volume[0]).pressure;
        const double p1 = point_state(law[1], 0, m.mass[1], m.energy[1], m.volume[1]).pressure;
        EXPECT_NEAR(p0, p1, 1e-9 * p0) << part << ' ' << ratio;
      }
    }
  }
}

TEST(PressureEquilibrium, SharesOfAChangeKeepThePressuresTogether) {
  const std::array<EquationOfState, 2> law{MieGrueneisen{}, LinearPolynomial{}};
  Mixture m;
  m.volume = {5e-9, 5e-9};
  m.mass = {1000.045 * m.volume[0], 1.2 * m.volume[1]};
  m.energy = {0, m.mass[1] * 2.533e5 / 1.2};
  const auto share = volume_shares(law, {2339, 0}, m, -1e-11);
  EXPECT_NEAR(share[0] + share[1], 1.0, 1e-15);
  EXPECT_LT(share[0], 1e-3);  // water is 15,000 times stiffer
}
