#include "tests/core/contact/hertz.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "core/continuum/law.hpp"

namespace polynya::contact::testing {
namespace {

constexpr double quarter_turn = 1.5707963267948966;
constexpr double sphere_mass = 4.0 / 3 * 2 * quarter_turn;
constexpr double inner = 0.55;  // half edge of the cube inside the sphere

/// From 0 to `length`: cells of `fine` out to `reach`, then growing by two fifths.
std::vector<double> graded(double fine, double reach, double length) {
  std::vector<double> line{0};
  double cell = fine;
  while (line.back() < length) {
    line.push_back(line.back() + cell);
    if (line.back() > reach) cell *= 1.4;
  }
  for (double& x : line) x *= length / line.back();
  return line;
}

using Grid = std::vector<double>;

/// Blocks of hexahedra whose nodes are joined where they coincide.
struct Blocks {
  continuum::HexMesh mesh;
  std::map<std::array<long, 3>, std::int32_t> known;

  std::int32_t node(const Vector3& x) {
    const std::array<long, 3> key{std::lround(1e9 * x[0]), std::lround(1e9 * x[1]), std::lround(1e9 * x[2])};
    const auto [at, is_new] = known.try_emplace(key, static_cast<std::int32_t>(mesh.node_count()));
    if (is_new)
      for (const double c : x) mesh.nodes.push_back(c == 0 ? 0.0 : c);
    return at->second;
  }
  /// place(i, j, k) must be right-handed.
  template <class Place>
  void add(std::size_t ni, std::size_t nj, std::size_t nk, Place&& place) {
    for (std::size_t k = 0; k + 1 < nk; ++k)
      for (std::size_t j = 0; j + 1 < nj; ++j)
        for (std::size_t i = 0; i + 1 < ni; ++i)
          for (const auto& c :
               {std::array{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}})
            mesh.elements.push_back(node(place(i + static_cast<std::size_t>(c[0]), j + static_cast<std::size_t>(c[1]),
                                               k + static_cast<std::size_t>(c[2]))));
  }
};

/// A bulging cube inside, and a shell between its faces and the sphere. c: a point of the cube, edges 2.
Vector3 in_cube(const Vector3& c) {
  const double most = std::max({std::abs(c[0]), std::abs(c[1]), std::abs(c[2])});
  return most == 0 ? Vector3{} : (inner * (0.5 + 0.5 * most / norm(c))) * c;
}
Vector3 in_shell(const Vector3& c, double outward) {
  return (1 - outward) * in_cube(c) + (outward / norm(c)) * c;
}

continuum::HexMesh quarter_of_a_ball(double fine, double reach) {
  Grid side = graded(fine, reach, quarter_turn / 2), depth = graded(fine, reach, 1 - inner);
  for (double& x : side) x = std::tan(x);
  side.back() = 1;
  for (double& t : depth) t = 1 - t / (1 - inner);
  std::reverse(depth.begin(), depth.end());  // from the cube outward
  Grid up;
  for (int k = 0; k <= 6; ++k) up.push_back(std::tan(quarter_turn / 2 * (k / 3.0 - 1)));
  up.front() = -1, up.back() = 1, up[3] = 0;
  const std::size_t n = side.size(), m = up.size(), l = depth.size();
  Blocks blocks;
  blocks.add(n, n, m, [&](std::size_t i, std::size_t j, std::size_t k) { return in_cube({side[i], side[j], up[k]}); });
  blocks.add(n, n, l, [&](std::size_t i, std::size_t j, std::size_t k) {
    return in_shell({side[j], side[i], -1}, depth[k]);
  });
  blocks.add(n, n, l, [&](std::size_t i, std::size_t j, std::size_t k) {
    return in_shell({side[i], side[j], 1}, depth[k]);
  });
  blocks.add(n, m, l, [&](std::size_t i, std::size_t j, std::size_t k) {
    return in_shell({1, side[i], up[j]}, depth[k]);
  });
  blocks.add(m, n, l, [&](std::size_t i, std::size_t j, std::size_t k) {
    return in_shell({side[j], 1, up[i]}, depth[k]);
  });
  return std::move(blocks.mesh);
}

}  // namespace

Sphere::Sphere(double fine, double reach, double height, double speed, bool turned) {
  const double e = hertz_youngs_modulus, nu = hertz_poisson_ratio;
  continuum::Numerics numerics;
  numerics.linear_viscosity = numerics.quadratic_viscosity = numerics.hourglass_viscosity = 0;  // an elastic sphere
  continuum::HexMesh mesh = quarter_of_a_ball(fine, reach);
  for (std::size_t k = 2; k < mesh.nodes.size(); k += 3) {
    mesh.nodes[k] += 1 + height;
    if (!turned) continue;
    std::swap(mesh.nodes[k - 2], mesh.nodes[k - 1]);
    mesh.nodes[k] *= -1;
  }
  continuum::Elastic law{1, e / (3 * (1 - 2 * nu)), e / (2 * (1 + nu))};
  solid = continuum::make_solid("sphere", mesh, law, numerics);
  // Flat faces cut a little off the sphere; its mass is what counts.
  law.density = sphere_mass / (4 * std::accumulate(solid.masses.begin(), solid.masses.end(), 0.0));
  solid = continuum::make_solid("sphere", std::move(mesh), law, numerics);
  const std::array planes{continuum::Plane{{1, 0, 0}, 0}, continuum::Plane{{0, 1, 0}, 0}};
  for (std::size_t n = 0; n < solid.node_count(); ++n) {
    for (std::size_t d = 0; d < 2; ++d)
      if (solid.positions[3 * n + d] == 0) solid.fixed[n] |= static_cast<std::uint8_t>(1u << d);
    solid.velocities[3 * n + 2] = turned ? speed : -speed;
  }
  const std::vector<double> alive(solid.element_count(), 1.0);
  surface = continuum::boundary_surface(solid.mesh, continuum::face_neighbours(solid.mesh), alive, planes);
  nodal_force.assign(3 * solid.node_count(), 0.0);
}

Mesh Sphere::contact_mesh() const {
  Mesh mesh;
  for (const std::int32_t n : surface.nodes)
    mesh.add_point(row(solid.positions, static_cast<std::size_t>(n)),
                   row(solid.velocities, static_cast<std::size_t>(n)), solid.masses[static_cast<std::size_t>(n)]);
  mesh.triangles = surface.triangles;
  return mesh;
}

void Sphere::refresh(Mesh& mesh) const {
  for (std::size_t i = 0; i < surface.nodes.size(); ++i)
    for (std::size_t d = 0; d < 3; ++d) {
      mesh.positions[3 * i + d] = solid.positions[3 * static_cast<std::size_t>(surface.nodes[i]) + d];
      mesh.velocities[3 * i + d] = solid.velocities[3 * static_cast<std::size_t>(surface.nodes[i]) + d];
    }
}

void Sphere::step(const std::vector<double>& surface_force, double dt_before, double dt_after) {
  std::fill(nodal_force.begin(), nodal_force.end(), 0.0);
  for (std::size_t i = 0; i < surface.nodes.size(); ++i)
    for (std::size_t d = 0; d < 3; ++d)
      nodal_force[3 * static_cast<std::size_t>(surface.nodes[i]) + d] = surface_force[3 * i + d];
  continuum::internal_forces(solid, dt_before);
  continuum::advance_velocities(solid, nodal_force, dt_before, dt_after);
}

double Sphere::momentum() const {
  double sum = 0;
  for (std::size_t n = 0; n < solid.node_count(); ++n) sum += solid.masses[n] * solid.velocities[3 * n + 2];
  return 4 * sum;
}

HertzImpact::HertzImpact(double modulus, double speed) {
  const double mass = sphere_mass;
  duration = 2.8683 * std::pow(mass * mass / (modulus * modulus * speed), 0.2);
  approach = std::pow(15 * mass * speed * speed / (16 * modulus), 0.4);
  peak_force = 4.0 / 3 * modulus * std::pow(approach, 1.5);
  contact_radius = std::sqrt(approach);
}

Impact sphere_on_plane(double elements_per_radius, double step, const ContactLaw& law, double speed,
                       double tangential_speed) {
  const double modulus = hertz_youngs_modulus / (1 - hertz_poisson_ratio * hertz_poisson_ratio);
  const HertzImpact hertz(modulus, speed);
  const double fine = hertz.contact_radius / elements_per_radius;
  Sphere sphere(fine, 1.3 * hertz.contact_radius, 1e-6 * hertz.approach, speed);
  Mesh ball = sphere.contact_mesh(), plane = floor_of(2);
  plane.set_velocity({tangential_speed, 0, 0});
  PenaltyContact contact(law);
  contact.set_topology(plane.body(), ball.body());
  const double dt = step * continuum::stable_step(sphere.solid), start = sphere.momentum();
  Impact impact;
  std::vector<double> force(ball.positions.size(), 0.0), last = force;
  sphere.step(force, 0, dt);
  double time = 0, first = -1, booked = 0, stored = 0, work = 0;
  for (bool over = false; !over && time < 3 * hertz.duration; time += dt) {
    continuum::advance_positions(sphere.solid, dt);
    plane.drift(dt);
    sphere.refresh(ball);
    // Work of the forces: half with the velocities before them, half with those after.
    for (std::size_t k = 0; k < last.size(); ++k)
      work += 0.5 * dt * last[k] * (ball.velocities[k] - plane.velocities[k % 3]);
    const ContactForces& forces = contact.evaluate(plane.body(), ball.body(), dt);
    for (std::size_t k = 0; k < last.size(); ++k)
      work += 0.5 * dt * forces.secondary[k] * (ball.velocities[k] - plane.velocities[k % 3]);
    booked += forces.friction_loss + forces.damping_loss + forces.released_energy;
    stored = forces.stored_energy;
    last = forces.secondary;
    double total = 0;
    for (std::size_t i = 0; i < ball.count(); ++i) total += 4 * last[3 * i + 2];
    impact.peak_force = std::max(impact.peak_force, total);
    if (total > 0 && first < 0) first = time;
    if (total > 0) impact.duration = time + dt - first;
    over = total == 0 && first >= 0 && time > first + 0.8 * hertz.duration;
    sphere.step(last, dt, dt);
  }
  impact.restitution = -sphere.momentum() / start;
  const double exchanged = 0.5 * sphere_mass / 4 * speed * speed;
  impact.lost = -work / exchanged;
  impact.account_error = std::abs(work + booked + stored) / exchanged;
  return impact;
}

Impact sphere_on_sphere(const std::array<double, 2>& elements_per_radius, double step, const ContactLaw& law,
                        double speed) {
  const HertzImpact hertz(hertz_youngs_modulus / (1 - hertz_poisson_ratio * hertz_poisson_ratio), speed);
  const double reach = 1.3 * hertz.contact_radius, height = 1e-6 * hertz.approach;
  Sphere lower(hertz.contact_radius / elements_per_radius[0], reach, height, speed, true);
  Sphere upper(hertz.contact_radius / elements_per_radius[1], reach, height, speed);
  Mesh below = lower.contact_mesh(), above = upper.contact_mesh();
  PenaltyContact contact(law);
  contact.set_topology(below.body(), above.body());
  const double dt = step * std::min(continuum::stable_step(lower.solid), continuum::stable_step(upper.solid));
  const double start = upper.momentum();
  lower.step(std::vector<double>(below.positions.size(), 0.0), 0, dt);
  upper.step(std::vector<double>(above.positions.size(), 0.0), 0, dt);
  Impact impact;
  double time = 0, first = -1;
  for (bool over = false; !over && time < 3 * hertz.duration; time += dt) {
    continuum::advance_positions(lower.solid, dt);
    continuum::advance_positions(upper.solid, dt);
    lower.refresh(below);
    upper.refresh(above);
    const ContactForces& forces = contact.evaluate(below.body(), above.body(), dt);
    double total = 0;
    for (std::size_t i = 0; i < above.count(); ++i) total += 4 * forces.secondary[3 * i + 2];
    impact.peak_force = std::max(impact.peak_force, total);
    if (total > 0 && first < 0) first = time;
    if (total > 0) impact.duration = time + dt - first;
    over = total == 0 && first >= 0 && time > first + 0.8 * hertz.duration;
    lower.step(forces.primary, dt, dt);
    upper.step(forces.secondary, dt, dt);
  }
  impact.restitution = (lower.momentum() - upper.momentum()) / (2 * start);
  impact.momentum_gained = (lower.momentum() + upper.momentum()) / start;
  return impact;
}

}  // namespace polynya::contact::testing
