#include "coupler/handed_loads.hpp"

#include <Eigen/Dense>

namespace polynya::coupler {
namespace {

Eigen::Matrix3d symmetric(const double* z) {
  return (Eigen::Matrix3d() << z[0], z[3], z[5], z[3], z[1], z[4], z[5], z[4], z[2]).finished();
}

void store(const Eigen::Matrix3d& matrix, double* z) {
  z[0] = matrix(0, 0);
  z[1] = matrix(1, 1);
  z[2] = matrix(2, 2);
  z[3] = matrix(0, 1);
  z[4] = matrix(1, 2);
  z[5] = matrix(2, 0);
}

/// Adds the product of a symmetric matrix and a vector to the force.
void add_product(const double* z, double x, double y, double w, double* force) {
  force[0] += z[0] * x + z[3] * y + z[5] * w;
  force[1] += z[3] * x + z[1] * y + z[4] * w;
  force[2] += z[5] * x + z[4] * y + z[2] * w;
}

void hold_over_window(SolidSide& side, double window) {
  for (std::size_t v = 0; v < side.vertices(); ++v) {
    double* z = &side.impedance[6 * v];
    if (z[0] == 0 && z[1] == 0 && z[2] == 0) continue;
    const Eigen::Matrix3d whole = symmetric(z);
    const Eigen::Matrix3d held = (Eigen::Matrix3d::Identity() + (0.5 * window / side.masses[v]) * whole).inverse();
    Eigen::Map<Eigen::Vector3d> force(&side.span_force[3 * v]);
    force = (held * force).eval();
    store(held * whole, z);
    store(Eigen::Matrix3d::Identity() - held, &side.kept_share[6 * v]);
  }
}

}  // namespace

void begin_span_loads(SolidSide& side, const SpanStart& start) {
  const double share = (start.expects ? corrected_share : 1.0) / start.span;
  const double expected_share = start.expects ? 1.0 - 0.5 * share * start.last_window : 0.0;
  side.span_force.resize(side.fluid_impulse.size());
  for (std::size_t i = 0; i < side.span_force.size(); ++i)
    side.span_force[i] = expected_share * side.expected_force[i] + share * side.fluid_impulse[i];
  side.kept_share.assign(2 * side.span_force.size(), 0.0);
  if (!start.expects) return;
  if (start.span > start.last_span)
    for (double& z : side.impedance) z *= start.span / start.last_span;
  hold_over_window(side, start.window);
}

Impulse hand_on_fluid_loads(SolidSide& side, double acting_time) {
  Impulse handed{};
  side.fluid_force.resize(side.fluid_impulse.size());
  side.span_force.resize(side.fluid_impulse.size());
  side.kept_share.resize(2 * side.fluid_impulse.size());
  for (std::size_t v = 0; v < side.vertices(); ++v) {
    const double *now = &side.velocities[3 * v], *seen = &side.seen_velocity[3 * v];
    double* force = &side.fluid_force[3 * v];
    const std::array<double, 3> last{force[0], force[1], force[2]};
    for (std::size_t d = 0; d < 3; ++d) force[d] = side.span_force[3 * v + d];
    add_product(&side.impedance[6 * v], seen[0] - now[0], seen[1] - now[1], seen[2] - now[2], force);
    add_product(&side.kept_share[6 * v], last[0], last[1], last[2], force);
    for (std::size_t d = 0; d < 3; ++d) {
      side.fluid_impulse[3 * v + d] -= acting_time * force[d];
      handed[d] += acting_time * force[d];
    }
  }
  return handed;
}

}  // namespace polynya::coupler
