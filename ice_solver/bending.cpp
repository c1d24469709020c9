#include "ice_solver/bending.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace polynya::ice {
namespace {

/// The coordinate of a grid line nearest to the one wanted.
double nearest(const std::vector<double>& line, double wanted) {
  return *std::min_element(line.begin(), line.end(),
                           [&](double a, double b) { return std::abs(a - wanted) < std::abs(b - wanted); });
}

void add_line(std::vector<std::int32_t>& nodes, const IceBody& beam, double x, double z) {
  const auto& mesh = beam.solid.mesh;
  for (std::size_t n = 0; n < mesh.node_count(); ++n)
    if (std::abs(mesh.nodes[3 * n] - x) < 1e-9 && std::abs(mesh.nodes[3 * n + 2] - z) < 1e-9)
      nodes.push_back(static_cast<std::int32_t>(n));
}

/// Node lines at -span/2 and span/2; only the second where the beam is cut at x = 0.
std::vector<std::int32_t> lines_at(IceBody& beam, double span, double z, double& found_span) {
  const auto& x = beam.options.x;
  if (!(span > 0) || 0.5 * span > x.back() + 1e-9)
    throw std::invalid_argument("ice.bending: a span of " + std::to_string(span) +
                                " m does not fit a beam that ends at x = " + std::to_string(x.back()) + " m");
  std::vector<std::int32_t> nodes;
  const double right = nearest(x, 0.5 * span);
  found_span = 2 * right;
  add_line(nodes, beam, right, z);
  if (!beam.options.planes.x) {
    const double left = nearest(x, -0.5 * span);
    found_span = right - left;
    add_line(nodes, beam, left, z);
  }
  for (const std::int32_t n : nodes) beam.solid.fixed[static_cast<std::size_t>(n)] |= 4;
  return nodes;
}

double vertical_force(const std::vector<std::int32_t>& nodes, const IceBody& beam) {
  double sum = 0;
  for (const std::int32_t n : nodes) sum += beam.solid.internal_force[3 * static_cast<std::size_t>(n) + 2];
  return sum;
}

}  // namespace

double smooth_ramp(double time, double ramp_time) {
  if (time >= ramp_time) return 1;
  if (time <= 0) return 0;
  const double s = time / ramp_time;
  return s * s * s * (10 - 15 * s + 6 * s * s);
}

BendingRig make_bending_rig(IceBody& beam, double support_span, double load_span, double speed, double ramp_time) {
  BendingRig rig;
  rig.speed = speed;
  rig.ramp_time = ramp_time;
  rig.multiplicity = (beam.options.planes.x ? 2 : 1) * (beam.options.planes.y ? 2 : 1);
  rig.supports = lines_at(beam, support_span, beam.options.z.front(), rig.support_span);
  rig.loads = lines_at(beam, load_span, beam.options.z.back(), rig.load_span);
  return rig;
}

void move_rollers(BendingRig& rig, IceBody& beam, double time, double dt) {
  const double velocity = rig.speed * smooth_ramp(time + 0.5 * dt, rig.ramp_time);
  for (const std::int32_t node : rig.loads) {
    const auto n = static_cast<std::size_t>(node);
    double& v = beam.solid.velocities[3 * n + 2];
    // The account has opened this step with the old velocity: kinetic energy, and half a step of the reaction's work.
    beam.books.prescribed_work += 0.5 * beam.solid.masses[n] * (velocity * velocity - v * v) -
                                  0.5 * dt * beam.solid.internal_force[3 * n + 2] * (-velocity - v);
    v = -velocity;
  }
  rig.deflection += dt * velocity;
}

double roller_load(const BendingRig& rig, const IceBody& beam) {
  return rig.multiplicity * vertical_force(rig.loads, beam);
}

double support_reaction(const BendingRig& rig, const IceBody& beam) {
  return -rig.multiplicity * vertical_force(rig.supports, beam);
}

}  // namespace polynya::ice
