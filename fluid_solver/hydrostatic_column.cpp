// A column of water with air above, balanced by the same formula that accelerates the nodes: the pressures of two
// layers differ by gravity times half of each layer's mass per area.
#include <algorithm>
#include <cmath>

#include "fluid_solver/phases.hpp"

namespace polynya::fluid {
namespace {

/// Reference state at the pressure p: water without internal energy, air at the energy per mass of its card.
struct Layer {
  double pressure = 0, density = 0;
  CellState state;
};

double air_energy(const EquationOfState& law, double pressure) {
  const double reference = std::visit(
      [](const auto& each) {
        if constexpr (requires { each.density; })
          return each.density;
        else
          return 1.2;
      },
      law);
  return energy_at(law, reference, pressure);
}

Layer layer_at(const Setup& setup, double pressure, double water_fraction, double energy_of_air, const Layer& guess) {
  Layer layer;
  layer.pressure = pressure;
  for (int m = 0; m < 2; ++m) {
    const double fraction = m == water ? water_fraction : 1.0 - water_fraction;
    const double start = guess.state.density[m] > 0 ? guess.state.density[m] : m == water ? 1000.0 : 1.2;
    const double e = m == water ? 0.0 : energy_of_air;
    layer.state.fraction[m] = fraction;
    layer.state.density[m] = density_at(setup.law[m], pressure, e, start);
    layer.state.specific_energy[m] = e;
    layer.density += fraction * layer.state.density[m];
  }
  return layer;
}

}  // namespace

void fill_hydrostatic(Fluid& fluid, const Overlap& overlap, double waterline, std::array<double, 3> velocity) {
  const Grid& grid = fluid.grid;
  const Setup& setup = fluid.setup;
  const double energy_of_air = air_energy(setup.law[air], setup.atmospheric_pressure);
  const auto water_fraction = [&](int k) {
    return std::clamp((waterline - grid.z[k - 1]) / (grid.z[k] - grid.z[k - 1]), 0.0, 1.0);
  };
  // The atmospheric pressure holds in the first layer that is not full of water.
  int surface = grid.nz;
  while (surface > 1 && water_fraction(surface - 1) < 1.0) --surface;
  std::vector<Layer> layers(static_cast<std::size_t>(grid.nz) + 1);
  layers[surface] = layer_at(setup, setup.atmospheric_pressure, water_fraction(surface), energy_of_air, {});
  const auto march = [&](int k, int from, double sign) {
    Layer layer = layers[from];
    for (int iteration = 0; iteration < 60; ++iteration) {
      const double head = 0.5 * setup.gravity * (layer.density * grid.dz[k] + layers[from].density * grid.dz[from]);
      const double pressure = layers[from].pressure + sign * head;
      const Layer next = layer_at(setup, pressure, water_fraction(k), energy_of_air, layer);
      const bool settled = next.density == layer.density && next.pressure == layer.pressure;
      layer = next;
      if (settled) break;
    }
    layers[k] = layer;
  };
  for (int k = surface - 1; k >= 1; --k) march(k, k + 1, 1.0);
  for (int k = surface + 1; k <= grid.nz; ++k) march(k, k - 1, -1.0);
  for (int k = 1; k <= grid.nz; ++k) set_ambient(fluid, k, layers[k].state);
  fill(fluid, overlap, [&](int, int, int k) { return layers[k].state; });
  for (int d = 0; d < 3; ++d) {
    for_rows(grid, 1, [&](int j, int k) {
      std::fill_n(fluid.velocity[d].begin() + grid.at(1, j, k), grid.nx + 1, velocity[d]);
    });
  }
  update_account(fluid);
}

}  // namespace polynya::fluid
