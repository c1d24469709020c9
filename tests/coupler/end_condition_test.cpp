#include "coupler/end_condition.hpp"

#include <gtest/gtest.h>

using namespace polynya;

namespace {

scene::Scene thin_ice() {
  scene::Scene scene;
  scene.run.end = "ice_passed";
  scene.run.end_time = 1e-3;
  scene.vehicle.emplace();
  scene.vehicle->diameter = 0.01;
  scene.vehicle->length = 0.1;
  scene.vehicle->head_length = 0.01;
  scene.ice.emplace();
  scene.ice->thickness = 0.01;
  return scene;
}

}  // namespace

TEST(EndCondition, IcePassedWhenTheCylinderIsADiameterAboveTheIce) {
  const scene::Scene scene = thin_ice();
  EXPECT_EQ(coupler::end_reason(scene, 0, 0.0299, 40), "");
  EXPECT_EQ(coupler::end_reason(scene, 0, 0.0301, 40), "ice_passed");
}

TEST(EndCondition, ExitedWhenTheTailIsAboveTheIce) {
  scene::Scene scene = thin_ice();
  scene.run.end = "exited";
  EXPECT_EQ(coupler::end_reason(scene, 0, 0.109, 40), "");
  EXPECT_EQ(coupler::end_reason(scene, 0, 0.111, 40), "exited");
}

TEST(EndCondition, ExitedWithoutIceWhenTheTailIsAboveTheWaterline) {
  scene::Scene scene = thin_ice();
  scene.run.end = "exited";
  scene.ice.reset();
  scene.fluid.emplace().waterline = 0.02;
  EXPECT_EQ(coupler::end_reason(scene, 0, 0.119, 40), "");
  EXPECT_EQ(coupler::end_reason(scene, 0, 0.121, 40), "exited");
  EXPECT_EQ(coupler::end_reason(scene, 0, 0.05, -1), "");  // it falls back and may rise again
  EXPECT_NEAR(coupler::time_to_event(scene, 0.1, 40), 0.02 / 40, 1e-15);
}

TEST(EndCondition, NothingButTimeEndsTheFlightOfAVehicleAlone) {
  scene::Scene scene = thin_ice();
  scene.run.end = "exited";
  scene.ice.reset();
  EXPECT_EQ(coupler::end_reason(scene, 0, 100, 40), "");
  EXPECT_GT(coupler::time_to_event(scene, 100, 40), 1e300);
  EXPECT_EQ(coupler::end_reason(scene, 1e-3, 100, 40), "time");
}

TEST(EndCondition, StoppedVehicleAndLatestTimeEndEveryRun) {
  const scene::Scene scene = thin_ice();
  EXPECT_EQ(coupler::end_reason(scene, 0, 0, -0.1), "vehicle_stopped");
  EXPECT_EQ(coupler::end_reason(scene, 1e-3, 0, 40), "time");
}

TEST(EndCondition, NothingEndsTheRunBeforeTheTimeThatIsForetold) {
  scene::Scene scene = thin_ice();
  scene.run.gravity = 9.81;
  EXPECT_NEAR(coupler::time_to_event(scene, 0.01, 40), 0.02 / 40, 1e-15);      // a diameter above the ice
  EXPECT_NEAR(coupler::time_to_event(scene, 0.01, 1e-3), 1e-3 / 9.81, 1e-15);  // weight stops it before
  EXPECT_EQ(coupler::time_to_event(scene, 0.05, 40), 0);
}
