#include "ice_solver/background.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/compute/parallel.hpp"

namespace polynya::ice {
namespace {

/// A coarse grid over the particles in which the surroundings of every particle are marked.
class MarkedCells {
 public:
  MarkedCells(const std::vector<double>& positions, std::array<double, 3> low, std::array<double, 3> high, double cell)
      : low_(low), cell_(cell) {
    std::size_t total = 1;
    for (int a = 0; a < 3; ++a) {
      number_[a] = static_cast<std::int64_t>((high[a] - low[a]) / cell) + 1;
      total *= static_cast<std::size_t>(number_[a]);
    }
    marked_.assign(total, 0);
    for (std::size_t i = 0; i < positions.size(); i += 3) mark(&positions[i]);
  }

  bool contains(const std::array<double, 3>& x) const {
    std::array<std::int64_t, 3> c;
    for (int a = 0; a < 3; ++a) {
      c[a] = coordinate(x[a], a);
      if (c[a] < 0 || c[a] >= number_[a]) return false;
    }
    return marked_[index(c[0], c[1], c[2])];
  }

 private:
  std::int64_t coordinate(double x, int axis) const {
    const double scaled = std::floor((x - low_[axis]) / cell_);
    return static_cast<std::int64_t>(std::clamp(scaled, -2.0, static_cast<double>(number_[axis]) + 1));
  }
  std::size_t index(std::int64_t i, std::int64_t j, std::int64_t k) const {
    return static_cast<std::size_t>(i + number_[0] * (j + number_[1] * k));
  }
  void mark(const double* x) {
    std::array<std::int64_t, 3> from, to;
    for (int a = 0; a < 3; ++a) {
      const std::int64_t c = coordinate(x[a], a);
      from[a] = std::max<std::int64_t>(c - 1, 0);
      to[a] = std::min(c + 1, number_[a] - 1);
    }
    for (std::int64_t k = from[2]; k <= to[2]; ++k)
      for (std::int64_t j = from[1]; j <= to[1]; ++j)
        for (std::int64_t i = from[0]; i <= to[0]; ++i) marked_[index(i, j, k)] = 1;
  }

  std::array<double, 3> low_;
  double cell_;
  std::array<std::int64_t, 3> number_{};
  std::vector<char> marked_;
};

/// The middle of two opposite corners: close enough to the centre to choose by.
std::array<double, 3> rough_centre(const continuum::ExplicitSolid& solid, std::size_t e) {
  const std::size_t a = static_cast<std::size_t>(solid.mesh.elements[8 * e]),
                    b = static_cast<std::size_t>(solid.mesh.elements[8 * e + 6]);
  return {0.5 * (solid.positions[3 * a] + solid.positions[3 * b]),
          0.5 * (solid.positions[3 * a + 1] + solid.positions[3 * b + 1]),
          0.5 * (solid.positions[3 * a + 2] + solid.positions[3 * b + 2])};
}

}  // namespace

std::array<double, 3> reference_centre(const continuum::ExplicitSolid& solid, std::size_t element) {
  std::array<double, 3> centre{};
  for (std::size_t a = 0; a < 8; ++a)
    for (std::size_t c = 0; c < 3; ++c)
      centre[c] += solid.mesh.nodes[3 * static_cast<std::size_t>(solid.mesh.elements[8 * element + a]) + c] / 8;
  return centre;
}

double smoothing_length_of(double volume) {
  return 1.2 * std::cbrt(volume);
}

void select_background(Background& background, const continuum::ExplicitSolid& solid, const Points& particles,
                       double reach, double largest_smoothing_length) {
  background.elements.clear();
  if (particles.count() > 0) {
    // Only particles near the body matter: debris that flies far must not blow up the grid.
    std::array<double, 3> low, high;
    for (int a = 0; a < 3; ++a) {
      low[a] = high[a] = solid.positions[static_cast<std::size_t>(a)];
      for (std::size_t n = 0; n < solid.node_count(); ++n) {
        if (solid.living_elements[n] == 0) continue;
        low[a] = std::min(low[a], solid.positions[3 * n + a]);
        high[a] = std::max(high[a], solid.positions[3 * n + a]);
      }
    }
    const double margin = 1.25 * reach;  // for the difference between the rough centre and the centre
    const MarkedCells cells(particles.position, low, high, margin);
    std::vector<char> chosen(solid.element_count(), 0);
    compute::for_chunks(solid.element_count(), 4096, [&](std::size_t begin, std::size_t end) {
      for (std::size_t e = begin; e < end; ++e)
        chosen[e] = solid.element.alive[e] != 0 && cells.contains(rough_centre(solid, e));
    });
    for (std::size_t e = 0; e < chosen.size(); ++e)
      if (chosen[e]) background.elements.push_back(static_cast<std::int32_t>(e));
  }
  Points& points = background.points;
  points.resize(background.elements.size());
  for (std::size_t k = 0; k < points.count(); ++k) {
    const auto e = static_cast<std::size_t>(background.elements[k]);
    points.mass[k] = solid.element.mass[e];
    const std::array<double, 3> origin = reference_centre(solid, e);
    std::copy(origin.begin(), origin.end(), points.origin.begin() + static_cast<std::ptrdiff_t>(3 * k));
    points.bond_reach[k] = smoothing_length_of(solid.element.reference_volume[e]);
    points.smoothing_length[k] =
        std::min(smoothing_length_of(solid.element.reference_volume[e]), largest_smoothing_length);
  }
  refresh_background(background, solid);
}

void refresh_background(Background& background, const continuum::ExplicitSolid& solid) {
  Points& points = background.points;
  compute::for_chunks(points.count(), 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const auto e = static_cast<std::size_t>(background.elements[k]);
      double x[3] = {0, 0, 0}, v[3] = {0, 0, 0};
      for (std::size_t a = 0; a < 8; ++a) {
        const std::size_t n = 3 * static_cast<std::size_t>(solid.mesh.elements[8 * e + a]);
        for (std::size_t c = 0; c < 3; ++c) x[c] += solid.positions[n + c], v[c] += solid.velocities[n + c];
      }
      for (std::size_t c = 0; c < 3; ++c) points.position[3 * k + c] = x[c] / 8, points.velocity[3 * k + c] = v[c] / 8;
      for (std::size_t c = 0; c < 6; ++c) points.stress[6 * k + c] = solid.element.stress[c][e];
      points.density[k] = solid.element.mass[e] / solid.element.volume[e];
    }
  });
}

void spread_background_forces(const Background& background, const continuum::ExplicitSolid& solid,
                              std::vector<double>& nodal_force) {
  for (std::size_t k = 0; k < background.elements.size(); ++k) {
    const auto e = static_cast<std::size_t>(background.elements[k]);
    for (std::size_t a = 0; a < 8; ++a) {
      const std::size_t n = 3 * static_cast<std::size_t>(solid.mesh.elements[8 * e + a]);
      for (std::size_t c = 0; c < 3; ++c) nodal_force[n + c] += background.points.force[3 * k + c] / 8;
    }
  }
}

}  // namespace polynya::ice
