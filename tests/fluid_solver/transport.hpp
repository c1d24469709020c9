#pragma once
#include <array>
#include <cmath>
#include <vector>

#include "fluid_solver/fluid.hpp"
#include "fluid_solver/phases.hpp"

/// The remap alone, with velocities given: two materials of density 1 in a unit cube, moved by volumes through faces.
namespace polynya::fluid::test {

/// fraction(i, j, k): part of the first material in each cell.
template <class Fraction>
Fluid transported(int cells, Fraction&& fraction) {
  Setup setup;
  setup.law = {IdealGas{1.4}, IdealGas{1.4}};
  setup.pressure_floor = {0, 0};
  setup.boundary.fill(Boundary::non_reflecting);
  std::vector<double> line;
  for (int i = 0; i <= cells; ++i) line.push_back(static_cast<double>(i) / cells);
  Fluid fluid(Grid(line, line, line), setup);
  fill(fluid, {}, [&](int i, int j, int k) {
    CellState state;
    state.fraction[0] = fraction(i, j, k);
    state.fraction[1] = 1 - state.fraction[0];
    state.density = {1, 1};
    state.specific_energy = {1, 1};
    return state;
  });
  return fluid;
}

/// One remap; rate(axis, i, j, k): volume per time through the lower face of a cell, without sources or sinks.
template <class Rate>
void transport(Fluid& fluid, double dt, Rate&& rate) {
  const Grid& grid = fluid.grid;
  for (int k = 1; k <= grid.nz + 1; ++k) {
    for (int j = 1; j <= grid.ny + 1; ++j) {
      for (int i = 1; i <= grid.nx + 1; ++i) {
        for (int axis = 0; axis < 3; ++axis) fluid.face_rate[axis][grid.at(i, j, k)] = rate(axis, i, j, k);
      }
    }
  }
  fluid.sweep_volume = fluid.after.volume;
  // Which rows hold what, as a step would find it.
  std::fill(fluid.row_materials.begin(), fluid.row_materials.end(), 0);
  for (int k = 1; k <= grid.nz; ++k) {
    for (int j = 1; j <= grid.ny; ++j) {
      unsigned char& row = fluid.row_materials[static_cast<std::size_t>(j + (grid.ny + 3) * k)];
      for (int i = 1; i <= grid.nx; ++i) {
        for (int m = 0; m < 2; ++m) row |= fluid.material[m].mass[grid.at(i, j, k)] > 0 ? 1 << m : 0;
      }
    }
  }
  remap_cells(fluid, dt);
  ++fluid.steps;
}

struct VortexResult {
  double volume_error = 0;  ///< largest change of the volume, relative
  double bound_error = 0;   ///< most by which a cell is over-full or over-empty, of the cell
  double shape_error = 0;   ///< sum of |fraction - exact| times the cell volume
};

/// A sphere in the three-dimensional deforming vortex, there and back in a time of 3 (Enright et al. 2002, J. Comput.
/// Phys. 183:83), half a cell per step. `look` is called with the fluid and the time after every step.
template <class Look>
VortexResult run_vortex(int cells, Look&& look) {
  const double h = 1.0 / cells, period = 3.0, pi = std::acos(-1.0);
  const auto sphere_part = [&](int i, int j, int k) {  // 8^3 points, for cells near the surface 20^3
    const auto part = [&](int points) {
      long inside = 0;
      for (int a = 0; a < points; ++a) {
        for (int b = 0; b < points; ++b) {
          for (int c = 0; c < points; ++c) {
            const double x = h * (i - 1 + (a + 0.5) / points) - 0.35, y = h * (j - 1 + (b + 0.5) / points) - 0.35;
            const double z = h * (k - 1 + (c + 0.5) / points) - 0.35;
            inside += x * x + y * y + z * z < 0.15 * 0.15;
          }
        }
      }
      return static_cast<double>(inside) / (points * points * points);
    };
    const double rough = part(2),
                 distance = std::hypot(h * (i - 0.5) - 0.35, h * (j - 0.5) - 0.35, h * (k - 0.5) - 0.35);
    return std::abs(distance - 0.15) > h ? rough : part(20);
  };
  Fluid fluid = transported(cells, sphere_part);
  const std::vector<double> start = fluid.material[water].volume;
  const auto sum = [](const std::vector<double>& values) {
    double total = 0;
    for (const double v : values) total += v;
    return total;
  };
  // Integrals of the velocity over faces, exact, so that what flows into a cell flows out of it.
  const auto integral = [&](int n) {
    return (std::cos(2 * pi * h * (n - 1)) - std::cos(2 * pi * h * n)) / (2 * pi);
  };  // of sin(2 pi s)
  VortexResult result;
  const double volume = sum(start), cell = h * h * h;
  const int steps = static_cast<int>(std::ceil(period * 2.0 / (0.5 * h)));
  const double dt = period / steps;
  for (int n = 0; n < steps; ++n) {
    const double now = std::cos(pi * (n + 0.5) * dt / period);
    transport(fluid, dt, [&](int axis, int i, int j, int k) {
      const std::array<int, 3> index{i, j, k};
      const double along = std::sin(pi * h * (index[axis] - 1));
      double q = now * (axis == 0 ? 2.0 : -1.0) * along * along;
      for (const int other : {(axis + 1) % 3, (axis + 2) % 3}) q *= integral(index[other]);
      return q;
    });
    look(fluid, (n + 1) * dt);
    result.volume_error = std::max(result.volume_error, std::abs(sum(fluid.material[water].volume) - volume) / volume);
    for (std::size_t c = 0; c < start.size(); ++c) {
      for (const Material& m : fluid.material)
        result.bound_error =
            std::max(result.bound_error, std::max(-m.volume[c], m.volume[c] - fluid.after.volume[c]) / cell);
    }
  }
  for (std::size_t c = 0; c < start.size(); ++c)
    result.shape_error += std::abs(fluid.material[water].volume[c] - start[c]);
  return result;
}
inline VortexResult run_vortex(int cells) {
  return run_vortex(cells, [](const Fluid&, double) {});
}

}  // namespace polynya::fluid::test
