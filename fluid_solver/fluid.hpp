#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/compute/state_archive.hpp"
#include "core/compute/timer.hpp"
#include "fluid_solver/account.hpp"
#include "fluid_solver/cut_geometry.hpp"
#include "fluid_solver/equation_of_state.hpp"
#include "fluid_solver/grid.hpp"
#include "fluid_solver/grid_motion.hpp"
#include "fluid_solver/groups.hpp"
#include "fluid_solver/overlap.hpp"
#include "fluid_solver/pressure_equilibrium.hpp"
#include "fluid_solver/sleeping.hpp"

/// Water and air on one structured grid that solids cut: a staggered Lagrange step with a conservative remap.
/// No input or output, no transport. Order of calls: make, fill (hydrostatic or by cell), begin, then step by step.
namespace polynya::fluid {

inline constexpr int water = 0, air = 1;

/// Shock viscosity away from solids: that of the reference in all compression, or its linear part only in compression
/// that is not smooth.
enum class ShockViscosity { reference, limited };

/// The remap goes axis by axis: orders in turns from step to step, or in every step the mean of all orders, which costs
/// six remaps and is the same for all axes.
enum class Sweeps { alternating, all_orders };

/// What does not change during a run.
struct Setup {
  std::array<EquationOfState, 2> law{MieGrueneisen{}, LinearPolynomial{}};
  std::array<std::string, 2> name{"water", "air"};    ///< of the materials, for messages
  std::array<double, 2> pressure_floor{2339.0, 0.0};  ///< lower bound of the absolute pressure of each material, Pa
  std::array<Boundary, 6> boundary{};                 ///< x-, x+, y-, y+, z-, z+
  std::array<double, 3> ambient_velocity{};           ///< of the fluid beyond non-reflecting boundaries, m/s
  ShockViscosity shock_viscosity = ShockViscosity::limited;
  Sweeps sweeps = Sweeps::alternating;
  double sleeping_threshold = 0;  ///< disturbance below which bricks of cells sleep (sleeping_look.cpp); 0: none does
  double gravity = 0;             ///< m/s^2 along -z
  double atmospheric_pressure = 101325;  ///< Pa, what gauge pressures are counted from
};

/// Extensive state of one material in every cell.
struct Material {
  std::vector<double> mass, energy, volume;  ///< kg, J (internal), m^3

  POLYNYA_STATE(mass, energy, volume)
};

/// Fluid beyond one non-reflecting side as a whole, where it is not that of the layers.
struct Beyond {
  Ambient state;
  double velocity = 0;  ///< along the axis of the side, m/s
};

/// The flow beyond non-reflecting boundaries: the water around a body that moves spreads like a spherical wave, so the
/// boundary carries slow flow without resistance and answers fast changes with the impedance rho c.
struct FarField {
  std::array<double, 3> centre{};                 ///< of the body, m
  bool spherical = false;                         ///< false: plane waves, nothing flows beyond
  std::array<std::vector<double>, 6> slow_speed;  ///< outward, by side and face in the order of its cells, m/s

  POLYNYA_STATE(centre, spherical, slow_speed)
};

/// A started flow is not quite the one the scheme would settle to, and the difference rings between walls and cells.
/// Until sound has crossed a few cells the linear shock viscosity is therefore close to critical: 0.06 + excess exp(-t
/// / decay).
struct StartDamping {
  double excess = 0, decay = 1;  ///< -, s
};

/// What a group of cells holds at the beginning of a step.
struct GroupState {
  Mixture content;
  PointState point;
  double volume = 0, height = 0;  ///< free volume, m^3, and its centre's z, m
};

/// How often nodes beside solids weighed less and faces were held (held_faces.cpp), summed over steps.
struct Lightened {
  long nodes = 0, held_faces = 0;
  POLYNYA_STATE(nodes, held_faces)
};

struct Fluid {
  Grid grid;
  Setup setup;
  CutGeometry before, after;  ///< at the beginning and the end of the current step; between steps `after` is now
  Groups groups;              ///< of the last step
  std::vector<GroupState> group_states;  ///< at the beginning of the last step
  std::vector<double> own_compression;   ///< by member of `groups`: density over the group's at its height, less one
  std::array<Material, 2> material;
  std::array<std::vector<double>, 3> velocity;  ///< of nodes, m/s
  GridMotion motion;
  std::vector<Ambient> ambient;                 ///< by padded k
  std::array<std::optional<Beyond>, 6> beyond;  ///< by side, instead of the layers'
  FarField far_field;
  StartDamping start_damping;
  std::array<double, 2> largest_density{};  ///< that the laws hold for, kg/m^3
  Account account;
  Sleeping sleeping;
  compute::Stopwatch watch;
  double time = 0;
  long steps = 0;
  Lightened lightened;
  int correction_iterations = 0;  ///< of the last step's volume correction

  // Valid from the beginning of a step; kept for output and for the loads on solids.
  std::vector<double> pressure;                                    ///< absolute, at the centre of the whole cell, Pa
  std::vector<double> predicted_pressure;                          ///< what the step used, with shock viscosity, Pa
  std::vector<std::array<std::array<double, 3>, 2>> wall_impulse;  ///< by wall of `after` and body: from nodes that the
                                                                   ///< wall carried along in the last step, N s
  std::vector<double> density;                                     ///< of the mixture, per free volume, kg/m^3
  std::vector<double> bulk_modulus;                                ///< of the mixture, 0 where water cavitates, Pa
  std::vector<double> sound_speed;                                 ///< the largest of the materials present, m/s
  std::vector<double> total_mass;  ///< of both materials, kg; only in rows that hold both or
                                   ///< that solids touch
  // Working space of a step.
  std::array<std::vector<double>, 3> face_coefficient;  ///< open area over the sum of node fractions of the face
  /// What of a lower face is closed in this step for its nodes hold too little (held_faces.cpp), m^2.
  struct HeldFace {
    std::ptrdiff_t face;
    int axis;
    double area;
  };
  std::vector<HeldFace> held_faces;
  std::vector<std::ptrdiff_t> thin_nodes;        ///< that held less than thin_density before the remap
  std::array<std::vector<double>, 3> face_rate;  ///< volume per time through lower faces, m^3/s
  std::array<std::vector<double>, 3> face_mass;  ///< mass through lower faces in this step, kg
  std::array<std::vector<double>, 3> next_velocity;
  // Rows that no solid touches, by i.
  std::vector<double> open_quarter, quarter_width;  ///< a quarter where the x-face is open; of dx, 0 in ghosts
  std::vector<double> whole_nodes;                  ///< fractions of nodes from i = -1 on: 1, in ghosts 0
  std::vector<double> node_fraction, node_mass;
  std::vector<double> kinetic_loss;   ///< of whole nodes by mixing in the remap, beside gas, J/kg
  std::vector<double> volume_change;  ///< of cells by what is not flow through faces, m^3
  std::vector<double> viscosity;      ///< hourglass coefficient of cells, kg/s
  std::vector<double> rate;           ///< of volume in rows that solids touch, m^3/s
  /// What leaves the cells that solids cut, and in ghosts what flows in.
  struct Donor {
    std::vector<double> mass, energy, volume;  ///< per Lagrangian volume

    POLYNYA_STATE(mass, energy, volume)
  };
  std::array<Donor, 2> donor;
  std::vector<std::ptrdiff_t> held_cells;     ///< that solids cut, before or after, and members of groups: they
                                              ///< give what they held at the end of the Lagrange phase
  std::vector<unsigned char> held, row_held;  ///< 1 at these cells; by row: 1 where there are some
  std::vector<double> sweep_volume;           ///< of cells, during the remap, m^3
  struct Outflow {
    std::array<double, 2> mass{}, energy{};  ///< kg, J
  };
  std::array<std::vector<Outflow>, 6> outflow;  ///< of the last remap, by side and face
  std::vector<unsigned char> cut_rows;          ///< 1 where face coefficients or volumes may change, by row
  std::vector<unsigned char> row_materials;     ///< bit 1 water, bit 2 air, by row (j + (ny+3)*k)
  std::vector<std::int32_t> label;

  Fluid(Grid grid, Setup setup);

  /// Between steps. Left out: what the scene makes, and what a step writes before it reads it, except where fluid
  /// sleeps: there both are 0, and the kernels beside it read that (tests/fluid_solver/test_checkpoint.cpp).
  void list_state(compute::StateArchive& archive) {
    list_members(archive);
    if (!archive.loading()) return;
    for (auto* fields : {&face_rate, &next_velocity})
      for (auto& field : *fields) std::fill(field.begin(), field.end(), 0.0);
  }

 private:
  POLYNYA_STATE_MEMBERS_WITHOUT((setup, watch, held_faces, thin_nodes, face_rate, next_velocity), grid, setup, before,
                                after, groups, group_states, own_compression, material, velocity, motion, ambient,
                                beyond, far_field, start_damping, largest_density, account, sleeping, watch, time,
                                steps, lightened, correction_iterations, pressure, predicted_pressure, wall_impulse, density,
                                bulk_modulus, sound_speed, total_mass, face_coefficient, held_faces, thin_nodes,
                                face_rate, face_mass, next_velocity, open_quarter, quarter_width, whole_nodes,
                                node_fraction, node_mass, kinetic_loss, volume_change, viscosity, rate, donor,
                                held_cells, held, row_held, sweep_volume, outflow, cut_rows, row_materials, label)
};

/// State of one cell for `fill`: fraction of the free volume, density and specific energy of each material.
struct CellState {
  std::array<double, 2> fraction{}, density{}, specific_energy{};
};

/// Gives every cell the state that state(i, j, k) returns (padded indices from 1) and takes the layer's ambient from
/// the first column.
template <class StateOf>
void fill(Fluid& fluid, const Overlap& overlap, StateOf&& state);
/// Sets masses and energies of one cell from its state and its free volume.
void fill_cell(Fluid& fluid, std::ptrdiff_t cell, const CellState& state);
Ambient ambient_of(const Setup& setup, const CellState& state);
void set_ambient(Fluid& fluid, int k, const CellState& state);
/// Spreads the ambient state to the ghosts that feed inflow. Called by the fillers.
void apply_ambient(Fluid& fluid);
/// Node masses, groups, pressures and account of a fresh state. Called by the fillers.
void finish_filling(Fluid& fluid);

/// Water below `waterline`, air above, at rest relative to each other under gravity: the discrete balance of forces
/// holds to rounding. `velocity` is given to all nodes.
void fill_hydrostatic(Fluid& fluid, const Overlap& overlap, double waterline, std::array<double, 3> velocity = {});

/// Starts the fluid as the potential flow around the moving walls (see potential_flow.cpp) and sets the pressure that
/// belongs to it. Call after fill_hydrostatic. Returns the iterations of the projection.
int start_potential_flow(Fluid& fluid);

/// Fits a potential flow just started at `now` to the overlap a moment later, before the first step: a wall that lies
/// in a plane of faces leaves that plane at once, and only then its edges meet the nodes there. Leaves the fluid at
/// `now`.
int adapt_potential_flow(Fluid& fluid, const Overlap& now, const Overlap& soon, double waterline);

/// Advances by dt to the time at which the solids are as `overlap` says. Throws FluidError at a state without meaning:
/// what check_state names in the state it starts from, a grid that folds in its Lagrange phase, values that are not
/// finite or negative masses in the state it leaves. The state is then spoilt.
void step(Fluid& fluid, double dt, const Overlap& overlap);

/// Largest step the scheme bears: half a cell per sound speed plus flow speed, s.
double stable_step(const Fluid& fluid);

/// The cell whose fluid presses on the walls in `cell`: another one where a film too thin to hold fluid is all that
/// solids leave of it.
std::ptrdiff_t pressing_cell(const Fluid& fluid, std::ptrdiff_t cell);
/// z of the centre of `cell` less that of `other`, m.
double height_above(const Fluid& fluid, std::ptrdiff_t cell, std::ptrdiff_t other);

/// Absolute pressure on the walls in a cell, at the height of the whole cell's centre: the one the step used; the
/// atmosphere's where no fluid is left between solids, which is no load.
double wall_pressure(const Fluid& fluid, std::ptrdiff_t cell);

/// Gauge pressure and vertical pressure gradient (density times gravity) in cells (numbers of the messages):
/// p(z) = value - gradient (z - z of the whole cell's centre). After a step: what the step did to the fluid.
void overlap_pressure(const Fluid& fluid, std::span<const std::int64_t> cells, std::vector<double>& value,
                      std::vector<double>& gradient);

/// Refreshes pressure, density and sound speed from the state (also what a step does first).
void update_cell_states(Fluid& fluid);

/// Looks at every cell: throws FluidError, with the first cell's place and state, where values are not finite, a
/// density is negative or an equation of state is out of its range (equation_range.hpp).
void check_state(const Fluid& fluid);

/// Instantaneous entries of the account: energies, momentum, masses. False if some cell or node may have lost its
/// meaning: not finite, a negative mass, a negative energy of a gas.
bool update_account(Fluid& fluid);

struct FluidError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

template <class StateOf>
void fill(Fluid& fluid, const Overlap& overlap, StateOf&& state) {
  wake_all(fluid);
  fluid.after.set(fluid.grid, fluid.setup.boundary, overlap);
  fluid.before = fluid.after;
  for (int k = 1; k <= fluid.grid.nz; ++k) {
    set_ambient(fluid, k, state(1, 1, k));
    for (int j = 1; j <= fluid.grid.ny; ++j) {
      for (int i = 1; i <= fluid.grid.nx; ++i) fill_cell(fluid, fluid.grid.at(i, j, k), state(i, j, k));
    }
  }
  apply_ambient(fluid);
  finish_filling(fluid);
}

}  // namespace polynya::fluid
