#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "core/contact/penalty_contact.hpp"
#include "core/continuum/explicit_solid.hpp"
#include "tests/core/contact/bodies.hpp"

namespace polynya::contact::testing {
namespace {

// Verification case 265 of a commercial code: 30e6 psi, 7.3e-4 lbf s^2/in^4, 10 in, 0.01 in above the wall, 202.2 in/s.
constexpr double youngs_modulus = 206.843e9, density = 7801.35, length = 0.254, gap = 0.254e-3, speed = 5.13588;
constexpr int elements = 200;

/// A square rod of `elements` cubes that falls along z, without Poisson's effect: waves are those of one dimension.
continuum::ExplicitSolid falling_rod() {
  const double side = length / elements;
  continuum::HexMesh mesh;
  for (int k = 0; k <= elements; ++k)
    for (const auto& [x, y] : {std::array{0, 0}, {1, 0}, {1, 1}, {0, 1}})
      mesh.nodes.insert(mesh.nodes.end(), {x * side, y * side, gap + k * side});
  for (int k = 0; k < elements; ++k)
    for (int v = 0; v < 8; ++v) mesh.elements.push_back(4 * k + v);
  auto rod = continuum::make_solid("rod", mesh, continuum::Elastic{density, youngs_modulus / 3, youngs_modulus / 2});
  for (std::size_t n = 0; n < rod.node_count(); ++n) rod.velocities[3 * n + 2] = -speed;
  return rod;
}

struct Passage {
  double impact = 0, release = 0;  // s
  double stress = 0;               // Pa, in the middle while the first wave has passed it
  double rebound = 0;              // m/s
};

Passage strike(const ContactLaw& law) {
  auto rod = falling_rod();
  Mesh wall = floor_of(2), foot;
  for (std::size_t n = 0; n < 4; ++n) foot.add_point(row(rod.positions, n), row(rod.velocities, n), rod.masses[n]);
  foot.triangles = {0, 2, 1, 0, 3, 2};
  PenaltyContact contact(law);
  contact.set_topology(wall.body(), foot.body());
  const double dt = 0.9 * continuum::stable_step(rod), wave = std::sqrt(youngs_modulus / density);
  std::vector<double> force(3 * rod.node_count(), 0.0);
  continuum::internal_forces(rod, 0);
  continuum::advance_velocities(rod, force, 0, dt);
  Passage passage;
  int samples = 0;
  while (rod.time < gap / speed + 3 * length / wave) {
    continuum::advance_positions(rod, dt);
    for (std::size_t i = 0; i < 12; ++i) foot.positions[i] = rod.positions[i], foot.velocities[i] = rod.velocities[i];
    const ContactForces& forces = contact.evaluate(wall.body(), foot.body(), dt);
    double total = 0;
    for (std::size_t i = 0; i < 12; ++i) force[i] = forces.secondary[i];
    for (std::size_t n = 0; n < 4; ++n) total += force[3 * n + 2];
    if (total > 0 && passage.impact == 0) passage.impact = rod.time;
    if (total > 0) passage.release = rod.time;
    const double since = (rod.time - gap / speed) * wave / length;
    if (since > 0.7 && since < 1.3) {
      passage.stress -= rod.element.stress[2][elements / 2];
      ++samples;
    }
    continuum::internal_forces(rod, dt);
    continuum::advance_velocities(rod, force, dt, dt);
  }
  double mass = 0, momentum = 0;
  for (std::size_t n = 0; n < rod.node_count(); ++n) {
    mass += rod.masses[n];
    momentum += rod.masses[n] * rod.velocities[3 * n + 2];
  }
  passage.stress /= samples;
  passage.rebound = momentum / mass;
  return passage;
}

// A stiff contact: at the default factor, 0.1, the spring takes sixteen crossing times of an element to answer, and the
// release is late by 4 %.
TEST(ElasticRod, MeetsARigidWallStaysTwoWaveTimesAndLeavesWithItsSpeed) {
  const Passage passage = strike(ContactLaw{.stiffness_factor = 1.0});
  const double wave = std::sqrt(youngs_modulus / density), impact = gap / speed, duration = 2 * length / wave;
  std::printf("impact %.4e s (exact %.4e), release %.4e s (%.4e), stress %.4e Pa (%.4e), rebound %.4f m/s (%.4f)\n",
              passage.impact, impact, passage.release, impact + duration, passage.stress, density * wave * speed,
              passage.rebound, speed);
  EXPECT_NEAR(passage.impact / impact, 1, 0.01);
  EXPECT_NEAR((passage.release - passage.impact) / duration, 1, 0.01);
  EXPECT_NEAR(passage.release / (impact + duration), 1, 0.01);
  EXPECT_NEAR(passage.stress / (density * wave * speed), 1, 0.01);
  EXPECT_NEAR(passage.rebound / speed, 1, 0.01);
}

}  // namespace
}  // namespace polynya::contact::testing
