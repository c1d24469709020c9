#pragma once
#include <algorithm>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "fluid_solver/fluid.hpp"
#include "tests/fluid_solver/slice_overlap.hpp"

/// Bodies that enter water in a slice one cell thick; the plane x = 0 is one of symmetry, the waterline is z = 0.
namespace polynya::fluid::test {

/// Open above, below and at the side; liquids take tension, so that nothing but the flow decides where the water is.
inline polynya::fluid::Setup slice_setup(double sound_speed, bool tank) {
  polynya::fluid::Setup setup;
  MieGrueneisen law;
  law.sound_speed = sound_speed;
  setup.law[water] = law;
  setup.pressure_floor = {-1e300, 0};
  const Boundary side = tank ? Boundary::wall : Boundary::non_reflecting;
  setup.boundary = {Boundary::wall, side, Boundary::wall, Boundary::wall, side, Boundary::non_reflecting};
  return setup;
}

/// Impulse of the fluid on the body along z per length of the slice, N s/m; half of the body's.
inline double lift_impulse(const Fluid& fluid) {
  return (fluid.account.body_impulse[0][2] + fluid.account.node_fix_impulse[2]) / (fluid.grid.y[1] - fluid.grid.y[0]);
}

/// Gauge pressure over x along the walls that look down, x ascending.
inline std::vector<std::pair<double, double>> pressure_below(const Fluid& fluid) {
  std::vector<std::pair<double, double>> along;
  for (const WallPiece& wall : fluid.after.walls) {
    if (wall.area[0][2] <= 0) continue;
    int i, j, k;
    fluid.grid.position(wall.cell, i, j, k);
    along.push_back({fluid.grid.centre_x(i), wall_pressure(fluid, wall.cell) - fluid.setup.atmospheric_pressure});
  }
  std::sort(along.begin(), along.end());
  return along;
}

/// Largest median of five neighbours.
inline double median_peak(const std::vector<std::pair<double, double>>& along) {
  double peak = 0;
  for (std::size_t n = 2; n + 2 < along.size(); ++n) {
    std::array<double, 5> five{};
    for (std::size_t m = 0; m < 5; ++m) five[m] = along[n - 2 + m].second;
    std::nth_element(five.begin(), five.begin() + 2, five.end());
    peak = std::max(peak, five[2]);
  }
  return peak;
}

inline double raw_peak(const std::vector<std::pair<double, double>>& along) {
  double peak = 0;
  for (const auto& [x, p] : along) peak = std::max(peak, p);
  return peak;
}

/// Water that does not fit into the room that the body leaves, m^3.
inline double water_inside(const Fluid& fluid) {
  double sum = 0;
  for (const WallPiece& wall : fluid.after.walls)
    sum += std::max(0.0, fluid.material[water].volume[wall.cell] - fluid.after.volume[wall.cell]);
  return sum;
}

/// Writes what docs/pictures/draw_water_entry.py draws: x, z, free part of the cell, water's part of what it holds,
/// gauge pressure, over the cells.
inline void write_field(const Fluid& fluid, const std::string& path) {
  std::FILE* file = std::fopen(path.c_str(), "w");
  if (!file) throw std::runtime_error("cannot write " + path);
  const Grid& grid = fluid.grid;
  std::fprintf(file, "x,z,free,water,pressure\n");
  for (int k = 1; k <= grid.nz; ++k) {
    for (int i = 1; i <= grid.nx; ++i) {
      const std::ptrdiff_t c = grid.at(i, 1, k);
      const double held = fluid.material[water].volume[c] + fluid.material[air].volume[c];
      std::fprintf(file, "%g,%g,%.4f,%.4f,%g\n", grid.centre_x(i), grid.centre_z(k),
                   fluid.after.volume[c] / grid.cell_volume[c], held > 0 ? fluid.material[water].volume[c] / held : 0.0,
                   held > 0 ? wall_pressure(fluid, c) - fluid.setup.atmospheric_pressure : 0.0);
    }
  }
  std::fclose(file);
}

}  // namespace polynya::fluid::test
