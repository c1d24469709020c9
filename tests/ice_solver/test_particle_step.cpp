#include <gtest/gtest.h>

#include "ice_solver/particles.hpp"
#include "tests/ice_solver/ice_bodies.hpp"

namespace polynya::ice {
namespace {

constexpr double smoothing_length = 1e-3;

double step_of(double damage, double relative_volume) {
  const continuum::Law law = testing::brittle_ice();
  Particles particles;
  ParticleBirth birth;
  birth.mass = 1e-6;
  birth.smoothing_length = smoothing_length;
  birth.state.damage = damage;
  birth.state.relative_volume = relative_volume;
  add_particle(particles, law, birth);
  return particle_stable_step(particles, law);
}

}  // namespace

TEST(ParticleStep, IsTheTimeOfALongitudinalWaveThroughAPartOfTheSmoothingLength) {
  EXPECT_NEAR(step_of(0, 1), 0.3 * smoothing_length / continuum::longitudinal_wave_speed(testing::brittle_ice()),
              1e-15);
}

TEST(ParticleStep, IsNotShortenedByRubbleThatComesApart) {
  for (const double expansion : {1.01, 2.0, 50.0}) EXPECT_DOUBLE_EQ(step_of(1, expansion), step_of(1, 1)) << expansion;
}

TEST(ParticleDensity, CountsEveryStepInWhichAParticleIsKeptFromThinningFurther) {
  const continuum::Law law = testing::brittle_ice();
  Particles particles;
  for (int i = 0; i < 3; ++i) {
    ParticleBirth birth;
    birth.mass = 1e-6;
    birth.smoothing_length = smoothing_length;
    birth.state.relative_volume = 50;
    if (i < 2) birth.velocity_gradient = {1, 0, 0, 0, 1, 0, 0, 0, 1};  // volume grows by exp(3 t), twice in 0.231 s
    add_particle(particles, law, birth);
  }
  for (int step = 0; step < 30; ++step) update_particle_stress(particles, law, 0.01);
  EXPECT_EQ(particles.steps_at_bound, 2 * 7);  // at 0.24, 0.25, ... 0.30 s
  EXPECT_DOUBLE_EQ(particles.relative_volume[0], 100);
  EXPECT_DOUBLE_EQ(particles.relative_volume[2], 50);
}

TEST(ParticleStep, HeedsTheShearStiffnessOfIceThatIsNotBroken) {
  EXPECT_LT(step_of(0.99, 2), 0.9 * step_of(1, 2));
}

}  // namespace polynya::ice
