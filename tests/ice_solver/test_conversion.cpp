#include <gtest/gtest.h>

#include "ice_solver/ice_surface.hpp"
#include "tests/ice_solver/ice_bodies.hpp"
#include "tests/ice_solver/lattice.hpp"

namespace polynya::ice {
namespace {

using namespace testing;

/// A block in violent motion, a few steps on its way.
IceBody shaken_block(continuum::Integration integration = continuum::Integration::one_point) {
  IceOptions options = block_options(6, 5, 4, 0.002, brittle_ice());
  options.numerics.integration = integration;
  IceBody ice = make_ice(options);
  Noise noise;
  for (double& v : ice.solid.velocities) v = 5 * noise();
  double dt = start(ice);
  for (int step = 0; step < 20; ++step) dt = advance(ice, dt);
  return ice;
}

double kinetic_at_half_step(const IceBody& ice) {
  double sum = 0;
  for (std::size_t k = 0; k < ice.solid.velocities.size(); ++k)
    sum += 0.5 * ice.solid.masses[k / 3] * ice.solid.velocities[k] * ice.solid.velocities[k];
  const Points& points = ice.particles.points;
  for (std::size_t k = 0; k < points.velocity.size(); ++k)
    sum += 0.5 * points.mass[k / 3] * points.velocity[k] * points.velocity[k];
  return sum;
}

TEST(Conversion, KeepsMassAndLinearMomentumAndBooksLostMotionAsHeat) {
  IceBody ice = shaken_block();
  const double mass = mass_of(ice), kinetic = kinetic_at_half_step(ice), balance = account_of(ice).balance();
  const auto momentum = momentum_of(ice);
  const auto chosen = elements_where(ice, [](const auto& x) { return x[0] + x[2] < 0.008; });
  ASSERT_GT(chosen.size(), 20u);
  convert_elements(ice, chosen);

  EXPECT_NEAR(mass_of(ice), mass, 1e-12 * mass);
  const auto after = momentum_of(ice);
  const double scale = std::sqrt(2 * kinetic * mass);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(after[c], momentum[c], 1e-12 * scale);
  EXPECT_GT(ice.books.conversion_heat, 0);
  EXPECT_NEAR(kinetic_at_half_step(ice) + ice.books.conversion_heat, kinetic, 1e-12 * kinetic);
  EXPECT_NEAR(account_of(ice).balance(), balance, 1e-12 * kinetic);
  EXPECT_DOUBLE_EQ(account_of(ice).broken_mass, static_cast<double>(chosen.size()) * 900 * 8e-9);
}

void expect_state_handed_on(IceBody ice) {
  const std::size_t e = 37;
  const auto state = continuum::point_state(ice.solid, e);
  const auto centre = continuum::element_centre(ice.solid, e);
  const auto gradient = continuum::velocity_gradient(ice.solid, e);
  const std::int32_t chosen[] = {static_cast<std::int32_t>(e)};
  convert_elements(ice, chosen);
  const Particles& p = ice.particles;
  ASSERT_EQ(p.count(), 1u);
  EXPECT_EQ(p.element[0], 37);
  for (std::size_t c = 0; c < 6; ++c) EXPECT_EQ(p.points.stress[c], state.stress[c]);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(p.points.position[c], centre[c]);
  for (std::size_t c = 0; c < 9; ++c) EXPECT_EQ(p.velocity_gradient[c], gradient[c]);
  EXPECT_EQ(p.damage[0], state.damage);
  EXPECT_EQ(p.plastic_strain[0], state.plastic_strain);
  EXPECT_DOUBLE_EQ(p.points.density[0], 900 / state.relative_volume);
  EXPECT_NEAR(p.points.smoothing_length[0], 1.2 * 0.002 * std::cbrt(state.relative_volume), 1e-15);
}

TEST(Conversion, HandsTheStateOfTheElementToTheParticle) {
  expect_state_handed_on(shaken_block());
}

TEST(Conversion, HandsTheMeanOverThePointsOfAFullyIntegratedElementToTheParticle) {
  const IceBody ice = shaken_block(continuum::Integration::full);
  double mean = 0;
  for (const auto& point : ice.solid.points) mean += point.stress[0][37] / 8;
  EXPECT_NEAR(continuum::point_state(ice.solid, 37).stress[0], mean, 1e-12 * std::abs(mean));
  expect_state_handed_on(ice);
}

TEST(Conversion, BooksTheAngularMomentumThatOneParticleCannotCarry) {
  IceBody ice = make_ice(block_options(1, 1, 1, 0.002));
  for (std::size_t n = 0; n < 8; ++n) {  // rigid rotation about z through the centre at 100 rad/s
    ice.solid.velocities[3 * n] = -100 * (ice.solid.positions[3 * n + 1] - 0.001);
    ice.solid.velocities[3 * n + 1] = 100 * (ice.solid.positions[3 * n] - 0.001);
  }
  const std::int32_t chosen[] = {0};
  convert_elements(ice, chosen);
  const double mass = 900 * 8e-9;
  EXPECT_NEAR(ice.books.angular_momentum_defect[2], 100 * mass * 2 * 1e-6, 1e-12 * mass);
  EXPECT_NEAR(ice.books.conversion_heat, 0.5 * mass * 2e-6 * 1e4, 1e-12 * mass);
}

TEST(Conversion, TakesElementsPastTheCriticalStrainAndNoOthers) {
  IceOptions options = block_options(6, 2, 2, 0.002);
  options.conversion = true;
  IceBody ice = make_ice(options);
  // Uniaxial logarithmic strain e has the effective strain 2/3 e; the right half is stretched beyond 0.35.
  for (std::size_t n = 0; n < ice.solid.node_count(); ++n) {
    double& x = ice.solid.positions[3 * n];
    x = x <= 0.006 + 1e-9 ? x * std::exp(1.5 * 0.34)
                          : 0.006 * std::exp(1.5 * 0.34) + (x - 0.006) * std::exp(1.5 * 0.36);
  }
  EXPECT_EQ(convert_failed_elements(ice), 12u);
  EXPECT_EQ(ice.books.converted.strained, 12);
  EXPECT_EQ(ice.books.converted.collapsed, 0);
  EXPECT_TRUE(ice.topology_changed);
  for (std::size_t e = 0; e < ice.solid.element_count(); ++e)
    EXPECT_EQ(ice.solid.element.alive[e] != 0, continuum::element_centre(ice.solid, e)[0] < 0.006 * std::exp(0.51));
  EXPECT_EQ(convert_failed_elements(ice), 0u);
  EXPECT_FALSE(ice.topology_changed);
}

TEST(IceSurface, LosesTheNodesOfConvertedElementsAndGainsParticles) {
  IceOptions options = block_options(4, 4, 2, 0.002);
  options.planes = {true, true};
  IceBody ice = make_ice(options);
  const IceSurface before = surface_of(ice);
  EXPECT_EQ(before.vertex_count(), 25u * 2 + 4 + 5);               // top, bottom, and middle nodes of two lateral faces
  EXPECT_EQ(before.triangles.size() / 3, 2u * (16 + 16 + 8 + 8));  // none on the planes x = 0 and y = 0
  const auto corner = elements_where(ice, [](const auto& x) { return x[0] > 0.006 && x[1] > 0.006; });
  convert_elements(ice, corner);
  const IceSurface after = surface_of(ice);
  ASSERT_EQ(corner.size(), 2u);
  EXPECT_EQ(after.vertex_count() - after.nodes.size(), 2u);
  EXPECT_EQ(after.nodes.size(), before.nodes.size() - 3 + 1);  // corner edge gone, inner edge's middle node exposed
  for (std::size_t v = 0; v < after.nodes.size(); ++v) {
    EXPECT_EQ(after.ids[v], after.nodes[v]);
    EXPECT_GT(after.masses[v], 0);
    EXPECT_EQ(after.radii[v], 0);
  }
  EXPECT_EQ(after.ids.back(), static_cast<std::int64_t>(ice.solid.node_count()) + corner.back());
  EXPECT_DOUBLE_EQ(after.radii.back(), 0.001);
  EXPECT_NEAR(after.volumes.back(), 8e-9, 1e-22);
  // Outward orientation: the enclosed volume, with the planes closing it, is that of the living elements.
  std::vector<double> x, v;
  vertex_motion(ice, after.nodes, x, v);
  double volume = 0;
  for (std::size_t t = 0; t < after.triangles.size(); t += 3) {
    const double *a = &x[3 * static_cast<std::size_t>(after.triangles[t])],
                 *b = &x[3 * static_cast<std::size_t>(after.triangles[t + 1])],
                 *c = &x[3 * static_cast<std::size_t>(after.triangles[t + 2])];
    volume +=
        (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])) /
        6;
  }
  EXPECT_NEAR(volume, 30 * 8e-9, 1e-20);
}

}  // namespace
}  // namespace polynya::ice
