#include <gtest/gtest.h>
#include <omp.h>

#include <atomic>
#include <cstdlib>
#include <new>
#include <random>

#include "tests/core/contact/bodies.hpp"

using namespace polynya::contact;
using namespace polynya::contact::testing;

namespace {

std::atomic<long> allocations{0};

/// A box that tumbles through a cloud of particles and a second box, with friction, both ways and along edges.
struct Scene {
  Mesh box = box_of({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}, 6, 300);
  Mesh other = box_of({-1, -1, 0.52}, {1.1, 1.2, 1.2}, 5, 300);
  ContactForces sum;

  Scene() {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (int i = 0; i < 1500; ++i)
      other.add_point({uniform(random), uniform(random), 0.7 * uniform(random) - 0.9}, {0, 0, 4 + uniform(random)},
                      0.05, 0.02);
    for (std::size_t v = 0; v < box.count(); ++v) {
      const Vector3 x = row(box.positions, v);
      box.velocities[3 * v] = -2 * x[1];
      box.velocities[3 * v + 1] = 2 * x[0];
      box.velocities[3 * v + 2] = 1 + x[0];
    }
  }
  static ContactLaw law(double skin) {
    return {.friction = 0.3,
            .damping = 0.05,
            .stiffness_factor = 0.1,
            .depth_limit = 0.03,
            .skin = skin,
            .mirror = {},
            .two_way = true,
            .edges = true};
  }
};

struct Outcome {
  std::vector<double> box, other;
  double friction = 0, damping = 0, released = 0, stored = 0;
  std::size_t searches = 0, touches = 0;
};

Outcome play(double skin, int threads) {
  omp_set_num_threads(threads);
  Scene scene;
  PenaltyContact contact(Scene::law(skin));
  contact.set_topology(scene.box.body(), scene.other.body());
  Outcome out;
  const double dt = 1e-3;
  for (int n = 0; n < 400; ++n) {
    scene.box.drift(dt);
    scene.other.drift(dt);
    const ContactForces& forces = contact.evaluate(scene.box.body(), scene.other.body(), dt);
    kick(scene.box, forces.primary, dt);
    kick(scene.other, forces.secondary, dt);
    out.friction += forces.friction_loss;
    out.damping += forces.damping_loss;
    out.released += forces.released_energy;
    out.stored = forces.stored_energy;
    out.touches += forces.active;
  }
  out.box = scene.box.positions;
  out.other = scene.other.positions;
  out.searches = contact.searches();
  omp_set_num_threads(omp_get_num_procs());
  return out;
}

void expect_same_bits(const Outcome& a, const Outcome& b) {
  EXPECT_EQ(a.box, b.box);
  EXPECT_EQ(a.other, b.other);
  EXPECT_EQ(a.friction, b.friction);
  EXPECT_EQ(a.damping, b.damping);
  EXPECT_EQ(a.released, b.released);
  EXPECT_EQ(a.stored, b.stored);
}

}  // namespace

void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}

TEST(Search, KeptCandidatesGiveTheBitsOfASearchInEveryStep) {
  const Outcome kept = play(0.05, 2), always = play(1e-9, 2);
  EXPECT_GT(kept.touches, 5000u);
  EXPECT_LT(kept.searches, 100u);
  EXPECT_EQ(always.searches, 400u);
  expect_same_bits(kept, always);
}

TEST(Search, OneAndTwoThreadsGiveTheSameBits) {
  expect_same_bits(play(0.05, 1), play(0.05, 2));
}

TEST(Search, AllocatesNothingOnceWarm) {
  omp_set_num_threads(2);
  Scene scene;
  PenaltyContact contact(Scene::law(0.5));
  contact.set_topology(scene.box.body(), scene.other.body());
  const double dt = 1e-4;
  const auto step = [&] {
    scene.box.drift(dt);
    scene.other.drift(dt);
    contact.evaluate(scene.box.body(), scene.other.body(), dt);
  };
  // There and back, so that every buffer has had its largest size; forces are not applied.
  const auto turn_back = [&] {
    for (Mesh* mesh : {&scene.box, &scene.other})
      for (double& v : mesh->velocities) v = -v;
  };
  for (int there = 0; there < 2; ++there) {
    for (int n = 0; n < 400; ++n) step();
    turn_back();
  }
  const long before = allocations;
  for (int n = 0; n < 300; ++n) step();
  EXPECT_EQ(allocations - before, 0);
  omp_set_num_threads(omp_get_num_procs());
}
