#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/contact/penalty_contact.hpp"
#include "ice_solver/ice_surface.hpp"
#include "tests/ice_solver/ice_bodies.hpp"

namespace polynya::ice {
namespace {

using namespace testing;

constexpr double size = 0.002;

/// A rigid plate above the ice, its face down, of cells x cells squares from `from` to `to` along x and y.
struct Plate {
  std::vector<double> positions, velocities, masses, radii;
  std::vector<std::int64_t> ids;
  std::vector<std::int32_t> triangles;

  Plate(double from, double to, int cells, double height) {
    for (const double y : line(from, to, cells))
      for (const double x : line(from, to, cells)) positions.insert(positions.end(), {x, y, height});
    velocities.assign(positions.size(), 0.0);
    masses.assign(positions.size() / 3, 1e9);
    radii.assign(masses.size(), 0.0);
    ids.resize(masses.size());
    std::iota(ids.begin(), ids.end(), std::int64_t{0});
    for (int j = 0; j < cells; ++j)
      for (int i = 0; i < cells; ++i) {
        const std::int32_t a = i + (cells + 1) * j, b = a + 1, c = b + cells + 1, d = a + cells + 1;
        triangles.insert(triangles.end(), {a, c, b, a, d, c});
      }
  }
  void move(double speed, double dt) {
    for (std::size_t k = 2; k < positions.size(); k += 3) velocities[k] = -speed, positions[k] -= dt * speed;
  }
  contact::Body body() const { return {positions, velocities, masses, radii, ids, triangles}; }
};

constexpr int n = 8;  // elements along every edge of the block

struct Case {
  bool symmetric = false;  ///< a quarter of the block, whose other parts are its mirror images
  bool two_way = false;    ///< the plate's vertices against the ice's faces as well
  bool confined = false;   ///< brittle ice, held at its sides; else elastic ice with free sides
};

IceOptions options_of(const Case& c) {
  IceOptions options = block_options(n, n, n, size, c.confined ? continuum::Law(brittle_ice()) : elastic_ice());
  options.own_contact = true;
  options.planes = {c.symmetric, c.symmetric};
  return options;
}

contact::ContactLaw law_of(const Case& c) {
  contact::ContactLaw law{.depth_limit = 0.5 * size, .skin = 0.25 * size};
  law.mirror = {c.symmetric, c.symmetric};
  law.two_way = c.two_way;
  law.edges = true;
  return law;
}

/// A block on a floor under the plate, and what the coupler does with both, window by window.
struct Press {
  IceBody ice;
  Plate plate;
  contact::PenaltyContact contact;
  IceSurface surface;
  std::vector<double> positions, velocities;
  double dt = 0, time = 0;
  double force = 0;         ///< N, on the plate
  double contact_held = 0;  ///< J, held in the springs and booked as lost

  explicit Press(const Case& c)
      : ice(make_ice(options_of(c))),
        plate(c.symmetric ? 0 : -0.3 * size, (n + 0.3) * size, 11, n * size),
        contact(law_of(c)) {
    for (std::size_t k = 0; k < ice.solid.node_count(); ++k) {
      const double* x = &ice.solid.positions[3 * k];
      if (x[2] == 0) ice.solid.fixed[k] |= 4;
      for (std::size_t d = 0; d < 2; ++d)
        if (c.confined && (x[d] == 0 || x[d] > (n - 0.5) * size))
          ice.solid.fixed[k] |= static_cast<std::uint8_t>(1u << d);
    }
    dt = start(ice, 0.9);
    renew();
  }
  contact::Body body() const {
    return {positions, velocities, surface.masses, surface.radii, surface.ids, surface.triangles};
  }
  void renew() {
    surface = surface_of(ice);
    vertex_motion(ice, surface.nodes, positions, velocities);
    contact.set_topology(plate.body(), body());
  }
  void window(double speed) {
    advance_positions(ice, dt);
    plate.move(speed, dt);
    vertex_motion(ice, surface.nodes, positions, velocities);
    internal_forces(ice, dt);
    const contact::ContactForces& forces = contact.evaluate(plate.body(), body(), dt);
    booked_ += forces.friction_loss + forces.damping_loss + forces.released_energy;
    contact_held = forces.stored_energy + booked_;
    force = 0;
    for (std::size_t k = 2; k < forces.primary.size(); k += 3) force += forces.primary[k];
    std::vector<std::int64_t> vertices(surface.vertex_count());
    std::iota(vertices.begin(), vertices.end(), std::int64_t{0});
    std::vector<double> node_loads, particle_loads;
    distribute_loads(ice, surface, vertices, forces.secondary, node_loads, particle_loads);
    time += dt;
    const double next = std::min(0.9 * stable_step(ice), 1.1 * dt);
    advance_velocities(ice, node_loads, particle_loads, dt, next);
    dt = next;
  }
  /// Lowers the plate smoothly, in ten times the time that sound takes down and up.
  void press(double strain) {
    const double ramp = 20 * n * size / 3900, way = strain * n * size;
    while (time < ramp) window(way / ramp * (1 - std::cos(2 * std::numbers::pi * time / ramp)));
  }
  /// Of the top layer those that fulfil the condition of their numbers along x and y.
  template <class Condition>
  void convert_top(Condition&& condition) {
    convert_elements(ice, elements_where(ice, [&](const auto& x) {
                       return x[2] > (n - 1) * size &&
                              condition(static_cast<int>(x[0] / size), static_cast<int>(x[1] / size));
                     }));
    renew();
  }
  /// Energy of ice and contact together. The plate rests.
  double energy() const {
    const Account account = account_of(ice);
    return account.balance() + account.external_work + contact_held;
  }

 private:
  double booked_ = 0;
};

/// Presses, converts, and looks on while the plate rests.
template <class Condition>
void expect_the_force_to_stay(const Case& c, double strain, Condition&& condition) {
  Press press(c);
  press.press(strain);
  const double force = press.force, energy = press.energy(), contact_held = press.contact_held;
  const double stored = account_of(press.ice).internal + contact_held;
  press.convert_top(condition);
  press.window(0);
  const double at_once = press.force / force - 1, contact_jump = press.contact_held - contact_held;
  double low = at_once, high = at_once, energy_error = 0;
  for (int k = 1; k < 250; ++k) {
    press.window(0);
    low = std::min(low, press.force / force - 1);
    high = std::max(high, press.force / force - 1);
    energy_error = std::max(energy_error, std::abs(press.energy() - energy));
  }
  std::printf(
      "%zu particles at %.1f MPa: force %+.2e at once, then %+.4f to %+.4f; energy error %.1e, contact %.1e at once\n",
      press.ice.particles.count(), 1e-6 * force / (n * n * size * size), at_once, low, high, energy_error / stored,
      contact_jump / stored);
  EXPECT_LT(std::abs(at_once), 1e-3);
  EXPECT_GT(low, -0.05);
  EXPECT_LT(high, 0.05);
  EXPECT_LT(std::abs(contact_jump), 1e-3 * stored);
  EXPECT_LT(energy_error, 1e-3 * stored);
}

bool all(int, int) {
  return true;
}
bool every_other(int i, int j) {
  return (i + j) % 2 == 0;
}
bool inner(int i, int j) {
  return std::min(i, j) > 1 && std::max(i, j) < n - 2;
}

TEST(PressedConversion, OfTheWholeLayerKeepsTheForceOnThePlate) {
  expect_the_force_to_stay({}, 1e-3, all);
  expect_the_force_to_stay({.symmetric = true, .two_way = true}, 1e-3, all);
}

TEST(PressedConversion, OfEveryOtherElementHandsOnThePartsOfItsNodes) {
  expect_the_force_to_stay({.two_way = true}, 1e-3, every_other);
}

TEST(PressedConversion, OfBrittleIceUnderHighPressureKeepsTheForceOnThePlate) {
  expect_the_force_to_stay({.two_way = true, .confined = true}, 0.01, inner);
}

}  // namespace
}  // namespace polynya::ice
