// One step, phase by phase.
#include "fluid_solver/phases.hpp"

namespace polynya::fluid {
namespace {

/// Momentum of the fluid and what it has given to everything else but to sleep, N s.
std::array<double, 3> total_impulse(const Account& account) {
  std::array<double, 3> sum = account.momentum;
  for (int d = 0; d < 3; ++d) {
    sum[d] += account.body_impulse[0][d] + account.body_impulse[1][d] + account.boundary_impulse[d] +
              account.node_fix_impulse[d];
  }
  sum[2] += account.gravity_impulse;
  return sum;
}

}  // namespace

void step(Fluid& fluid, double dt, const Overlap& overlap) {
  if (!(dt > 0)) throw std::invalid_argument("a fluid step must be longer than 0 s");
  Account& account = fluid.account;
  const std::array<double, 3> given_before = total_impulse(account);
  std::vector<StepWall> walls;
  VolumeCorrection correction;
  begin_grid_motion(fluid, dt);
  {
    const auto lap = fluid.watch.lap("cut_geometry");
    std::swap(fluid.before, fluid.after);
    fluid.after.set(fluid.grid, fluid.setup.boundary, overlap);
    if (fluid.steps == 0) fluid.before.open_like(fluid.after);
  }
  {
    const auto lap = fluid.watch.lap("groups");
    fluid.groups = find_groups(fluid.grid, fluid.before, fluid.after, fluid.groups, fluid.label);
  }
  {
    const auto lap = fluid.watch.lap("volume_correction");
    walls = join_walls(fluid.before, fluid.after);
    account.released_room += release_room(fluid.grid, fluid.before, fluid.after, walls, dt);
    correction = correct_volumes(fluid.grid, fluid.before, fluid.after, walls, dt, fluid.label);
    fluid.correction_iterations = correction.iterations;
  }
  {
    const auto lap = fluid.watch.lap("face_coefficients");
    update_face_coefficients(fluid);
    apply_to_cells(fluid, correction);
  }
  {
    const auto lap = fluid.watch.lap("equation_of_state");
    wake_beside_solids(fluid);
    if (fluid.sleeping.cells_awake == 0) return let_time_pass(fluid, dt);
    evaluate_cells(fluid, fluid.before.volume);
    evaluate_groups(fluid);
  }
  {
    const auto lap = fluid.watch.lap("sleeping");
    look_at_disturbances(fluid);
  }
  {
    const auto lap = fluid.watch.lap("guard");
    check_ranges(fluid);
  }
  double kinetic_before_remap = 0, taken_from_nodes = 0;
  {
    const auto lap = fluid.watch.lap("lagrange");
    predict_pressure(fluid, dt);
    predict_group_pressure(fluid, dt);
    {
      const auto inner = fluid.watch.lap("boundaries");
      boundary_face_rates(fluid);
      set_boundary_pressure(fluid, dt);
    }
    kinetic_before_remap = accelerate_nodes(fluid, dt);
    mean_face_rates(fluid);
    {
      const auto inner = fluid.watch.lap("guard");
      check_lagrange_volumes(fluid, dt);
    }
    {
      const auto inner = fluid.watch.lap("boundaries");
      advance_far_field(fluid, dt);
    }
    work_and_volumes(fluid, dt);
    hold_cut_cells(fluid);
    set_group_donors(fluid, dt);
    book_walls(fluid, dt, walls, correction);
    {
      const auto inner = fluid.watch.lap("boundaries");
      book_boundary(fluid, dt, walls);
    }
  }
  {
    const auto lap = fluid.watch.lap("remap");
    apply_to_faces(fluid, correction, dt);
    subtract_plane_motion(fluid, dt);
    remap_cells(fluid, dt);
    {
      const auto inner = fluid.watch.lap("boundaries");
      book_boundary_flow(fluid);
    }
    mix_groups(fluid);
    {
      const auto inner = fluid.watch.lap("boundaries");
      copy_face_mass_to_ghosts(fluid);
      copy_velocity_to_ghosts(fluid);
    }
    remap_momentum(fluid);
  }
  {
    const auto lap = fluid.watch.lap("wall nodes");
    taken_from_nodes = -account.node_fix;
    fix_covered_nodes(fluid);
    close_wall_nodes(fluid);
    taken_from_nodes += account.node_fix;
  }
  {
    const auto lap = fluid.watch.lap("account");
    fluid.time += dt;
    ++fluid.steps;
    end_grid_motion(fluid);
    const bool sound = update_account(fluid);
    if (!fluid.sleeping.all_awake) {
      const std::array<double, 3> given = total_impulse(account);
      for (int d = 0; d < 3; ++d) account.rest_impulse[d] += given_before[d] - given[d];
    }
    fluid.sleeping.cells_stepped += static_cast<double>(fluid.sleeping.cells_awake);
    fluid.sleeping.cells_in_all += static_cast<double>(fluid.grid.cells());
    account.remap_loss += kinetic_before_remap - (account.kinetic + taken_from_nodes);
    if (!sound) check_state(fluid);
  }
}

}  // namespace polynya::fluid
