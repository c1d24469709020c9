#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "ice_solver/pair_sums.hpp"
#include "ice_solver/smoothing_kernel.hpp"
#include "tests/ice_solver/lattice.hpp"

namespace polynya::ice {
namespace {

using testing::disturb;
using testing::lattice;
using testing::Noise;

constexpr double spacing = 0.002, skin = 0.0005;

TEST(SmoothingKernel, IsNormalisedAndItsGradientIsItsDerivative) {
  const double h = 0.3;
  double integral = 0;
  const int n = 20000;
  for (int k = 0; k < n; ++k) {
    const double r = (k + 0.5) * 2 * h / n;
    integral += 4 * std::numbers::pi * r * r * kernel(r, h) * 2 * h / n;
  }
  EXPECT_NEAR(integral, 1, 1e-8);
  for (double r : {0.05, 0.2, 0.31, 0.45, 0.59}) {
    const double e = 1e-6, slope = (kernel(r + e, h) - kernel(r - e, h)) / (2 * e);
    EXPECT_NEAR(kernel_gradient_over_distance(r, h) * r, slope, 1e-6 * std::abs(slope) + 1e-8);
  }
  EXPECT_EQ(kernel_gradient_over_distance(0.6, h), 0);
}

TEST(NeighbourList, HoldsEveryPairInReachThatTheDoubleLoopFinds) {
  Noise noise;
  Points particles = lattice({7, 6, 5}, spacing, {0, 0, 0}),
         elements = lattice({7, 6, 3}, spacing, {0, 0, 5 * spacing});
  disturb(particles, noise, 0.3 * spacing);
  for (std::size_t i = 0; i < particles.count(); ++i) particles.smoothing_length[i] *= 1 + 0.2 * noise();
  NeighbourList list;
  list.build(particles, elements, {}, skin);
  const auto at = [&](std::int32_t p) {
    const PointSource& s = list.points()[static_cast<std::size_t>(p)];
    const Points& set = s.element ? elements : particles;
    return std::pair(&set.position[3 * static_cast<std::size_t>(s.index)],
                     set.smoothing_length[static_cast<std::size_t>(s.index)]);
  };
  std::size_t expected = 0;
  for (std::size_t a = 0; a < list.points().size(); ++a)
    for (std::size_t b = 0; b < list.points().size(); ++b) {
      if (a == b || (list.points()[a].element && list.points()[b].element)) continue;
      const auto [x, hx] = at(static_cast<std::int32_t>(a));
      const auto [y, hy] = at(static_cast<std::int32_t>(b));
      expected += std::hypot(x[0] - y[0], x[1] - y[1], x[2] - y[2]) < hx + hy + skin;
    }
  EXPECT_EQ(list.entries(), expected);
  EXPECT_FALSE(list.outdated(particles, elements));
  particles.position[4] += 0.51 * skin;
  EXPECT_TRUE(list.outdated(particles, elements));
}

TEST(ParticleForces, ConserveLinearMomentumToRounding) {
  Noise noise;
  Points particles = lattice({8, 8, 6}, spacing, {0, 0, 0}),
         elements = lattice({8, 8, 4}, spacing, {0, 0, 6 * spacing});
  disturb(particles, noise, 0.2 * spacing);
  disturb(elements, noise, 0.1 * spacing);
  NeighbourList list;
  list.build(particles, elements, {}, skin);
  PairSums sums;
  sums.forces(list, particles, elements, {.sound_speed = 3800});
  for (int axis = 0; axis < 3; ++axis) {
    double sum = 0, magnitude = 0;
    for (const Points* set : {&particles, &elements})
      for (std::size_t i = 0; i < set->count(); ++i) {
        sum += set->force[3 * i + axis];
        magnitude += std::abs(set->force[3 * i + axis]);
      }
    EXPECT_GT(magnitude, 1.0);
    EXPECT_LT(std::abs(sum), 1e-14 * magnitude);
  }
}

TEST(ParticleForces, DoTheWorkOfTheParticlesStressAndTheViscosityAndNoOther) {
  Noise noise;
  Points particles = lattice({6, 6, 6}, spacing, {0, 0, 0}),
         elements = lattice({6, 6, 3}, spacing, {0, 0, 6 * spacing});
  disturb(particles, noise, 0.2 * spacing);
  disturb(elements, noise, 0.1 * spacing);
  NeighbourList list;
  list.build(particles, elements, {}, skin);
  PairSums sums;
  std::vector<double> gradient(9 * particles.count()), approach(particles.count());
  sums.velocity_gradients(list, particles, elements, gradient, approach);
  sums.forces(list, particles, elements, {.sound_speed = 3800});
  double work = 0, stress_power = 0, viscous_power = 0;
  for (const Points* set : {&particles, &elements}) {
    work += std::inner_product(set->force.begin(), set->force.end(), set->velocity.begin(), 0.0);
    viscous_power -=
        std::inner_product(set->viscous_force.begin(), set->viscous_force.end(), set->velocity.begin(), 0.0);
  }
  for (std::size_t i = 0; i < particles.count(); ++i) {
    const double *s = &particles.stress[6 * i], *l = &gradient[9 * i];
    stress_power +=
        particles.mass[i] / particles.density[i] *
        (s[0] * l[0] + s[1] * l[4] + s[2] * l[8] + s[3] * (l[1] + l[3]) + s[4] * (l[5] + l[7]) + s[5] * (l[2] + l[6]));
  }
  EXPECT_GT(viscous_power, 0);
  EXPECT_NEAR(work, -stress_power - viscous_power, 1e-12 * (std::abs(stress_power) + viscous_power));
}

TEST(ParticleForces, VanishInsideABlockUnderUniformStress) {
  Points particles = lattice({9, 9, 9}, spacing, {0, 0, 0}),
         elements = lattice({9, 9, 4}, spacing, {0, 0, 9 * spacing});
  for (Points* set : {&particles, &elements})
    for (std::size_t i = 0; i < set->count(); ++i) {
      const double stress[6] = {-3e6, -2e6, -1e6, 4e5, 5e5, 6e5};
      std::copy(stress, stress + 6, &set->stress[6 * i]);
    }
  NeighbourList list;
  list.build(particles, elements, {}, skin);
  PairSums sums;
  sums.forces(list, particles, elements, {.sound_speed = 3800});
  const double face_force = 3e6 * spacing * spacing;
  for (int layer : {4, 6, 8}) {  // the last one touches the elements, which complete its neighbourhood
    const std::size_t i = static_cast<std::size_t>(4 + 9 * (4 + 9 * layer));
    for (int axis = 0; axis < 3; ++axis) EXPECT_LT(std::abs(particles.force[3 * i + axis]), 1e-12 * face_force);
  }
}

TEST(ParticleForces, TransmitTheTractionThroughAPlaneInTheBlock) {
  // All pairs across the plane above layer 5 push the lower half of the middle column. In the continuum this is the
  // traction times the area; the lattice sum at h = 1.2 spacings is 2 % off, a quadrature error.
  Points particles = lattice({11, 11, 10}, spacing, {0, 0, 0}), none;
  for (std::size_t i = 0; i < particles.count(); ++i) particles.stress[6 * i + 2] = -2e6;
  NeighbourList list;
  list.build(particles, none, {}, skin);
  PairSums sums;
  sums.forces(list, particles, none, {});
  double through = 0;
  for (int layer = 0; layer < 5; ++layer)
    through += particles.force[3 * static_cast<std::size_t>(5 + 11 * (5 + 11 * layer)) + 2];
  EXPECT_NEAR(through, -2e6 * spacing * spacing, 0.025 * 2e6 * spacing * spacing);
}

TEST(SymmetryPlanes, GiveEveryParticleOfTheQuarterTheSumsOfTheFullBlock) {
  Noise noise;
  Points quarter = lattice({4, 4, 5}, spacing, {0, 0, 0}), elements = lattice({4, 4, 2}, spacing, {0, 0, 5 * spacing});
  disturb(quarter, noise, 0.15 * spacing);
  disturb(elements, noise, 0.1 * spacing);
  const auto mirrored = [](const Points& set) {
    Points full;
    full.resize(4 * set.count());
    for (std::size_t i = 0; i < full.count(); ++i) {
      const std::size_t k = i / 4;
      const MirrorSigns sign(static_cast<std::uint8_t>(i % 4));
      const double vector_sign[3] = {sign.x, sign.y, 1};
      const double tensor_sign[6] = {1, 1, 1, sign.x * sign.y, sign.y, sign.x};
      for (int a = 0; a < 3; ++a) full.position[3 * i + a] = vector_sign[a] * set.position[3 * k + a];
      for (int a = 0; a < 3; ++a) full.velocity[3 * i + a] = vector_sign[a] * set.velocity[3 * k + a];
      for (int a = 0; a < 6; ++a) full.stress[6 * i + a] = tensor_sign[a] * set.stress[6 * k + a];
      full.mass[i] = set.mass[k], full.density[i] = set.density[k];
      full.smoothing_length[i] = set.smoothing_length[k];
    }
    return full;
  };
  Points full = mirrored(quarter), full_elements = mirrored(elements);
  NeighbourList quarter_list, full_list;
  quarter_list.build(quarter, elements, {true, true}, skin);
  full_list.build(full, full_elements, {}, skin);
  PairSums sums;
  const PairViscosity viscosity{.sound_speed = 3800};
  std::vector<double> gradient(9 * quarter.count()), approach(quarter.count());
  std::vector<double> full_gradient(9 * full.count()), full_approach(full.count());
  sums.velocity_gradients(quarter_list, quarter, elements, gradient, approach);
  sums.velocity_gradients(full_list, full, full_elements, full_gradient, full_approach);
  sums.forces(quarter_list, quarter, elements, viscosity);
  sums.forces(full_list, full, full_elements, viscosity);
  double scale = 0, gradient_scale = 0;
  for (double f : quarter.force) scale = std::max(scale, std::abs(f));
  for (double l : gradient) gradient_scale = std::max(gradient_scale, std::abs(l));
  for (std::size_t k = 0; k < quarter.count(); ++k) {
    for (std::size_t a = 0; a < 3; ++a) EXPECT_NEAR(quarter.force[3 * k + a], full.force[12 * k + a], 1e-12 * scale);
    for (std::size_t a = 0; a < 9; ++a)
      EXPECT_NEAR(gradient[9 * k + a], full_gradient[36 * k + a], 1e-12 * gradient_scale);
  }
  for (std::size_t k = 0; k < elements.count(); ++k)
    for (std::size_t a = 0; a < 3; ++a)
      EXPECT_NEAR(elements.force[3 * k + a], full_elements.force[12 * k + a], 1e-12 * scale);
}

TEST(VelocityGradient, OfARigidRotationHasNoDivergence) {
  Points particles = lattice({8, 8, 8}, spacing, {0, 0, 0}), none;
  for (std::size_t i = 0; i < particles.count(); ++i) {
    particles.velocity[3 * i] = -100 * particles.position[3 * i + 1];
    particles.velocity[3 * i + 1] = 100 * particles.position[3 * i];
  }
  NeighbourList list;
  list.build(particles, none, {}, skin);
  PairSums sums;
  std::vector<double> gradient(9 * particles.count()), approach(particles.count());
  sums.velocity_gradients(list, particles, none, gradient, approach);
  for (std::size_t i = 0; i < particles.count(); ++i)
    EXPECT_NEAR(gradient[9 * i] + gradient[9 * i + 4] + gradient[9 * i + 8], 0, 1e-11);
  const std::size_t middle = 3 + 8 * (3 + 8 * 3);
  EXPECT_NEAR(gradient[9 * middle + 3], 100, 2);  // quadrature of the lattice sum
  EXPECT_NEAR(gradient[9 * middle + 1], -100, 2);
}

}  // namespace
}  // namespace polynya::ice
