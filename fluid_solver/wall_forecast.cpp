#include "fluid_solver/wall_forecast.hpp"

#include <algorithm>

#include "fluid_solver/group_strain.hpp"
#include "fluid_solver/phases.hpp"
#include "fluid_solver/prediction.hpp"

namespace polynya::fluid {
namespace {

/// Of a cell: what the step has left, and what the next one brings.
struct Motion {
  double pressure = 0;   ///< Pa, at the end of the step
  double strain = 0;     ///< 1/s, in the next one
  double per_speed = 0;  ///< 1/m, closing strain per speed of the walls into the fluid
  double theta = 0;      ///< see prediction.hpp
};

struct Expected {
  double pressure = 0, impedance = 0;
};

Expected expected_in(const Fluid& fluid, std::ptrdiff_t cell, const Motion& motion, double dt) {
  if (fluid.density[cell] <= 0 && fluid.after.volume[cell] <= 0) return {};
  const double floor = std::max(fluid.material[0].mass[cell] > 0 ? fluid.setup.pressure_floor[0] : -1e300,
                                fluid.material[1].mass[cell] > 0 ? fluid.setup.pressure_floor[1] : -1e300);
  int i, j, k;
  fluid.grid.position(cell, i, j, k);
  const double length = std::min({fluid.grid.dx[i], fluid.grid.dy[j], fluid.grid.dz[k]});
  const double stiffness = fluid.bulk_modulus[cell] * dt, closing = std::max(0.0, -motion.strain);
  const double viscous = fluid.density[cell] * length * linear_viscosity(fluid) * fluid.sound_speed[cell];
  const double q = closing * (viscous + fluid.density[cell] * quadratic_viscosity * length * length * closing);
  return {std::max(std::max(motion.pressure, floor) - motion.theta * stiffness * motion.strain, floor) + q -
              fluid.setup.atmospheric_pressure,
          (motion.theta * stiffness + viscous) * motion.per_speed};
}

double wall_size(const Fluid& fluid, std::ptrdiff_t cell) {
  const WallPiece* wall = fluid.after.wall_in(cell);
  return wall ? wall->size : 0.0;
}

/// A cell that is in no group is at least half full. `size`: of the walls that it presses on, m^2.
Motion motion_of_cell(const Fluid& fluid, std::ptrdiff_t cell, double size, double dt) {
  const double least = 0.5 * fluid.grid.cell_volume[cell], rate = fluid.rate[cell];
  const double before = std::max(fluid.before.volume[cell], least), after = std::max(fluid.after.volume[cell], least);
  return {fluid.pressure[cell] - fluid.bulk_modulus[cell] * dt * rate / before, rate / after, size / after,
          whole_cell_prediction};
}

/// Fills in the members of group g that hold wall: those with a number in `wall_of`.
void forecast_group(const Fluid& fluid, std::size_t g, const std::vector<std::int32_t>& wall_of, double dt,
                    WallForecast& forecast) {
  const auto members = members_of(fluid.groups, g);
  const auto holds_wall = [&](const Groups::Member& member) { return wall_of[member.cell] >= 0; };
  if (std::none_of(members.begin(), members.end(), holds_wall)) return;
  const auto rate = [&](std::ptrdiff_t c) { return fluid.rate[c]; };
  const auto size = [&](std::ptrdiff_t c) { return wall_size(fluid, c); };
  std::vector<double> pressure, strain, per_speed;
  pressures_after_step(fluid, g, dt, pressure);
  member_strains(fluid, g, fluid.after.volume, rate, strain);
  member_strains(fluid, g, fluid.after.volume, size, per_speed);
  for (std::size_t m = 0; m < strain.size(); ++m) {
    const std::ptrdiff_t cell = members.first[m].cell;
    if (wall_of[cell] < 0) continue;
    const Expected expected = expected_in(fluid, cell, {pressure[m], strain[m], per_speed[m], group_prediction}, dt);
    forecast.pressure[static_cast<std::size_t>(wall_of[cell])] = expected.pressure;
    forecast.impedance[static_cast<std::size_t>(wall_of[cell])] = expected.impedance;
  }
}

}  // namespace

WallForecast forecast_walls(Fluid& fluid, std::span<const std::int64_t> cells, double dt) {
  WallForecast forecast;
  forecast.pressure.resize(cells.size());
  forecast.impedance.resize(cells.size());
  std::vector<std::int32_t>& wall_of = fluid.label;
  for (std::size_t w = 0; w < cells.size(); ++w) {
    const std::ptrdiff_t cell = fluid.grid.from_message(cells[w]);
    const std::ptrdiff_t pressing = fluid.after.pressing_on(cell);
    const Expected expected =
        expected_in(fluid, pressing, motion_of_cell(fluid, pressing, wall_size(fluid, cell), dt), dt);
    forecast.pressure[w] =
        expected.pressure - fluid.density[pressing] * fluid.setup.gravity * height_above(fluid, cell, pressing);
    forecast.impedance[w] = expected.impedance;
    wall_of[cell] = static_cast<std::int32_t>(w);
  }
  for (std::size_t g = 0; g < fluid.groups.count(); ++g) forecast_group(fluid, g, wall_of, dt, forecast);
  for (const std::int64_t number : cells) wall_of[fluid.grid.from_message(number)] = -1;
  return forecast;
}

}  // namespace polynya::fluid
