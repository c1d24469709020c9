#include "fluid_solver/cards.hpp"

#include "core/scene/graded_line.hpp"
#include "fluid_solver/dam_break.hpp"
#include "fluid_solver/equation_range.hpp"

namespace polynya::fluid {
namespace {

Grid grid_of(const scene::Scene& scene) {
  scene::GridLines lines = scene::fluid_grid_lines(scene);
  return {std::move(lines.x), std::move(lines.y), std::move(lines.z)};
}

/// Throws std::runtime_error naming the side if its state is none of its law.
void check_tube_side(const scene::TubeState& side, const EquationOfState& law) {
  const double e = energy_at(law, side.density, side.pressure);
  const std::string fault = range_fault(law, {-1e300, largest_density(law)}, side.density, e);
  if (!fault.empty())
    throw std::runtime_error("tube, side of " + side.material + ": density " + std::to_string(side.density) +
                             " kg/m^3 and pressure " + std::to_string(side.pressure) +
                             " Pa are out of the range of its law: " + fault);
}

EndMotion motion_of(const scene::AxisMotion& axis) {
  return {{axis.lower_speed, axis.upper_speed}, axis.times, {axis.lower_displacement, axis.upper_displacement}};
}

void move_grid(Fluid& fluid, const scene::Fluid& description) {
  if (!description.grid_motion) return;
  const scene::GridMotion& motion = *description.grid_motion;
  prescribe_motion(fluid, {motion_of(motion.x), motion_of(motion.y), motion_of(motion.z)});
}

ShockViscosity viscosity_of(const scene::Fluid& fluid) {
  return fluid.shock_viscosity == "reference" ? ShockViscosity::reference : ShockViscosity::limited;
}

}  // namespace

EquationOfState law_of(const scene::MaterialCard& card) {
  if (card.law == "mie_grueneisen") {
    return MieGrueneisen{card.value("density"),         card.value("sound_speed"), card.value("slope_1"),
                         card.value("slope_2"),         card.value("slope_3"),     card.value("grueneisen"),
                         card.value("grueneisen_slope")};
  }
  if (card.law == "linear_polynomial") {
    return LinearPolynomial{card.value("density"), card.value("c0"), card.value("c1"), card.value("c2"),
                            card.value("c3"),      card.value("c4"), card.value("c5"), card.value("c6")};
  }
  if (card.law == "ideal_gas") return IdealGas{card.value("ratio_of_specific_heats")};
  if (card.law == "stiffened_gas")
    return StiffenedGas{card.value("ratio_of_specific_heats"), card.value("stiffening_pressure")};
  if (card.law == "tait") {
    return Tait{card.value("density"), card.value("reference_pressure"), card.value("stiffness"),
                card.value("exponent")};
  }
  throw std::runtime_error("material " + card.name + ": the law " + card.law +
                           " is not a fluid's; expected mie_grueneisen, "
                           "linear_polynomial, ideal_gas, stiffened_gas or tait");
}

Fluid make_fluid(const scene::Scene& scene) {
  const scene::Fluid& description = *scene.fluid;
  Setup setup;
  setup.law = {law_of(scene.material(description.water)), law_of(scene.material(description.air))};
  setup.name = {description.water, description.air};
  const bool cavitates = scene.effect("cavitation");
  setup.pressure_floor = {cavitates ? description.vapour_pressure : -1e300, 0.0};
  setup.shock_viscosity = viscosity_of(description);
  setup.sweeps = description.sweeps == "all_orders" ? Sweeps::all_orders : Sweeps::alternating;
  setup.sleeping_threshold = description.sleeping_threshold;
  setup.gravity = scene.run.gravity;
  setup.atmospheric_pressure = description.atmospheric_pressure;
  setup.boundary.fill(description.outer_boundary == "non_reflecting" ? Boundary::non_reflecting : Boundary::wall);
  if (scene.symmetry == scene::Symmetry::quarter) setup.boundary[0] = Boundary::wall;
  if (scene.symmetry != scene::Symmetry::full) setup.boundary[2] = Boundary::wall;
  Fluid fluid{grid_of(scene), setup};
  if (description.dam) fill_column(fluid, description.dam->length, description.dam->height);
  move_grid(fluid, description);
  if (description.grid_follows == "vehicle") let_grid_follow(fluid);
  return fluid;
}

Fluid make_tube(const scene::Scene& scene) {
  const scene::Tube& tube = *scene.fluid->tube;
  Setup setup;
  setup.law = {law_of(scene.material(tube.left.material)), law_of(scene.material(tube.right.material))};
  setup.name = {tube.left.material + " (left)", tube.right.material + " (right)"};
  setup.shock_viscosity = viscosity_of(*scene.fluid);
  setup.sleeping_threshold = scene.fluid->sleeping_threshold;
  setup.boundary.fill(Boundary::wall);
  setup.atmospheric_pressure = 0;
  for (int m = 0; m < 2; ++m) {
    const bool gas =
        std::holds_alternative<IdealGas>(setup.law[m]) || std::holds_alternative<LinearPolynomial>(setup.law[m]);
    setup.pressure_floor[m] = gas ? 0.0 : -1e300;
  }
  for (int m = 0; m < 2; ++m) check_tube_side(m == 0 ? tube.left : tube.right, setup.law[m]);
  // A grid that moves along the tube shows a part of it, whose ends are not the tube's.
  const bool closed = !scene.fluid->grid_motion;
  if (!closed) setup.boundary[0] = setup.boundary[1] = Boundary::non_reflecting;
  Fluid fluid(grid_of(scene), setup);
  const Grid& grid = fluid.grid;
  const auto state_of = [&](int m) {
    const scene::TubeState& side = m == 0 ? tube.left : tube.right;
    CellState state;
    state.fraction[m] = 1;
    state.density[m] = side.density;
    state.specific_energy[m] = energy_at(setup.law[m], side.density, side.pressure);
    return state;
  };
  fill(fluid, {}, [&](int i, int, int) { return state_of(grid.centre_x(i) < tube.diaphragm ? 0 : 1); });
  for_rows(grid, 1, [&](int j, int k) {
    for (int i = 1; i <= grid.nx + 1; ++i) {
      const double x = grid.x[i - 1];
      const bool end = closed && (i == 1 || i == grid.nx + 1);
      fluid.velocity[0][grid.at(i, j, k)] = end ? 0.0 : x < tube.diaphragm ? tube.left.velocity : tube.right.velocity;
    }
  });
  if (!closed) {
    for (int m = 0; m < 2; ++m)
      fluid.beyond[m] = {ambient_of(setup, state_of(m)), m == 0 ? tube.left.velocity : tube.right.velocity};
    apply_ambient(fluid);
    move_grid(fluid, *scene.fluid);
  }
  update_account(fluid);
  return fluid;
}

}  // namespace polynya::fluid
