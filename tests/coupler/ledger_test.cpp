#include "coupler/ledger.hpp"

#include <gtest/gtest.h>

using namespace polynya::coupler;

namespace {

SolidSide one_vertex(std::int64_t id, double speed) {
  SolidSide side;
  side.name = "ice";
  side.body = Body::ice;
  side.ids = {id};
  side.positions = {0, 0, 0};
  side.velocities = {0, 0, speed};
  side.contact_force = {0, 0, 3};
  side.fluid_force = {0, 0, -1};
  side.fluid_impulse = {0, 0, 0};
  side.masses = side.radii = side.volumes = {0};
  return side;
}

}  // namespace

TEST(WorkMeter, ForceWorksWithTheMeanOfTheVelocitiesAroundIt) {
  Ledger ledger;
  WorkMeter meter;
  meter.remember(one_vertex(5, 2.0), 0.1);
  meter.settle(one_vertex(5, 4.0), ledger);
  EXPECT_DOUBLE_EQ(ledger.contact_work[1], 3 * 3.0 * 0.1);
  EXPECT_DOUBLE_EQ(ledger.fluid_work[1], -1 * 3.0 * 0.1);
}

TEST(WorkMeter, VanishedVertexWorksWithItsLastVelocity) {
  Ledger ledger;
  WorkMeter meter;
  meter.remember(one_vertex(5, 2.0), 0.1);
  SolidSide after = one_vertex(6, 9.0);
  after.topology_changed = true;
  meter.settle(after, ledger);
  EXPECT_DOUBLE_EQ(ledger.contact_work[1], 3 * 2.0 * 0.1);
}

TEST(SolidSide, ImpulseOfAVanishedVertexGoesToTheNearestOne) {
  SolidSide side = one_vertex(1, 0);
  side.ids = {7, 8};
  side.positions = {0, 0, 0, 1, 0, 0};
  side.fluid_impulse.assign(6, 0.0);
  const std::int64_t ids[] = {7, 9};
  const double positions[] = {0, 0, 0, 0.9, 0, 0}, impulses[] = {1, 2, 3, 10, 20, 30};
  add_fluid_impulses(side, ids, positions, impulses);
  EXPECT_EQ(side.fluid_impulse, (std::vector<double>{1, 2, 3, 10, 20, 30}));
}
