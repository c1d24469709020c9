#pragma once
#include "fluid_solver/fluid.hpp"
#include "fluid_solver/volume_correction.hpp"

/// The phases of a step, in the order of step.cpp. Each lives in the file named after it.
namespace polynya::fluid {

/// cell_states.cpp: pressure, density, stiffness from masses, energies and the free volumes given; mixed cells are
/// brought to pressure equilibrium.
void evaluate_cells(Fluid& fluid, const std::vector<double>& volume);

/// group_state.cpp: one state per group at the start, and the predicted pressure inside groups.
void evaluate_groups(Fluid& fluid);
void predict_group_pressure(Fluid& fluid, double dt);
/// Takes the donor values of member cells from their group.
void set_group_donors(Fluid& fluid, double dt);
/// After a step of length dt: absolute pressures of the members of group g at its end, Pa, linear in what happened.
void pressures_after_step(const Fluid& fluid, std::size_t g, double dt, std::vector<double>& pressure);
/// Spreads each group's content evenly over its new volume; the mass moved is added to the face masses.
void mix_groups(Fluid& fluid);

/// face_coefficients.cpp
std::vector<StepWall> join_walls(const CutGeometry& before, const CutGeometry& after);
void update_face_coefficients(Fluid& fluid);

/// release.cpp: where a solid breaks away, its room is free at once. The fluid expands into it without work (it meets
/// nothing that it could push), so the room counts as free from the beginning of the step. Returns it, m^3.
double release_room(const Grid& grid, CutGeometry& before, const CutGeometry& after, const std::vector<StepWall>& walls,
                    double dt);

/// Adds the correction's volumes to the change of volume that cells feel, and later to what flows through faces.
void apply_to_cells(Fluid& fluid, const VolumeCorrection& correction);
void apply_to_faces(Fluid& fluid, const VolumeCorrection& correction, double dt);

/// grid_motion.cpp: begin_grid_motion, set_wall_flow, subtract_plane_motion, end_grid_motion.

/// boundaries.cpp: ghost pressures at open boundaries, ghost values for the remap, walls and their accounts.
void set_boundary_pressure(Fluid& fluid, double dt);
/// Takes the present outward speeds as those of a slow flow around a body at `centre` (m).
void start_far_field(Fluid& fluid, const std::array<double, 3>& centre);
void advance_far_field(Fluid& fluid, double dt);
void book_boundary(Fluid& fluid, double dt, const std::vector<StepWall>& walls);
void book_boundary_flow(Fluid& fluid);
void copy_face_mass_to_ghosts(Fluid& fluid);
void copy_velocity_to_ghosts(Fluid& fluid);
void close_wall_nodes(Fluid& fluid);
/// Ghosts beside cells that sleep, and the force of these on the sides.
void rest_boundaries(Fluid& fluid);
/// Repeats the pressure of the outermost cells in the ghosts.
void mirror_pressure(Fluid& fluid);

/// held_faces.cpp: nodes beside solids that hold next to nothing weigh less, and faces that have no others are closed in
/// part for this step; what presses on these goes to the bodies, after fix_covered_nodes, which starts the sums.
void hold_light_faces(Fluid& fluid);
void book_held_faces(Fluid& fluid, double dt);

/// predicted_pressure.cpp
void predict_pressure(Fluid& fluid, double dt);
/// Coefficient of the shock viscosity that is linear in the closing speed beside solids, at the present time.
double linear_viscosity(const Fluid& fluid);

/// acceleration.cpp: new velocities and masses of nodes. Returns the kinetic energy of the new velocities, J.
double accelerate_nodes(Fluid& fluid, double dt);

/// lagrange_step.cpp
void face_rates(const Fluid& fluid, const std::array<std::vector<double>, 3>& velocity,
                std::array<std::vector<double>, 3>& rate);
/// The same for the faces of the outer boundary alone, at the velocities of the beginning of the step.
void boundary_face_rates(Fluid& fluid);
void work_and_volumes(Fluid& fluid, double dt);
/// The part of a cell's predicted pressure whose work goes to the account instead of the cell's energy, Pa: vapour's
/// where a material is alone and cavitates, all of it where nothing is.
double pressure_of_vapour(const Fluid& fluid, std::ptrdiff_t cell);
/// Lists the cells that solids cut and members of groups, and what they will give in the remap.
void hold_cut_cells(Fluid& fluid);
/// wall_account.cpp
void book_walls(Fluid& fluid, double dt, const std::vector<StepWall>& walls, const VolumeCorrection& correction);

/// Face rates of the mean of the velocities at the two ends of the acceleration.
void mean_face_rates(Fluid& fluid);

/// fluid.cpp
void update_node_mass(Fluid& fluid);

/// remap.cpp, momentum_remap.cpp, node_fix.cpp
void remap_cells(Fluid& fluid, double dt);
void remap_momentum(Fluid& fluid);
/// Nodes at and inside solids; those before a flat wall take the share `follow` of the difference to its velocity.
inline constexpr double follow_in_a_step = 0.4;
void fix_covered_nodes(Fluid& fluid, double follow = follow_in_a_step);
/// Thin nodes that are left in a void: what they carry is of traces left by rounding.
void calm_void_nodes(Fluid& fluid);

/// guard.cpp: equations of state out of their range, in what evaluate_groups left. Throws FluidError.
void check_ranges(const Fluid& fluid);
/// A cell that no solid cuts must survive the closing of its sides in any order of the axes. Throws FluidError.
void check_lagrange_volumes(const Fluid& fluid, double dt);

}  // namespace polynya::fluid
