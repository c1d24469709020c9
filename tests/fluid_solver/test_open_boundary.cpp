// What a non-reflecting boundary returns of small plane waves that meet it straight and aslant.
//
// The boundary answers with p = rho c (u - w), dw/dt = c s (u - w), s the cosine of the way out over the distance from
// the far field's centre (0 without one). For exp(i omega t) and k = omega / c this is the impedance Z = rho c i / (i +
// s/k), and a plane wave at the angle a to the normal returns R = (Z cos a - rho c) / (Z cos a + rho c), |R|^2 = ((1 -
// cos a)^2 + (s/k)^2) / ((1 + cos a)^2 + (s/k)^2).
#include <gtest/gtest.h>

#include <cmath>

#include "fluid_solver/phases.hpp"
#include "tests/fluid_solver/analytic_overlap.hpp"

using namespace polynya::fluid;
using namespace polynya::fluid::test;

namespace {

const double pi = std::acos(-1.0);
constexpr double ambient_pressure = 1e5, amplitude = 1e4, h = 1e-3;
constexpr int per_wave = 20;  ///< cells per wavelength along x

/// A packet of waves with wave numbers about `k` along x, all with `across` along y: between walls half a wavelength
/// apart this is a pair of plane waves, and both return the same part.
struct Packet {
  double k = 2 * pi / (per_wave * h), across = 0;
  static constexpr int lines = 41;
  double width() const { return k / 12; }  ///< of the spectrum
  double length() const { return 1 / width(); }
  double wave_number(int q) const { return k + width() * 8.0 * (q - lines / 2) / (lines - 1); }
  double weight(int q) const {
    const double z = 8.0 * (q - lines / 2) / (lines - 1);
    return std::exp(-0.5 * z * z) * 8.0 / (lines - 1) / std::sqrt(2 * pi);
  }
};

double returned_by_theory(const Packet& packet, double spreading) {
  double back = 0, sum = 0;
  for (int q = 0; q < Packet::lines; ++q) {
    const double total = std::hypot(packet.wave_number(q), packet.across), cosine = packet.wave_number(q) / total;
    const double slow = std::pow(spreading / total, 2), energy = std::pow(packet.weight(q), 2);
    back += energy * (std::pow(1 - cosine, 2) + slow) / (std::pow(1 + cosine, 2) + slow);
    sum += energy;
  }
  return std::sqrt(back / sum);
}

struct Guide {
  Fluid fluid;
  double density, sound_speed;
};

/// The packet at rest four lengths from both ends; the upper end along x is of the kind given.
Guide guide(const Packet& packet, Boundary end) {
  polynya::fluid::Setup setup;
  setup.boundary.fill(Boundary::wall);
  setup.boundary[1] = end;
  const int cells = static_cast<int>(8 * packet.length() / h);
  const int wide = packet.across > 0 ? static_cast<int>(std::lround(pi / packet.across / h)) : 1;
  Fluid fluid(Grid(even_line(0, cells * h, cells), even_line(0, wide * h, wide), even_line(0, h, 1)), setup);
  const double rho = density_at(setup.law[water], ambient_pressure, 0, 1000);
  const double c = std::sqrt(bulk_modulus(rho, respond(setup.law[water], rho, 0)) / rho), middle = 0.5 * cells * h;
  const auto sum = [&](double x, auto&& term) {
    double total = 0;
    for (int q = 0; q < Packet::lines; ++q) {
      const double k = packet.wave_number(q), omega = c * std::hypot(k, packet.across);
      total += amplitude * packet.weight(q) * term(k, omega, k * (x - middle));
    }
    return total;
  };
  fill(fluid, {}, [&](int i, int j, int) {
    const double p = std::cos(packet.across * fluid.grid.centre_y(j)) *
                     sum(fluid.grid.centre_x(i), [](double, double, double phase) { return std::cos(phase); });
    CellState state;
    state.fraction[0] = 1;
    state.density[0] = density_at(setup.law[water], ambient_pressure + p, 0, rho);
    return state;
  });
  set_ambient(fluid, 1, {{1, 0}, {rho, 0}, {0, 0}});
  apply_ambient(fluid);
  for (int k = 1; k <= 2; ++k) {
    for (int j = 1; j <= wide + 1; ++j) {
      for (int i = 2; i <= cells; ++i) {
        const double x = fluid.grid.x[i - 1], y = fluid.grid.y[j - 1];
        fluid.velocity[0][fluid.grid.at(i, j, k)] =
            std::cos(packet.across * y) *
            sum(x, [&](double kx, double omega, double phase) { return kx / (rho * omega) * std::cos(phase); });
        if (j > 1 && j <= wide)
          fluid.velocity[1][fluid.grid.at(i, j, k)] =
              -std::sin(packet.across * y) * sum(x, [&](double, double omega, double phase) {
                return packet.across / (rho * omega) * std::sin(phase);
              });
      }
    }
  }
  return {std::move(fluid), rho, c};
}

double acoustic_energy(const Guide& g) {
  const Grid& grid = g.fluid.grid;
  double sum = 0;
  for (int j = 1; j <= grid.ny; ++j) {
    for (int i = 1; i <= grid.nx; ++i) {
      const std::ptrdiff_t c = grid.at(i, j, 1);
      const double p = g.fluid.pressure[c] - ambient_pressure;
      sum += p * p / (g.density * g.sound_speed * g.sound_speed);
      for (int d = 0; d < 2; ++d) {
        const auto& v = g.fluid.velocity[d];
        const double mean = 0.25 * (v[c] + v[c + 1] + v[c + grid.sy] + v[c + 1 + grid.sy]);
        sum += g.density * mean * mean;
      }
    }
  }
  return sum;
}

/// Energy left when the packet has gone to the end and back.
double energy_left(const Packet& packet, Boundary end, double distance) {
  Guide g = guide(packet, end);
  if (distance > 0) {
    const double high = g.fluid.grid.x.back(), middle = 0.5 * g.fluid.grid.y.back();
    start_far_field(g.fluid, {high - distance, middle, 0.5 * h});
  }
  const double cosine = packet.k / std::hypot(packet.k, packet.across);
  const double time = 8 * packet.length() / (g.sound_speed * cosine), dt = 0.8 * stable_step(g.fluid);
  const int steps = static_cast<int>(std::ceil(time / dt));
  for (int n = 0; n < steps; ++n) step(g.fluid, time / steps, {});
  update_cell_states(g.fluid);
  return acoustic_energy(g);
}

/// Amplitude returned, against a wall, which returns all and costs as much on the way; distance 0: no far field.
double returned(const Packet& packet, double distance) {
  return std::sqrt(energy_left(packet, Boundary::non_reflecting, distance) / energy_left(packet, Boundary::wall, 0));
}

}  // namespace

TEST(OpenBoundary, ReturnsLessThanTwoPercentOfAWeakPulseThatMeetsItStraight) {
  const double found = returned({}, 0);
  std::printf("straight: %.4f returned\n", found);
  EXPECT_LT(found, 0.02);
}

TEST(OpenBoundary, ReturnsOfAPlaneWaveAt45DegreesWhatAnImpedanceDoes) {
  Packet packet;
  packet.across = packet.k;
  const double found = returned(packet, 0), theory = returned_by_theory(packet, 0);
  std::printf("45 degrees: %.4f returned, theory %.4f of this packet, 0.1716 of one wave\n", found, theory);
  EXPECT_NEAR(found, theory, 0.02);
  EXPECT_NEAR(theory, 0.1716, 0.01);
}

TEST(OpenBoundary, FarFieldReturnsOfPlaneWavesWhatItsImpedanceDoes) {
  // It lets slow flow pass: five radians of the wave away from its centre it returns a tenth of a wave that is plane.
  const Packet straight;
  const double distance = 5 / straight.k, found = returned(straight, distance);
  const double theory = returned_by_theory(straight, 1 / distance);
  std::printf("far field, straight: %.4f returned, theory %.4f\n", found, theory);
  EXPECT_NEAR(theory, 0.0995, 0.002);
  EXPECT_NEAR(found, theory, 0.02);
  Packet slanted;
  slanted.across = slanted.k;
  const double away = 10 / std::hypot(slanted.k, slanted.across);
  const double back = returned(slanted, away), expected = returned_by_theory(slanted, 1 / away);
  std::printf("far field, 45 degrees: %.4f returned, theory %.4f\n", back, expected);
  EXPECT_NEAR(back, expected, 0.02);
}
