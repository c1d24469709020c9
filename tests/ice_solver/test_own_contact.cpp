#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/ice_solver/ice_bodies.hpp"

namespace polynya::ice {
namespace {

using namespace testing;

constexpr double size = 0.002;

IceOptions bar_options(bool own_contact) {
  IceOptions options = block_options(12, 4, 4, size);
  options.own_contact = own_contact;
  return options;
}

/// A bar whose one end element has become a particle, which now hovers over the other end.
struct Thrown {
  IceBody ice;
  double dt;
  double radius = 0.5 * size;

  explicit Thrown(bool own_contact, double gap, double speed)
      : ice(make_ice(bar_options(own_contact))), dt(start(ice)) {
    const auto corner =
        elements_where(ice, [](const auto& x) { return x[0] < size && x[1] < size && x[2] > 3 * size; });
    convert_elements(ice, corner);
    Points& p = ice.particles.points;
    p.position = {10.2 * size, 2.1 * size, 4 * size + radius + gap};
    p.velocity = {0, 0, -speed};
  }
};

TEST(OwnContact, ParticleBouncesOffIntactIceThatIsNotItsOrigin) {
  Thrown thrown(true, 1e-5, 5);
  IceBody& ice = thrown.ice;
  const std::array<double, 3> momentum = momentum_of(ice);
  double dt = advance(ice, thrown.dt);
  const double balance = account_of(ice).balance(), kinetic = account_of(ice).kinetic;
  double largest = 0, lowest = 1;
  for (int n = 0; n < 200; ++n) {
    dt = advance(ice, dt);
    largest = std::max(largest, std::abs(account_of(ice).balance() - balance));
    lowest = std::min(lowest, ice.particles.points.position[2]);
  }
  EXPECT_GT(ice.particles.points.velocity[2], 1);  // the ice keeps some of the energy as waves
  EXPECT_GT(lowest, 4 * size);
  EXPECT_LT(largest, 1e-3 * kinetic);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(momentum_of(ice)[c], momentum[c], 1e-10 * std::abs(momentum[2]));
}

TEST(OwnContact, ParticleFeelsOtherIceOnlyWhenTheyTouch) {
  // Within the reach of the sums, but its surface a twentieth of an element away.
  for (const bool own_contact : {true, false}) {
    Thrown near(own_contact, 0.05 * size, 0);
    IceBody& ice = near.ice;
    // In the sums a particle that approaches feels the artificial viscosity, however far its surface is.
    ice.particles.points.velocity[2] = -1;
    advance_positions(ice, near.dt);
    internal_forces(ice, near.dt);
    const double force = std::abs(ice.particles.points.force[2]);
    if (own_contact)
      EXPECT_EQ(force, 0);
    else
      EXPECT_GT(force, 0);
  }
}

TEST(OwnContact, LeavesTheBondOfAParticleToItsOriginAlone) {
  // One element in the middle of the bar is converted; with and without own contact its forces agree to rounding: the
  // sums only miss neighbours that lie in the skin of the list.
  std::vector<double> forces[2];
  for (const bool own_contact : {false, true}) {
    IceBody ice = make_ice(bar_options(own_contact));
    for (std::size_t n = 0; n < ice.solid.node_count(); ++n)
      ice.solid.velocities[3 * n] = 10 * std::sin(700 * ice.solid.positions[3 * n]);
    double dt = start(ice);
    convert_elements(ice, elements_where(ice, [](const auto& x) {
                       return x[0] > 6 * size && x[0] < 7 * size && x[1] > 2 * size && x[1] < 3 * size &&
                              x[2] > 3 * size;
                     }));
    for (int n = 0; n < 30; ++n) dt = advance(ice, dt);
    forces[own_contact] = ice.particles.points.force;
  }
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(forces[0][k], forces[1][k], 1e-9 * std::abs(forces[0][k]));
}

TEST(OwnContact, FacesOnBothSidesOfAGapDoNotPassThroughEachOther) {
  // A column of elements across the bar is taken far away; the two parts move towards each other.
  const auto least_gap = [](bool own_contact) {
    IceBody ice = make_ice(bar_options(own_contact));
    double dt = start(ice);
    convert_elements(ice, elements_where(ice, [](const auto& x) { return x[0] > 6 * size && x[0] < 7 * size; }));
    for (std::size_t k = 0; k < ice.particles.points.position.size(); ++k)
      ice.particles.points.position[k] += 10 + 0.1 * static_cast<double>(k);
    for (std::size_t n = 0; n < ice.solid.node_count(); ++n)
      ice.solid.velocities[3 * n] = ice.solid.mesh.nodes[3 * n] < 6.5 * size ? 20 : -20;
    double least = 1;
    for (int n = 0; n < 600; ++n) {
      dt = advance(ice, dt);
      double left = -1, right = 1;
      for (std::size_t v = 0; v < ice.solid.node_count(); ++v) {
        const double at = ice.solid.mesh.nodes[3 * v], x = ice.solid.positions[3 * v];
        if (std::abs(at - 6 * size) < 1e-9) left = std::max(left, x);
        if (std::abs(at - 7 * size) < 1e-9) right = std::min(right, x);
      }
      least = std::min(least, right - left);
    }
    return least;
  };
  EXPECT_LT(least_gap(false), -0.5 * size);
  EXPECT_GT(least_gap(true), -0.1 * size);
}

}  // namespace
}  // namespace polynya::ice
