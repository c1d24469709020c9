#include "coupler/handed_loads.hpp"

#include <Eigen/Dense>

namespace polynya::coupler {
namespace {

void hold_over_window(SolidSide& side, double window) {
  for (std::size_t v = 0; v < side.vertices(); ++v) {
    double* z = &side.impedance[6 * v];
    if (z[0] == 0 && z[1] == 0 && z[2] == 0) continue;
    Eigen::Matrix3d whole;
    whole << z[0], z[3], z[5], z[3], z[1], z[4], z[5], z[4], z[2];
    const Eigen::Matrix3d held = (Eigen::Matrix3d::Identity() + (0.5 * window / side.masses[v]) * whole).inverse();
    Eigen::Map<Eigen::Vector3d> force(&side.span_force[3 * v]);
    force = (held * force).eval();
    const Eigen::Matrix3d impedance = held * whole;
    z[0] = impedance(0, 0);
    z[1] = impedance(1, 1);
    z[2] = impedance(2, 2);
    z[3] = impedance(0, 1);
    z[4] = impedance(1, 2);
    z[5] = impedance(2, 0);
  }
}

}  // namespace

void begin_span_loads(SolidSide& side, const SpanStart& start) {
  const double share = (start.expects ? corrected_share : 1.0) / start.span;
  side.span_force.resize(side.fluid_impulse.size());
  for (std::size_t i = 0; i < side.span_force.size(); ++i)
    side.span_force[i] = (start.expects ? side.expected_force[i] : 0.0) + share * side.fluid_impulse[i];
  if (!start.expects) return;
  if (start.span > start.last_span)
    for (double& z : side.impedance) z *= start.span / start.last_span;
  hold_over_window(side, start.window);
}

Impulse hand_on_fluid_loads(SolidSide& side, double acting_time) {
  Impulse handed{};
  side.fluid_force = side.span_force;
  side.fluid_force.resize(side.fluid_impulse.size());
  for (std::size_t v = 0; v < side.vertices(); ++v) {
    const double* z = &side.impedance[6 * v];
    const double *now = &side.velocities[3 * v], *seen = &side.seen_velocity[3 * v];
    const double x = now[0] - seen[0], y = now[1] - seen[1], w = now[2] - seen[2];
    double* force = &side.fluid_force[3 * v];
    force[0] -= z[0] * x + z[3] * y + z[5] * w;
    force[1] -= z[3] * x + z[1] * y + z[4] * w;
    force[2] -= z[5] * x + z[4] * y + z[2] * w;
    for (std::size_t d = 0; d < 3; ++d) {
      side.fluid_impulse[3 * v + d] -= acting_time * force[d];
      handed[d] += acting_time * force[d];
    }
  }
  return handed;
}

}  // namespace polynya::coupler
