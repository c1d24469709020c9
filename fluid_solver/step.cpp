// One step, phase by phase.
#include "fluid_solver/phases.hpp"

namespace polynya::fluid {
namespace {

/// What the phases of one step hand on.
struct Step {
  double dt;  ///< s
  std::vector<StepWall> walls;
  VolumeCorrection correction;
  double kinetic = 0;           ///< of the new velocities before the remap, J
  double taken_from_nodes = 0;  ///< at solids and walls after it, J
};

/// Where the solids are at the end of the step, and what follows from it for volumes and faces.
void take_overlap(Fluid& fluid, const Overlap& overlap, Step& now) {
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
    now.walls = join_walls(fluid.before, fluid.after);
    if (fluid.motion.follows)
      for (StepWall& wall : now.walls) wall.by_planes = volume_by_planes(fluid, fluid.before, fluid.after, wall.cell);
    fluid.account.released_room += release_room(fluid.grid, fluid.before, fluid.after, now.walls, now.dt);
    now.correction = correct_volumes(fluid.grid, fluid.before, fluid.after, now.walls, now.dt, fluid.label);
    fluid.correction_iterations = now.correction.iterations;
  }
  const auto lap = fluid.watch.lap("face_coefficients");
  update_face_coefficients(fluid);
  apply_to_cells(fluid, now.correction);
}

/// States at the beginning of the step, and who sleeps. False if all do.
bool evaluate_states(Fluid& fluid) {
  {
    const auto lap = fluid.watch.lap("equation_of_state");
    wake_beside_solids(fluid);
    if (fluid.sleeping.cells_awake == 0) return false;
    evaluate_cells(fluid, fluid.before.volume);
    evaluate_groups(fluid);
  }
  {
    const auto lap = fluid.watch.lap("sleeping");
    look_at_disturbances(fluid);
  }
  {
    const auto lap = fluid.watch.lap("face_coefficients");
    hold_light_faces(fluid);
  }
  const auto lap = fluid.watch.lap("guard");
  check_ranges(fluid);
  return true;
}

void move_with_the_fluid(Fluid& fluid, Step& now) {
  const auto lap = fluid.watch.lap("lagrange");
  predict_pressure(fluid, now.dt);
  predict_group_pressure(fluid, now.dt);
  {
    const auto inner = fluid.watch.lap("boundaries");
    boundary_face_rates(fluid);
    set_boundary_pressure(fluid, now.dt);
  }
  now.kinetic = accelerate_nodes(fluid, now.dt);
  mean_face_rates(fluid);
  {
    const auto inner = fluid.watch.lap("guard");
    check_lagrange_volumes(fluid, now.dt);
  }
  {
    const auto inner = fluid.watch.lap("boundaries");
    advance_far_field(fluid, now.dt);
  }
  work_and_volumes(fluid, now.dt);
  hold_cut_cells(fluid);
  set_group_donors(fluid, now.dt);
  book_walls(fluid, now.dt, now.walls, now.correction);
  const auto inner = fluid.watch.lap("boundaries");
  book_boundary(fluid, now.dt, now.walls);
}

void remap(Fluid& fluid, Step& now) {
  {
    const auto lap = fluid.watch.lap("remap");
    apply_to_faces(fluid, now.correction, now.dt);
    subtract_plane_motion(fluid, now.dt);
    remap_cells(fluid, now.dt);
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
  const auto lap = fluid.watch.lap("wall nodes");
  now.taken_from_nodes = -fluid.account.node_fix;
  calm_void_nodes(fluid);
  fix_covered_nodes(fluid);
  book_held_faces(fluid, now.dt);
  close_wall_nodes(fluid);
  now.taken_from_nodes += fluid.account.node_fix;
}

void finish(Fluid& fluid, const Step& now) {
  const auto lap = fluid.watch.lap("account");
  fluid.time += now.dt;
  ++fluid.steps;
  end_grid_motion(fluid);
  const bool sound = update_account(fluid);
  fluid.sleeping.cells_stepped += static_cast<double>(fluid.sleeping.cells_awake);
  fluid.sleeping.cells_in_all += static_cast<double>(fluid.grid.cells());
  fluid.account.remap_loss += now.kinetic - (fluid.account.kinetic + now.taken_from_nodes);
  if (!sound) check_state(fluid);
}

}  // namespace

void step(Fluid& fluid, double dt, const Overlap& overlap) {
  if (!(dt > 0)) throw std::invalid_argument("a fluid step must be longer than 0 s");
  Step now{.dt = dt, .walls = {}, .correction = {}};
  begin_grid_motion(fluid, dt);
  take_overlap(fluid, overlap, now);
  if (!evaluate_states(fluid)) return let_time_pass(fluid, dt);
  move_with_the_fluid(fluid, now);
  remap(fluid, now);
  finish(fluid, now);
}

}  // namespace polynya::fluid
