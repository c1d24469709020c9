#include "ice_solver/set_loads.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>

namespace polynya::ice {
namespace {

using Eigen::Vector3d;

/// Component of a curve at a time.
double value_at(const LoadCurve& curve, std::size_t component, double time) {
  const std::size_t width = curve.rows.size() / curve.times.size();
  const auto later =
      static_cast<std::size_t>(std::upper_bound(curve.times.begin(), curve.times.end(), time) - curve.times.begin());
  const auto value = [&](std::size_t row) { return curve.rows[row * width + component]; };
  if (later == 0) return value(0);
  if (later == curve.times.size()) return value(later - 1);
  const double begin = curve.times[later - 1], part = (time - begin) / (curve.times[later] - begin);
  return (1 - part) * value(later - 1) + part * value(later);
}

/// Integrals of the four shape functions times the outward area vector over a bilinear face, m^2. Two by two points are
/// exact: the integrand is of second order along each edge.
std::array<Vector3d, 4> weighted_areas(const std::array<Vector3d, 4>& corner) {
  static constexpr double signs[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  const double at = 1 / std::sqrt(3.0);
  std::array<Vector3d, 4> sum{Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero()};
  for (const auto& point : signs) {
    const double a = at * point[0], b = at * point[1];
    double shape[4];
    Vector3d along_a = Vector3d::Zero(), along_b = Vector3d::Zero();
    for (int k = 0; k < 4; ++k) {
      const double s = signs[k][0], t = signs[k][1];
      shape[k] = 0.25 * (1 + s * a) * (1 + t * b);
      along_a += 0.25 * s * (1 + t * b) * corner[k];
      along_b += 0.25 * t * (1 + s * a) * corner[k];
    }
    const Vector3d area = along_a.cross(along_b);
    for (int k = 0; k < 4; ++k) sum[k] += shape[k] * area;
  }
  return sum;
}

std::array<Vector3d, 4> places(const std::vector<double>& positions, const std::array<std::int32_t, 4>& corners) {
  std::array<Vector3d, 4> at;
  for (std::size_t k = 0; k < 4; ++k) at[k] = Eigen::Map<const Vector3d>(&positions[3 * corners[k]]);
  return at;
}

}  // namespace

SetLoads::SetLoads(const continuum::ExplicitSolid& solid, const continuum::FaceNeighbours& neighbours,
                   std::span<const SetLoad> loads) {
  for (const SetLoad& load : loads) {
    std::vector<std::int32_t> faces = continuum::outer_faces_within(solid.mesh, neighbours, load.nodes);
    if (load.kind == SetLoad::Kind::force) {
      forces_.push_back(shared(solid, load, faces));
      continue;
    }
    if (faces.empty())
      throw std::invalid_argument(
          "ice.pressures." + load.name +
          ": the set has no face on the surface of the mesh; it must hold all four nodes of one");
    pressures_.push_back({load.curve, std::move(faces)});
  }
  if (!empty()) force_.assign(3 * solid.node_count(), 0.0);
}

SetLoads::Force SetLoads::shared(const continuum::ExplicitSolid& solid, const SetLoad& load,
                                 std::span<const std::int32_t> faces) {
  std::map<std::int32_t, double> shares;
  for (const std::int32_t face : faces) {
    const auto corners = continuum::nodes_of_face(solid.mesh, face);
    const auto areas = weighted_areas(places(solid.mesh.nodes, corners));
    const Vector3d normal = (areas[0] + areas[1] + areas[2] + areas[3]).normalized();
    for (std::size_t k = 0; k < 4; ++k) shares[corners[k]] += normal.dot(areas[k]);
  }
  if (faces.empty())
    for (const std::int32_t n : load.nodes) shares[n] = 1;
  double whole = 0;
  for (const auto& [node, share] : shares) whole += share;
  Force force{load.curve, {}, {}};
  for (const auto& [node, share] : shares) force.nodes.push_back(node), force.shares.push_back(share / whole);
  return force;
}

std::span<const double> SetLoads::at(const continuum::ExplicitSolid& solid) {
  std::fill(force_.begin(), force_.end(), 0.0);
  for (const Pressure& load : pressures_) {
    const double pressure = value_at(load.curve, 0, solid.time);
    for (const std::int32_t face : load.faces) {
      if (solid.element.alive[face / 6] == 0) continue;
      const auto corners = continuum::nodes_of_face(solid.mesh, face);
      const auto areas = weighted_areas(places(solid.positions, corners));
      for (std::size_t k = 0; k < 4; ++k) Eigen::Map<Vector3d>(&force_[3 * corners[k]]) -= pressure * areas[k];
    }
  }
  for (const Force& load : forces_)
    for (std::size_t c = 0; c < 3; ++c) {
      const double whole = value_at(load.curve, c, solid.time);
      for (std::size_t k = 0; k < load.nodes.size(); ++k)
        if (solid.masses[load.nodes[k]] > 0) force_[3 * load.nodes[k] + c] += load.shares[k] * whole;
    }
  return force_;
}

}  // namespace polynya::ice
