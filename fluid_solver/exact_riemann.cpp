#include "fluid_solver/exact_riemann.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace polynya::fluid {
namespace {

double sound_speed(const RiemannState& s) {
  return std::sqrt(s.gamma * (s.pressure + s.stiffness) / s.density);
}

/// Change of velocity across the wave that brings a side to pressure p, with its slope.
std::array<double, 2> velocity_jump(const RiemannState& s, double p) {
  const double a = p + s.stiffness, b = s.pressure + s.stiffness;
  if (p > s.pressure) {
    const double A = 2.0 / ((s.gamma + 1.0) * s.density), B = (s.gamma - 1.0) / (s.gamma + 1.0) * b;
    const double root = std::sqrt(A / (a + B));
    return {(p - s.pressure) * root, root * (1.0 - 0.5 * (p - s.pressure) / (a + B))};
  }
  const double c = sound_speed(s), power = (s.gamma - 1.0) / (2.0 * s.gamma);
  return {2.0 * c / (s.gamma - 1.0) * (std::pow(a / b, power) - 1.0),
          std::pow(a / b, -(s.gamma + 1.0) / (2.0 * s.gamma)) / (s.density * c)};
}

}  // namespace

ExactRiemann::ExactRiemann(const RiemannState& left, const RiemannState& right) : side_{left, right} {
  const double lowest = -std::min(left.stiffness, right.stiffness);
  const auto mismatch = [&](double p) {
    return velocity_jump(left, p)[0] + velocity_jump(right, p)[0] + right.velocity - left.velocity;
  };
  double low = lowest, high = std::max(left.pressure, right.pressure);
  while (mismatch(high) < 0) high = high > 0 ? 2 * high : 1.0;
  const double span = std::max(high - lowest, 1e-300);
  if (mismatch(lowest + 1e-14 * span) > 0) throw std::runtime_error("the Riemann problem opens a vacuum");
  double p = 0.5 * (low + high);
  for (int iteration = 0; iteration < 200; ++iteration) {
    const double f = mismatch(p), slope = velocity_jump(left, p)[1] + velocity_jump(right, p)[1];
    (f > 0 ? high : low) = p;
    double next = p - f / slope;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - p) <= 1e-15 * (std::abs(p) + span * 1e-3)) break;
    p = next;
  }
  star_pressure_ = p;
  star_velocity_ = 0.5 * (left.velocity + right.velocity + velocity_jump(right, p)[0] - velocity_jump(left, p)[0]);
}

ExactRiemann::Sample ExactRiemann::sample(double speed) const {
  // The right side is the mirror image of the left.
  const bool on_left = speed < star_velocity_;
  const RiemannState& s = side_[on_left ? 0 : 1];
  const double sign = on_left ? 1.0 : -1.0, u = sign * s.velocity, us = sign * star_velocity_, x = sign * speed;
  const double c = sound_speed(s), g = s.gamma, p = star_pressure_ + s.stiffness, p0 = s.pressure + s.stiffness;
  const Sample undisturbed{s.density, s.velocity, s.pressure};
  if (star_pressure_ > s.pressure) {
    const double shock = u - c * std::sqrt((g + 1.0) / (2.0 * g) * p / p0 + (g - 1.0) / (2.0 * g));
    if (x < shock) return undisturbed;
    const double r = (g - 1.0) / (g + 1.0);
    return {s.density * (p / p0 + r) / (r * p / p0 + 1.0), star_velocity_, star_pressure_};
  }
  const double star_sound = c * std::pow(p / p0, (g - 1.0) / (2.0 * g));
  if (x < u - c) return undisturbed;
  if (x > us - star_sound) return {s.density * std::pow(p / p0, 1.0 / g), star_velocity_, star_pressure_};
  const double inside = 2.0 / (g + 1.0) + (g - 1.0) / ((g + 1.0) * c) * (u - x);
  return {s.density * std::pow(inside, 2.0 / (g - 1.0)), sign * 2.0 / (g + 1.0) * (c + 0.5 * (g - 1.0) * u + x),
          p0 * std::pow(inside, 2.0 * g / (g - 1.0)) - s.stiffness};
}

}  // namespace polynya::fluid
