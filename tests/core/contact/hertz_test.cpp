#include <gtest/gtest.h>

#include "tests/core/contact/hertz.hpp"

using namespace polynya::contact;
using namespace polynya::contact::testing;

namespace {

constexpr double modulus = hertz_youngs_modulus / (1 - hertz_poisson_ratio * hertz_poisson_ratio);
constexpr ContactLaw stiff{.friction = 0, .damping = 0, .stiffness_factor = 1, .depth_limit = 0.01, .skin = 0.01};

void expect_hertz(const Impact& impact, double speed, double tolerance) {
  const HertzImpact hertz(modulus, speed);
  std::printf("restitution %.5f, duration %.4f and peak force %.4f of Hertz's\n", impact.restitution,
              impact.duration / hertz.duration, impact.peak_force / hertz.peak_force);
  EXPECT_NEAR(impact.restitution, 1, 0.01);
  EXPECT_NEAR(impact.duration, hertz.duration, tolerance * hertz.duration);
  EXPECT_NEAR(impact.peak_force, hertz.peak_force, tolerance * hertz.peak_force);
}

}  // namespace

// Two equal spheres that meet, cut at the plane between them. Hertz's theory is that of slow impacts: contact radius
// and the time of waves small. At 1e-3 of sqrt(E/rho) the peak force tends to 1.04 of Hertz's as the mesh is refined,
// at 1e-4 to 1.00.
TEST(Hertz, SpheresThatMeetSlowlyPartAsHertzSays) {
  expect_hertz(sphere_on_plane(2, 0.8, stiff, 3e-4), 3e-4, 0.03);
}

TEST(Hertz, EnergiesOfAnImpactWithFrictionAndDampingAddUp) {
  const ContactLaw law{.friction = 0.3, .damping = 0.1, .stiffness_factor = 0.3, .depth_limit = 0.01, .skin = 0.01};
  const Impact impact = sphere_on_plane(2, 0.8, law, 3e-4, 1e-4);
  std::printf("work of the contact %.4f, error of its account %.2e of the energy of the impact\n", impact.lost,
              impact.account_error);
  EXPECT_GT(impact.lost, 0.02);
  EXPECT_LT(impact.account_error, 1e-3);
}

TEST(HertzLong, DurationAndPeakForceConvergeToHertz) {
  const double speed = 1e-4;
  const HertzImpact hertz(modulus, speed);
  double last = 1;
  for (const double elements : {2.0, 3.0, 4.0}) {
    const Impact impact = sphere_on_plane(elements, 0.8, stiff, speed);
    expect_hertz(impact, speed, 0.03);
    const double error = std::abs(impact.duration / hertz.duration - 1);
    EXPECT_LT(error, last);
    last = error;
  }
  EXPECT_LT(last, 0.015);
}

namespace {

/// Two bodies that both give way, with meshes that do not match, each looked at from both sides.
void expect_hertz_of_two(double elements, double stiffness_factor) {
  const double speed = 3e-4;
  ContactLaw law = stiff;
  law.stiffness_factor = stiffness_factor;
  law.mirror = {true, true};
  law.two_way = law.edges = true;
  const Impact impact = sphere_on_sphere({elements, 1.25 * elements}, 0.6, law, speed);
  expect_hertz(impact, speed, 0.03);
  EXPECT_LT(std::abs(impact.momentum_gained), 1e-12);
}

}  // namespace

TEST(HertzLong, TwoMeshedSpheresThatMeetSlowlyPartAsHertzSays) {
  expect_hertz_of_two(2, 0.3);
}

// The penalty gives way by a part of an element, so the default stiffness needs smaller ones.
TEST(HertzLong, TwoMeshedSpheresPartSoWithTheDefaultStiffnessToo) {
  expect_hertz_of_two(3, 0.1);
}
