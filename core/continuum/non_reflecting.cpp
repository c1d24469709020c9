#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>

#include "core/continuum/boundary_traction.hpp"
#include "core/continuum/explicit_solid.hpp"

/// Lysmer & Kuhlemeyer 1969: a dashpot rho c per area is the impedance of the medium beyond, so plane waves that arrive
/// along the normal leave without reflection.
namespace polynya::continuum {
namespace {

Eigen::Matrix3d symmetric(const double* c) {
  return (Eigen::Matrix3d() << c[0], c[3], c[5], c[3], c[1], c[4], c[5], c[4], c[2]).finished();
}

/// A quarter of the area of the boundary quadrilateral at each of its nodes, m^2.
std::map<std::int32_t, double> areas_on_plane(const ExplicitSolid& solid, const Plane& plane) {
  const auto neighbours = face_neighbours(solid.mesh);
  const Eigen::Map<const Eigen::Vector3d> normal(plane.normal.data());
  const auto node = [&](std::int32_t n) { return Eigen::Map<const Eigen::Vector3d>(&solid.mesh.nodes[3 * n]); };
  std::map<std::int32_t, double> areas;
  for (std::size_t e = 0; e < solid.element_count(); ++e) {
    if (solid.element.alive[e] == 0) continue;
    for (std::size_t f = 0; f < 6; ++f) {
      if (neighbours[6 * e + f] >= 0) continue;
      std::array<std::int32_t, 4> corner;
      for (std::size_t k = 0; k < 4; ++k) corner[k] = solid.mesh.elements[8 * e + element_faces[f][k]];
      const Eigen::Vector3d p = node(corner[2]) - node(corner[0]), q = node(corner[3]) - node(corner[1]);
      const double size = p.norm();
      bool on_plane = true;
      for (std::int32_t n : corner) on_plane = on_plane && std::abs(normal.dot(node(n)) - plane.offset) < 1e-6 * size;
      if (!on_plane) continue;
      const double area = 0.5 * p.cross(q).norm();
      for (std::int32_t n : corner) areas[n] += 0.25 * area;
    }
  }
  return areas;
}

/// Where each damped node stands in the list.
std::map<std::int32_t, std::size_t> damped_entries(const ExplicitSolid& solid) {
  std::map<std::int32_t, std::size_t> known;
  for (std::size_t k = 0; k < solid.damped.nodes.size(); ++k) known[solid.damped.nodes[k]] = k;
  return known;
}

/// The node's place in the list, to which it is added where it is not yet there.
std::size_t damped_entry(ExplicitSolid& solid, std::map<std::int32_t, std::size_t>& known, std::int32_t node) {
  const auto [entry, is_new] = known.emplace(node, solid.damped.nodes.size());
  if (is_new) {
    solid.damped.nodes.push_back(node);
    solid.damped.damping.insert(solid.damped.damping.end(), 6, 0.0);
    solid.damped.static_force.insert(solid.damped.static_force.end(), 3, 0.0);
  }
  return entry->second;
}

}  // namespace

void add_mass_damping(ExplicitSolid& solid, double rate) {
  std::map<std::int32_t, std::size_t> known = damped_entries(solid);
  for (std::size_t n = 0; n < solid.node_count(); ++n) {
    const std::size_t k = damped_entry(solid, known, static_cast<std::int32_t>(n));
    for (std::size_t c = 0; c < 3; ++c)
      if (!(solid.fixed[n] >> c & 1)) solid.damped.damping[6 * k + c] += rate * solid.masses[n];
  }
}

void add_non_reflecting_boundary(ExplicitSolid& solid, const Plane& plane) {
  const double rho = density(solid.law), normal_speed = longitudinal_wave_speed(solid.law),
               shear_speed = shear_wave_speed(solid.law);
  std::map<std::int32_t, std::size_t> known = damped_entries(solid);
  const int row[] = {0, 1, 2, 0, 1, 2}, column[] = {0, 1, 2, 1, 2, 0};
  for (const auto& [node, area] : areas_on_plane(solid, plane)) {
    const std::size_t entry = damped_entry(solid, known, node);
    for (int c = 0; c < 6; ++c) {
      const int i = row[c], j = column[c];
      if ((solid.fixed[node] >> i & 1) || (solid.fixed[node] >> j & 1)) continue;
      solid.damped.damping[6 * entry + c] +=
          rho * area *
          ((i == j ? shear_speed : 0.0) + (normal_speed - shear_speed) * plane.normal[i] * plane.normal[j]);
    }
  }
}

void add_non_reflecting_boundary(ExplicitSolid& solid, std::span<const std::int32_t> nodes) {
  const double rho = density(solid.law), normal_speed = longitudinal_wave_speed(solid.law),
               shear_speed = shear_wave_speed(solid.law);
  std::map<std::int32_t, std::size_t> known = damped_entries(solid);
  const auto node = [&](std::int32_t n) { return Eigen::Map<const Eigen::Vector3d>(&solid.mesh.nodes[3 * n]); };
  const int row[] = {0, 1, 2, 0, 1, 2}, column[] = {0, 1, 2, 1, 2, 0};
  for (const std::int32_t face : outer_faces_within(solid.mesh, face_neighbours(solid.mesh), nodes)) {
    if (solid.element.alive[face / 6] == 0) continue;
    const auto corner = nodes_of_face(solid.mesh, face);
    const Eigen::Vector3d twice =
        (node(corner[2]) - node(corner[0])).cross(Eigen::Vector3d(node(corner[3]) - node(corner[1])));
    const double area = 0.5 * twice.norm();
    const Eigen::Vector3d normal = twice.normalized();
    for (const std::int32_t n : corner) {
      const std::size_t entry = damped_entry(solid, known, n);
      for (int c = 0; c < 6; ++c) {
        const int i = row[c], j = column[c];
        if ((solid.fixed[n] >> i & 1) || (solid.fixed[n] >> j & 1)) continue;
        solid.damped.damping[6 * entry + c] +=
            0.25 * rho * area * ((i == j ? shear_speed : 0.0) + (normal_speed - shear_speed) * normal[i] * normal[j]);
      }
    }
  }
}

namespace {

/// What still pushes the body as a whole along an axis that no support holds goes to the boundary, by its damping.
void carry_rest(ExplicitSolid& solid, std::span<const double> external_force, std::size_t axis) {
  double rest = 0, damping = 0;
  for (std::size_t n = 0; n < solid.node_count(); ++n) {
    if (solid.fixed[n] >> axis & 1) return;
    rest += solid.internal_force[3 * n + axis] + external_force[3 * n + axis];
  }
  for (std::size_t k = 0; k < solid.damped.nodes.size(); ++k) {
    rest += solid.damped.static_force[3 * k + axis];
    damping += solid.damped.damping[6 * k + axis];
  }
  if (!(damping > 0)) return;
  for (std::size_t k = 0; k < solid.damped.nodes.size(); ++k)
    solid.damped.static_force[3 * k + axis] -= rest * solid.damped.damping[6 * k + axis] / damping;
}

}  // namespace

void hold_boundary_at_rest(ExplicitSolid& solid, std::span<const double> external_force) {
  for (std::size_t k = 0; k < solid.damped.nodes.size(); ++k) {
    const auto n = static_cast<std::size_t>(solid.damped.nodes[k]);
    for (std::size_t i = 0; i < 3; ++i)
      solid.damped.static_force[3 * k + i] = -(solid.internal_force[3 * n + i] + external_force[3 * n + i]);
  }
  for (std::size_t axis = 0; axis < 3; ++axis) carry_rest(solid, external_force, axis);
}

void add_boundary_traction(ExplicitSolid& solid, std::span<const double> external_force, double dt_previous,
                           double dt_next) {
  const double step = 0.5 * (dt_previous + dt_next);
  for (std::size_t k = 0; k < solid.damped.nodes.size(); ++k) {
    const auto n = static_cast<std::size_t>(solid.damped.nodes[k]);
    const double mass = solid.masses[n];
    if (!(mass > 0) || solid.sleeping.node_sleeps(n)) continue;
    const Eigen::Matrix3d damping = symmetric(&solid.damped.damping[6 * k]);
    const Eigen::Map<const Eigen::Vector3d> old(&solid.velocities[3 * n]), external(&external_force[3 * n]),
        held(&solid.damped.static_force[3 * k]);
    Eigen::Map<Eigen::Vector3d> internal(&solid.internal_force[3 * n]);
    Eigen::Vector3d rest = internal + external + held;
    for (int i = 0; i < 3; ++i)
      if (solid.fixed[n] >> i & 1) rest[i] = 0;  // its velocity stays
    // (m + C step/2) v_new = (m - C step/2) v_old + step rest: the traction is taken with the mean velocity.
    const Eigen::Matrix3d mass_matrix = mass * Eigen::Matrix3d::Identity();
    const Eigen::Vector3d now = (mass_matrix + 0.5 * step * damping)
                                    .llt()
                                    .solve(Eigen::Vector3d((mass_matrix - 0.5 * step * damping) * old + step * rest));
    const Eigen::Vector3d traction = -0.5 * damping * (old + now);
    solid.boundary_flux -= 0.5 * dt_previous * traction.dot(old);
    solid.pending_boundary_flux -= 0.5 * dt_next * traction.dot(now);
    for (int i = 0; i < 3; ++i) {
      if (solid.fixed[n] >> i & 1) continue;
      solid.external_work += 0.5 * dt_previous * held[i] * old[i];
      solid.pending_external_work += 0.5 * dt_next * held[i] * now[i];
      // advance_velocities books the work of all that stands in internal_force as that of the elements.
      solid.internal_work += 0.5 * dt_previous * (traction[i] + held[i]) * old[i];
      solid.pending_internal_work += 0.5 * dt_next * (traction[i] + held[i]) * now[i];
      internal[i] += traction[i] + held[i];
    }
  }
}

}  // namespace polynya::continuum
