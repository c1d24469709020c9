#include "fluid_solver/tube.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/results/time_series.hpp"
#include "fluid_solver/alone.hpp"
#include "fluid_solver/exact_riemann.hpp"

namespace polynya::fluid {
namespace {

/// Ratio of specific heats and stiffness of laws that have an exact solution.
std::optional<std::pair<double, double>> gas_of(const EquationOfState& law) {
  if (const auto* gas = std::get_if<IdealGas>(&law)) return {{gas->gamma, 0.0}};
  if (const auto* gas = std::get_if<StiffenedGas>(&law)) return {{gas->gamma, gas->stiffness}};
  if (const auto* gas = std::get_if<LinearPolynomial>(&law)) {
    const bool ideal =
        gas->c0 == 0 && gas->c1 == 0 && gas->c2 == 0 && gas->c3 == 0 && gas->c6 == 0 && gas->c4 == gas->c5;
    if (ideal) return {{1.0 + gas->c4, 0.0}};
  }
  return {};
}

std::optional<ExactRiemann> exact_solution(const scene::Tube& tube, const Setup& setup) {
  const auto left = gas_of(setup.law[0]), right = gas_of(setup.law[1]);
  if (!left || !right) return {};
  return ExactRiemann({tube.left.density, tube.left.velocity, tube.left.pressure, left->first, left->second},
                      {tube.right.density, tube.right.velocity, tube.right.pressure, right->first, right->second});
}

double write_profile(const scene::Tube& tube, const Fluid& fluid, const std::string& path) {
  const auto exact = exact_solution(tube, fluid.setup);
  std::vector<results::Column> columns{{"x", "m"}, {"density", "kg/m^3"}, {"velocity", "m/s"}, {"pressure", "Pa"}};
  if (exact) {
    for (const auto& [name, unit] :
         {std::pair{"density_exact", "kg/m^3"}, {"velocity_exact", "m/s"}, {"pressure_exact", "Pa"}})
      columns.push_back({name, unit});
  }
  results::TimeSeries series(path, columns);
  const Grid& grid = fluid.grid;
  double error = 0, total = 0;
  for (int i = 1; i <= grid.nx; ++i) {
    const std::ptrdiff_t c = grid.at(i, 1, 1);
    const double density = (fluid.material[0].mass[c] + fluid.material[1].mass[c]) / fluid.after.volume[c];
    std::vector<double> row{grid.centre_x(i), density, 0.5 * (fluid.velocity[0][c] + fluid.velocity[0][c + 1]),
                            fluid.pressure[c]};
    if (exact) {
      const auto s = exact->sample((grid.centre_x(i) - tube.diaphragm) / fluid.time);
      row.insert(row.end(), {s.density, s.velocity, s.pressure});
      error += std::abs(density - s.density) * grid.dx[i];
      total += s.density * grid.dx[i];
    }
    series.append(row);
  }
  return exact ? error / total : -1.0;
}

}  // namespace

double run_tube(const scene::Scene& scene, Fluid& fluid, Output& output, const results::Checkpoints& checkpoints) {
  int nothing = 0;
  run_alone(scene, fluid, output, checkpoints, nothing, [] {});
  update_cell_states(fluid);
  return write_profile(*scene.fluid->tube, fluid, output.folder() + "/series/tube.csv");
}

}  // namespace polynya::fluid
