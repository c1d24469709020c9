#pragma once
#include <array>
#include <vector>

#include "fluid_solver/grid.hpp"

namespace polynya::fluid {

struct CutGeometry;
struct Fluid;

/// Fluid beyond a non-reflecting boundary, by layer of the grid: what flows in, and the pressure that holds it.
struct Ambient {
  double pressure = 0;                                            ///< at the height of the cell centre, Pa
  std::array<double, 2> fraction{}, density{}, energy_density{};  ///< per material; kg and J per m^3 of the mixture
};

/// Displacement of the lower and the upper end of the grid along one axis; planes between keep their share of the way.
struct EndMotion {
  std::array<double, 2> speed{};                    ///< m/s
  std::vector<double> time;                         ///< s, ascending
  std::array<std::vector<double>, 2> displacement;  ///< m, at these times, linear between, held before and after

  std::array<double, 2> at(double t) const;        ///< m: speed times t plus what the table says
  std::array<double, 2> speed_at(double t) const;  ///< m/s, of the moment after t
  bool moves() const { return speed[0] != 0 || speed[1] != 0 || !time.empty(); }
};

/// A grid whose planes move: in a step the cells go with the fluid from the grid as it is, and the remap puts them on
/// the planes of the step's end. Entries by plane are by padded index, that of the face or node above it; 0 at rest.
struct GridMotion {
  std::array<EndMotion, 3> prescribed;
  bool follows = false;  ///< instead, all planes across z go with the vehicle: by follow_to

  // State: with the time it says where the planes are.
  std::array<std::vector<double>, 3> first_line;   ///< planes that displacements count from, m
  std::array<std::vector<double>, 3> first_width;  ///< like Grid::dx, m
  std::array<std::array<double, 2>, 3> displaced;  ///< ends, now, m
  std::vector<Ambient> first_ambient;              ///< layers beyond open boundaries over the first planes along z

  // Of the step; `speed` between steps: of the next one.
  std::array<std::array<double, 2>, 3> next_displaced;  ///< ends at its end, m
  std::array<std::vector<double>, 3> shift, speed;      ///< of planes, m and m/s
  double follow_to = 0;                                 ///< m, where the planes across z shall be displaced to
  std::array<std::vector<double>, 3> next_width;        ///< like Grid::dx, at its end, m

  POLYNYA_STATE_WITHOUT((prescribed, follows), prescribed, follows, first_line, first_width, displaced, first_ambient,
                        next_displaced, shift, speed, follow_to, next_width)

  explicit GridMotion(const Grid& grid);
  bool active() const { return follows || prescribed[0].moves() || prescribed[1].moves() || prescribed[2].moves(); }
};

/// Sets how the grid moves from now on; `speed` is ready for stable_step. Throws std::invalid_argument unless sweeps
/// alternate.
void prescribe_motion(Fluid& fluid, const std::array<EndMotion, 3>& motion);

/// Lets the planes across z follow the vehicle: each step takes them where follow_to says. Throws std::invalid_argument
/// unless sweeps alternate, nothing sleeps and the ends along z are open: walls would be pistons.
void let_grid_follow(Fluid& fluid);
/// Takes the mean speed of the vehicle's wall along z, weighted with area, for the planes' in the next step; the last
/// one where it has no wall in the grid. Returns it, m/s.
double follow_vehicle(Fluid& fluid);
/// Displaces the planes across z, and with them the centre of the far field, to here (m, from where they were at first)
/// in the next step.
void follow_to(Fluid& fluid, double displacement);

/// Free volume that a cell gains between its lower and upper planes because these move, m^3: what of the change of its
/// free volume in a step is neither flow nor motion of walls. Faces are open as in the mean of `before` and `after`.
double volume_by_planes(const Fluid& fluid, const CutGeometry& before, const CutGeometry& after, std::ptrdiff_t cell);

/// The phases of a step that know of the motion; nothing happens on a grid at rest. Throws FluidError where a plane
/// moves by more than half of a cell or a direction shrinks to nothing.
void begin_grid_motion(Fluid& fluid, double dt);
/// Volume per time that walls of the domain sweep, written over the flow through the lower faces across `axis` of the
/// row (j, k), by i.
void set_wall_flow(const Fluid& fluid, int axis, int j, int k, double* flow);
/// Takes off the face rates what the planes sweep: they become rates through the moving faces, 0 at walls. In the order
/// of the sweeps an axis finds the others at their old places or at their new ones, so the volumes close to rounding.
void subtract_plane_motion(Fluid& fluid, double dt);
/// Puts the planes, the volumes and the layers of the ambient fluid to the step's end.
void end_grid_motion(Fluid& fluid);

}  // namespace polynya::fluid
