// A contact that was saved and loaded goes on with the same bits: friction that sticks and slides, edges, damping.
#include <gtest/gtest.h>

#include "tests/core/contact/bodies.hpp"
#include "tests/core/results/state_bits.hpp"

using namespace polynya::contact;
using namespace polynya::contact::testing;

namespace {

constexpr double dt = 1e-4;

/// A box that is pressed on a floor and drawn along it, ever harder: it sticks, then slides.
struct Drawn {
  Mesh floor = floor_of(1, 9), box = box_of({-0.11, -0.07, 1e-9}, {0.12, 0.09, 0.2}, 3, 1.0);
  double friction_loss = 0, damping_loss = 0, stored = 0, released = 0;
  int steps = 0;

  Drawn() { box.set_velocity({0, 0, -0.001}); }
  void advance(PenaltyContact& contact, int count) {
    for (int n = 0; n < count; ++n, ++steps) {
      const ContactForces& forces = contact.evaluate(floor.body(), box.body(), dt);
      friction_loss += forces.friction_loss;
      damping_loss += forces.damping_loss;
      released += forces.released_energy;
      stored = forces.stored_energy;
      kick(box, forces.secondary, dt, {0.02 * steps, 0.01 * steps, -10});
      box.drift(dt);
    }
  }
};

}  // namespace

TEST(Checkpoint, ContactGoesOnWithTheSameBitsFromAnchorsThatStick) {
  const ContactLaw law{.friction = 0.3,
                       .damping = 0.2,
                       .stiffness_factor = 0.1,
                       .depth_limit = 0.05,
                       .skin = 0.002,
                       .mirror = {},
                       .two_way = true,
                       .edges = true};
  Drawn whole;
  PenaltyContact contact(law);
  contact.set_topology(whole.floor.body(), whole.box.body());
  whole.advance(contact, 120);
  ASSERT_GT(whole.stored, 0);
  const double slid = whole.friction_loss;
  Drawn resumed = whole;
  PenaltyContact loaded{ContactLaw{}};
  polynya::testing::carry_over(contact, loaded);
  whole.advance(contact, 200);
  resumed.advance(loaded, 200);
  EXPECT_EQ(whole.box.positions, resumed.box.positions);
  EXPECT_EQ(whole.box.velocities, resumed.box.velocities);
  for (const double Drawn::*sum : {&Drawn::friction_loss, &Drawn::damping_loss, &Drawn::stored, &Drawn::released})
    EXPECT_EQ(whole.*sum, resumed.*sum);
  EXPECT_GT(whole.friction_loss, slid);  // it has begun to slide
  EXPECT_EQ(contact.searches(), loaded.searches());
}
