#include "structure_solver/stress_probe.hpp"

#include <algorithm>
#include <cmath>

namespace polynya::structure {
namespace {

constexpr double tip_depth = 2e-3;           // m, the head stress of the paper's figures
constexpr double least_slice_half = 0.5e-3;  // m

std::vector<double> element_depths(const continuum::ExplicitSolid& solid, const Launch& launch) {
  std::vector<double> depths(solid.element_count());
  const Eigen::Vector3d nose = launch.nose(), axis = launch.axis();
  for (std::size_t e = 0; e < depths.size(); ++e) {
    Eigen::Vector3d sum(0, 0, 0);
    for (int corner = 0; corner < 8; ++corner)
      sum += Eigen::Vector3d::Map(&solid.mesh.nodes[3 * solid.mesh.elements[8 * e + corner]]);
    depths[e] = (nose - 0.125 * sum).dot(axis);
  }
  return depths;
}

std::vector<std::int32_t> within(const std::vector<double>& depths, double from, double to) {
  std::vector<std::int32_t> found;
  for (std::size_t e = 0; e < depths.size(); ++e)
    if (depths[e] >= from && depths[e] <= to) found.push_back(static_cast<std::int32_t>(e));
  return found;
}

double volume_average(const continuum::ExplicitSolid& solid, const std::vector<std::int32_t>& elements) {
  double stress = 0, volume = 0;
  for (const std::int32_t e : elements) {
    stress += solid.element.volume[e] * von_mises(solid, e);
    volume += solid.element.volume[e];
  }
  return volume > 0 ? stress / volume : 0;
}

}  // namespace

StressProbe::StressProbe(const continuum::ExplicitSolid& solid, const Launch& launch) {
  const std::vector<double> depths = element_depths(solid, launch);
  const double first = *std::min_element(depths.begin(), depths.end());
  head_ = within(depths, -1e300, std::max(tip_depth, first * (1 + 1e-9)));
  const double half = std::max(least_slice_half, 0.5 * launch.element_size) * (1 + 1e-9);
  for (int s = 0; s < station_count; ++s) {
    const double station = launch.length * s / (station_count - 1);
    double nearest = 1e300;
    for (const double depth : depths) nearest = std::min(nearest, std::abs(depth - station));
    const double reach = std::max(half, nearest * (1 + 1e-9));
    slices_[s] = within(depths, station - reach, station + reach);
  }
}

double StressProbe::head_average(const continuum::ExplicitSolid& solid) const {
  return volume_average(solid, head_);
}

double StressProbe::head_maximum(const continuum::ExplicitSolid& solid) const {
  double largest = 0;
  for (const std::int32_t e : head_) largest = std::max(largest, von_mises(solid, e));
  return largest;
}

std::array<double, station_count> StressProbe::stations(const continuum::ExplicitSolid& solid) const {
  std::array<double, station_count> values{};
  for (int s = 0; s < station_count; ++s) values[s] = volume_average(solid, slices_[s]);
  return values;
}

double von_mises(const continuum::ExplicitSolid& solid, std::size_t e) {
  const auto& s = solid.element.stress;
  const double xy = s[0][e] - s[1][e], yz = s[1][e] - s[2][e], zx = s[2][e] - s[0][e];
  const double shear = s[3][e] * s[3][e] + s[4][e] * s[4][e] + s[5][e] * s[5][e];
  return std::sqrt(0.5 * (xy * xy + yz * yz + zx * zx) + 3 * shear);
}

}  // namespace polynya::structure
