// Plates that are held at two ends, and motion that is damped.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/ice_solver/ice_bodies.hpp"

namespace polynya::ice {
namespace {

using namespace testing;

TEST(DampedPlate, LosesItsSpeedExponentiallyAndTheAccountHasWhatItLost) {
  IceOptions options = block_options(4, 2, 2, 0.01);
  options.damping = 500;
  IceBody plate = make_ice(options);
  for (std::size_t n = 0; n < plate.solid.node_count(); ++n) plate.solid.velocities[3 * n + 2] = 2;
  double dt = start(plate);
  const double balance = account_of(plate).balance(), mass = account_of(plate).mass;
  while (plate.solid.time < 2e-3) dt = advance(plate, dt);
  const double speed = plate.books.momentum[2] / mass;
  EXPECT_NEAR(speed / (2 * std::exp(-500 * (plate.solid.time + 0.5 * dt))), 1, 1e-5);
  EXPECT_NEAR(account_of(plate).boundary_flux, 0.5 * mass * (4 - speed * speed), 5e-3 * mass);
  EXPECT_NEAR(account_of(plate).balance(), balance, 1e-12 * mass);
}

TEST(PlateWithClampedEnds, BendsUnderItsWeightAsAPlateInPlaneStrain) {
  // A quarter of 1 m x 20 mm x 50 mm: stiffness E/(1 - nu^2), not E, and no dependence on y.
  const double length = 1, height = 0.05, k = 8.1254e9, g = 4.4444e9;
  IceOptions options;
  options.x = line(0, 0.5 * length, 40), options.y = line(0, 0.01, 1), options.z = line(0, height, 4);
  options.law = elastic_ice();
  options.conversion = false;
  options.planes = {true, true};
  options.sides = Sides::clamped_ends;
  options.damping = 2500;  // nearly critical for its gravest mode, 190 Hz
  options.gravity = 9.81;
  IceBody plate = make_ice(options);
  double dt = start(plate), least = 0, most = -1;
  while (plate.solid.time < 8e-3) dt = advance(plate, dt);
  for (std::size_t n = 0; n < plate.solid.node_count(); ++n) {
    const double* reference = &plate.solid.mesh.nodes[3 * n];
    if (reference[0] > 1e-9) continue;
    const double sinking = plate.solid.positions[3 * n + 2] - reference[2];
    least = std::min(least, sinking), most = std::max(most, sinking);
  }
  const double youngs_modulus = 9 * k * g / (3 * k + g), nu = youngs_modulus / (2 * g) - 1;
  const double load = 900 * 9.81 * height, stiffness = youngs_modulus * std::pow(height, 3) / 12 / (1 - nu * nu);
  const double bending = load * std::pow(length, 4) / (384 * stiffness),
               shear = load * length * length / (8 * 5. / 6 * g * height);
  std::printf("middle sinks by %.4g to %.4g m; plate %.4g m, with shear %.4g m\n", -most, -least, bending,
              bending + shear);
  // Bending within one of n layers is 1/n^2 of the stiffness; one-point elements have it from hourglass control alone.
  EXPECT_GT(-least, 0.99 * (bending + shear));
  EXPECT_LT(-least, bending / (1 - 1. / 16) + shear);
  EXPECT_NEAR(least, most, 0.01 * bending);
}

}  // namespace
}  // namespace polynya::ice
