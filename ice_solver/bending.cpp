#include "ice_solver/bending.hpp"

#include <algorithm>
#include <cmath>
#include <map>
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

/// Nodes of the section x at half height; where no line of nodes runs there, those of the two nearest ones.
std::vector<std::int32_t> axis_at(const IceBody& beam, double x) {
  const auto& z = beam.options.z;
  const double middle = 0.5 * (z.front() + z.back());
  const double reach = std::abs(nearest(z, middle) - middle) + 1e-9;
  std::vector<std::int32_t> nodes;
  for (const double line : z)
    if (std::abs(line - middle) <= reach) add_line(nodes, beam, x, line);
  return nodes;
}

double mean_sinking(const std::vector<std::int32_t>& nodes, const IceBody& beam) {
  double sum = 0;
  for (const std::int32_t node : nodes) {
    const std::size_t k = 3 * static_cast<std::size_t>(node) + 2;
    sum += beam.solid.mesh.nodes[k] - beam.solid.positions[k];
  }
  return sum / static_cast<double>(nodes.size());
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
  rig.width = (beam.options.planes.y ? 2 : 1) * (beam.options.y.back() - beam.options.y.front());
  rig.height = beam.options.z.back() - beam.options.z.front();
  rig.support_axis = axis_at(beam, nearest(beam.options.x, 0.5 * support_span));
  rig.middle_axis = axis_at(beam, nearest(beam.options.x, 0));
  return rig;
}

void move_rollers(BendingRig& rig, IceBody& beam, double time, double dt) {
  const double velocity = rig.speed * smooth_ramp(time + 0.5 * dt, rig.ramp_time);
  for (const std::int32_t node : rig.loads) {
    const auto n = static_cast<std::size_t>(node);
    continuum::wake(beam.solid, n);
    double& v = beam.solid.velocities[3 * n + 2];
    // The account has opened this step with the old velocity: kinetic energy, and half a step of the work of the
    // reaction and of the elements.
    const double opened = 0.5 * dt * beam.solid.internal_force[3 * n + 2] * (-velocity - v);
    beam.books.prescribed_work += 0.5 * beam.solid.masses[n] * (velocity * velocity - v * v) - opened;
    beam.solid.pending_internal_work -= opened;
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

double sag(const BendingRig& rig, const IceBody& beam) {
  return mean_sinking(rig.middle_axis, beam) - mean_sinking(rig.support_axis, beam);
}

double timoshenko_flexibility(const BendingRig& rig, const continuum::Elastic& law) {
  const double k = law.bulk_modulus, g = law.shear_modulus, youngs_modulus = 9 * k * g / (3 * k + g);
  const double nu = youngs_modulus / (2 * g) - 1, shear_coefficient = 10 * (1 + nu) / (12 + 11 * nu);
  const double area = rig.width * rig.height, inertia = area * rig.height * rig.height / 12, a = rig.arm();
  return a * (3 * rig.support_span * rig.support_span - 4 * a * a) / (48 * youngs_modulus * inertia) +
         a / (2 * shear_coefficient * g * area);
}

double outer_fibre_stress(const BendingRig& rig, double load) {
  return 3 * load * rig.arm() / (rig.width * rig.height * rig.height);
}

Cracks count_cracks(const BendingRig& rig, const IceBody& beam) {
  struct Section {
    int elements = 0, fractured = 0;
  };
  std::map<long, Section> sections;  // by the number of the grid line that begins it
  const auto& x = beam.options.x;
  for (std::size_t e = 0; e < beam.solid.element_count(); ++e) {
    const double left = beam.solid.mesh.nodes[3 * static_cast<std::size_t>(beam.solid.mesh.elements[8 * e])];
    Section& section = sections[std::lower_bound(x.begin(), x.end(), left - 1e-9) - x.begin()];
    ++section.elements;
    if (beam.solid.element.damage[e] > 0.9) ++section.fractured;
  }
  Cracks cracks;
  long last = -2;
  for (const auto& [i, section] : sections) {
    if (2 * section.fractured < section.elements) continue;
    if (i != last + 1) {
      const auto k = static_cast<std::size_t>(i);
      const bool on_plane = beam.options.planes.x && i == 0;  // one with its mirror image
      const int count = beam.options.planes.x && !on_plane ? 2 : 1;
      cracks.all += count;
      if (std::abs(0.5 * (x[k] + x[k + 1])) < 0.5 * rig.load_span) cracks.between_loads += count;
    }
    last = i;
  }
  return cracks;
}

}  // namespace polynya::ice
