// Cells that water and air share: where the plane between them lies, and what leaves through a face.
#include <algorithm>

#include "fluid_solver/pressure_equilibrium.hpp"
#include "fluid_solver/row_geometry.hpp"
#include "fluid_solver/sweep.hpp"

namespace polynya::fluid {
namespace {

/// Part of a cell's present volume that is water; of a cell that solids cut, at the end of the Lagrange phase.
double water_part(const Fluid& fluid, std::ptrdiff_t c, int row_materials) {
  if (fluid.held[c]) return fluid.donor[water].volume[c];
  // Rows of one material do not carry its volume along.
  return row_materials == 3 ? fluid.material[water].volume[c] / fluid.sweep_volume[c] : row_materials == 2 ? 0.0 : 1.0;
}

bool shared(const Fluid& fluid, std::ptrdiff_t c) {
  const double volume = fluid.sweep_volume[c];
  if (fluid.held[c] || !(volume > 0)) return false;
  for (const Material& own : fluid.material)
    if (!(own.volume[c] > dormant_fraction * volume) || !(own.mass[c] > void_density * own.volume[c])) return false;
  return true;
}

SharedCell lay_plane(const Fluid& fluid, std::ptrdiff_t c) {
  const Grid& grid = fluid.grid;
  int i, j, k;
  grid.position(c, i, j, k);
  SharedCell cell;
  for (int m = 0; m < 2; ++m) {
    cell.volume[m] = fluid.material[m].volume[c];
    cell.mass[m] = fluid.material[m].mass[c];
    cell.energy[m] = fluid.material[m].energy[c];
  }
  const double own = cell.volume[water] / (cell.volume[water] + cell.volume[air]);
  std::array<double, 27> part;
  int at = 0;
  for (int z = -1; z <= 1; ++z) {
    for (int y = -1; y <= 1; ++y) {
      // Beyond the grid the cells repeat; where solids leave no fluid, nothing is known and nothing assumed.
      const int row = std::clamp(j + y, 1, grid.ny), layer = std::clamp(k + z, 1, grid.nz);
      const int materials = materials_around(fluid, row, layer);
      for (int x = -1; x <= 1; ++x, ++at) {
        const std::ptrdiff_t n = grid.at(std::clamp(i + x, 1, grid.nx), row, layer);
        part[at] = fluid.held[n] || fluid.sweep_volume[n] > 0 ? water_part(fluid, n, materials) : own;
      }
    }
  }
  part[13] = own;
  const auto widths = [](const std::vector<double>& w, int n) {
    return std::array<double, 3>{w[n - 1], w[n], w[n + 1]};
  };
  cell.plane.normal = interface_normal(part, {widths(grid.dx, i), widths(grid.dy, j), widths(grid.dz, k)});
  const auto& n = cell.plane.normal;
  if (n[0] == 0 && n[1] == 0 && n[2] == 0) cell.plane.normal = {0, 0, 1};  // an island without a side: water lies below
  cell.plane.offset = offset_for(cell.plane.normal, own);
  return cell;
}

}  // namespace

void find_shared_cells(Fluid& fluid, SharedCells& cells) {
  const Grid& grid = fluid.grid;
  cells.resize(static_cast<std::size_t>(grid.nz) + 2);
  const auto find_in_layer = [&](int k) {
    std::vector<SharedCell>& found = cells[static_cast<std::size_t>(k)];
    found.clear();
    for (int j = 1; j <= grid.ny && fluid.sleeping.layers[k]; ++j) {
      if (materials_around(fluid, j, k) != 3) continue;
      const Span awake = awake_cells(fluid, j, k);
      for (std::ptrdiff_t c = grid.at(awake.first, j, k); c <= grid.at(awake.last, j, k); ++c) {
        fluid.label[c] = -1;
        if (!shared(fluid, c)) continue;
        fluid.label[c] = static_cast<std::int32_t>(found.size());
        found.push_back(lay_plane(fluid, c));
      }
    }
  };
  compute::for_uneven_chunks(static_cast<std::size_t>(grid.nz), 1,
                             [&](std::size_t layer, std::size_t) { find_in_layer(static_cast<int>(layer) + 1); });
}

void forget_shared_cells(Fluid& fluid) {
  const Grid& grid = fluid.grid;
  for_rows(grid, 0, [&](int j, int k) {
    const Span awake = awake_cells(fluid, j, k);
    if (awake.empty() || materials_around(fluid, j, k) != 3) return;
    std::fill_n(fluid.label.begin() + grid.at(awake.first, j, k), awake.last - awake.first + 1, -1);
  });
}

Given give(SharedCell& cell, int axis, bool upper, double volume, double cell_volume) {
  Given given;
  if (!(volume > 0)) return given;
  const double of_water = volume * fraction_of_slab(cell.plane, axis, upper, std::min(1.0, volume / cell_volume));
  // The plane holds the volumes to rounding only, and no material gives more than it has: the other fills up.
  given.volume[water] = std::max(std::min(of_water, cell.volume[water]), volume - cell.volume[air]);
  given.volume[air] = volume - given.volume[water];
  for (int m = 0; m < 2; ++m) {
    const double part = cell.volume[m] > given.volume[m] ? given.volume[m] / cell.volume[m] : 1.0;
    given.mass[m] = part * cell.mass[m];
    given.energy[m] = part * cell.energy[m];
    cell.volume[m] -= given.volume[m];
    cell.mass[m] -= given.mass[m];
    cell.energy[m] -= given.energy[m];
  }
  return given;
}

}  // namespace polynya::fluid
