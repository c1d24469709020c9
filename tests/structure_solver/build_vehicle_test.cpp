#include <gtest/gtest.h>

#include <stdexcept>

#include "structure_solver/build_vehicle.hpp"
#include "tests/structure_solver/test_scene.hpp"

namespace polynya::structure {
namespace {

constexpr scene::Symmetry symmetries[] = {scene::Symmetry::quarter, scene::Symmetry::half, scene::Symmetry::full};

TEST(BuildVehicle, HollowVehicleHasTheRequestedMassToRounding) {
  for (const scene::Symmetry symmetry : symmetries)
    for (const double size : {2e-3, 1.2e-3}) {
      scene::Scene scene = vehicle_scene();
      scene.symmetry = symmetry;
      scene.resolution.vehicle_element = size;
      const BuiltVehicle vehicle = build_vehicle(scene);
      EXPECT_NEAR(vehicle.whole_mass / 0.005, 1, 1e-12);
      EXPECT_EQ(vehicle.density, 2700);
      EXPECT_GT(vehicle.mesh.wall_thickness, 0.5e-3);
      EXPECT_LT(vehicle.mesh.wall_thickness, 0.7e-3);
      EXPECT_EQ(vehicle.body->account().mass, vehicle.mass);
    }
}

TEST(BuildVehicle, SolidVehicleCarriesBallastToMeetAMass) {
  scene::Scene scene = solid_scene();
  scene.vehicle->mass = 0.021;
  const BuiltVehicle vehicle = build_vehicle(scene);
  EXPECT_NEAR(vehicle.whole_mass / 0.021, 1, 1e-12);
  EXPECT_NEAR(vehicle.density * 4 * vehicle.quality.volume / 0.021, 1, 1e-12);
}

TEST(BuildVehicle, MassWithoutAWishIsThatOfTheExactShapeAtEveryResolution) {
  const geometry::Meridian outline(geometry::HeadShape::ogive, 0.01, 0.01, 0.1);
  for (const double size : {2e-3, 1e-3}) {
    scene::Scene scene = solid_scene();
    scene.resolution.vehicle_element = size;
    EXPECT_NEAR(build_vehicle(scene).whole_mass / (2700 * geometry::enclosed_volume(outline)), 1, 1e-12);
    scene.vehicle->interior = "hollow";
    scene.vehicle->wall_thickness = 0.8e-3;
    const double shell =
        geometry::enclosed_volume(outline) - geometry::enclosed_volume(geometry::InnerOutline(outline, 0.8e-3));
    EXPECT_NEAR(build_vehicle(scene).whole_mass / (2700 * shell), 1, 1e-12);
  }
}

TEST(BuildVehicle, RigidAndDeformableVehiclesStartAlike) {
  for (const scene::Symmetry symmetry : symmetries) {
    scene::Scene scene = vehicle_scene();
    scene.symmetry = symmetry;
    const Account elastic = build_vehicle(scene).body->account();
    scene.vehicle->deformable = false;
    const Account rigid = build_vehicle(scene).body->account();
    EXPECT_NEAR(elastic.mass / rigid.mass, 1, 1e-13);
    EXPECT_NEAR(elastic.kinetic / rigid.kinetic, 1, 1e-12);
    EXPECT_NEAR(elastic.kinetic, 0.5 * elastic.mass * 1600, 1e-12);
    EXPECT_NEAR(elastic.momentum[2] / rigid.momentum[2], 1, 1e-12);
    EXPECT_NEAR(elastic.centre_of_mass_z / rigid.centre_of_mass_z, 1, 1e-12);
    EXPECT_EQ(elastic.head_stress, 0);
  }
}

TEST(BuildVehicle, WrongInputIsRefused) {
  scene::Scene scene = vehicle_scene();
  scene.materials["aluminium"].law = "mie_grueneisen";
  EXPECT_THROW(build_vehicle(scene), std::invalid_argument);
  scene = vehicle_scene();
  scene.vehicle->mass = 0.5;
  EXPECT_THROW(build_vehicle(scene), std::invalid_argument);
  scene = vehicle_scene();
  scene.vehicle.reset();
  EXPECT_THROW(build_vehicle(scene), std::invalid_argument);
}

}  // namespace
}  // namespace polynya::structure
