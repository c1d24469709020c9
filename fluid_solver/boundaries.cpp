// The six sides of the grid. Walls (and planes of symmetry) have closed faces and no normal velocity. Non-reflecting
// sides hold the undisturbed pressure of their layer plus the impedance rho c times the outward speed, and let fluid
// through: what leaves has the state inside, what enters has the ambient state of the layer. Around a body, waves are
// spherical: (d/dt + c d/dr + c/r) p = 0 with rho du/dt = -dp/dr gives p = rho c (u - w), dw/dt = c/r (u - w). The part
// w of the outward speed, which starts as that of the potential flow, meets no resistance (Geers 1978, J. Acoust. Soc.
// Am. 64:1500).
#include <algorithm>
#include <cmath>

#include "fluid_solver/phases.hpp"

namespace polynya::fluid {
namespace {

struct Side {
  int axis;
  bool upper;
};
constexpr std::array<Side, 6> sides{{{0, false}, {0, true}, {1, false}, {1, true}, {2, false}, {2, true}}};

int number(const Grid& grid, int axis) {
  return axis == 0 ? grid.nx : axis == 1 ? grid.ny : grid.nz;
}

/// What of a side is gone along: cells that are awake or asleep, nodes that have a cell awake, or all of them.
enum class Part { awake, asleep, touched_nodes, all_nodes };

/// Calls body(inner cell or node, its place along the side) along that part of a side.
template <class Body>
void along(const Fluid& fluid, Side side, Part part, Body&& body) {
  const Grid& grid = fluid.grid;
  const int extra = part == Part::touched_nodes || part == Part::all_nodes;
  const std::vector<Span>& spans = extra ? fluid.sleeping.touched : fluid.sleeping.cells;
  const int t1 = side.axis == 0 ? 1 : 0, t2 = side.axis == 2 ? 1 : 2, width = grid.ny + 3;
  const std::ptrdiff_t s1 = grid.stride(t1), s2 = grid.stride(t2);
  const int outermost = side.upper ? number(grid, side.axis) + extra : 1;
  std::size_t place = 0;
  for (int b = 1; b <= number(grid, t2) + extra; ++b) {
    for (int a = 1; a <= number(grid, t1) + extra; ++a, ++place) {
      const int row = side.axis == 0 ? a + width * b : side.axis == 1 ? outermost + width * b : b + width * outermost;
      const bool awake = spans[static_cast<std::size_t>(row)].holds(side.axis == 0 ? outermost : a);
      if (part == Part::all_nodes || awake != (part == Part::asleep))
        body(outermost * grid.stride(side.axis) + a * s1 + b * s2, place);
    }
  }
}

double face_area(const Grid& grid, int axis, std::ptrdiff_t cell) {
  int i, j, k;
  grid.position(cell, i, j, k);
  return axis == 0 ? grid.dy[j] * grid.dz[k] : axis == 1 ? grid.dx[i] * grid.dz[k] : grid.dx[i] * grid.dy[j];
}

double width(const Grid& grid, int axis, std::ptrdiff_t cell) {
  int i, j, k;
  grid.position(cell, i, j, k);
  return axis == 0 ? grid.dx[i] : axis == 1 ? grid.dy[j] : grid.dz[k];
}

const Ambient& outside(const Fluid& fluid, Side side, std::ptrdiff_t cell) {
  const auto& beyond = fluid.beyond[static_cast<std::size_t>(2 * side.axis + side.upper)];
  return beyond ? beyond->state : fluid.ambient[static_cast<std::size_t>(cell / fluid.grid.sz)];
}

double ambient_speed(const Fluid& fluid, Side side) {
  const auto& beyond = fluid.beyond[static_cast<std::size_t>(2 * side.axis + side.upper)];
  return beyond ? beyond->velocity : fluid.setup.ambient_velocity[side.axis];
}

/// Speed of the plane of a side, m/s; 0 on a grid at rest.
double side_speed(const Fluid& fluid, Side side) {
  const std::vector<double>& speed = fluid.motion.speed[side.axis];
  return speed[static_cast<std::size_t>(side.upper ? number(fluid.grid, side.axis) + 1 : 1)];
}

double mean_open(const Fluid& fluid, int axis, std::ptrdiff_t face) {
  return 0.5 * (fluid.before.open[axis][face] + fluid.after.open[axis][face]);
}

}  // namespace

void apply_ambient(Fluid& fluid) {
  const Grid& grid = fluid.grid;
  for (const Side side : sides) {
    along(fluid, side, Part::awake, [&](std::ptrdiff_t cell, std::size_t) {
      const std::ptrdiff_t ghost = side.upper ? cell + grid.stride(side.axis) : cell - grid.stride(side.axis);
      const Ambient& ambient = outside(fluid, side, cell);
      for (int m = 0; m < 2; ++m) {
        fluid.donor[m].mass[ghost] = ambient.density[m];
        fluid.donor[m].energy[ghost] = ambient.energy_density[m];
        fluid.donor[m].volume[ghost] = ambient.fraction[m];
      }
    });
  }
}

namespace {

double outward_speed(const Fluid& fluid, Side side, std::ptrdiff_t cell) {
  const std::ptrdiff_t face = side.upper ? cell + fluid.grid.stride(side.axis) : cell;
  const double area = face_area(fluid.grid, side.axis, cell) * mean_open(fluid, side.axis, face);
  if (!(area > 0)) return 0;
  return (side.upper ? 1.0 : -1.0) * (fluid.face_rate[side.axis][face] / area - ambient_speed(fluid, side));
}

/// Cosine of the way out with the ray from the body's centre, over the distance from it, 1/m.
double spreading(const Fluid& fluid, Side side, std::ptrdiff_t cell) {
  const Grid& grid = fluid.grid;
  int index[3];
  grid.position(cell, index[0], index[1], index[2]);
  std::array<double, 3> ray{grid.centre_x(index[0]), grid.centre_y(index[1]), grid.centre_z(index[2])};
  const std::vector<double>& line = side.axis == 0 ? grid.x : side.axis == 1 ? grid.y : grid.z;
  ray[side.axis] = side.upper ? line.back() : line.front();
  double square = 0;
  for (int d = 0; d < 3; ++d) {
    ray[d] -= fluid.far_field.centre[d];
    square += ray[d] * ray[d];
  }
  return std::max(0.0, (side.upper ? 1.0 : -1.0) * ray[side.axis]) / square;
}

}  // namespace

void start_far_field(Fluid& fluid, const std::array<double, 3>& centre) {
  fluid.far_field.centre = centre;
  fluid.far_field.spherical = true;
  face_rates(fluid, fluid.velocity, fluid.face_rate);
  for (std::size_t s = 0; s < sides.size(); ++s) {
    std::vector<double>& slow = fluid.far_field.slow_speed[s];
    slow.assign(fluid.outflow[s].size(), 0.0);
    if (fluid.setup.boundary[s] == Boundary::wall) continue;
    along(fluid, sides[s], Part::awake,
          [&](std::ptrdiff_t cell, std::size_t place) { slow[place] = outward_speed(fluid, sides[s], cell); });
  }
}

void advance_far_field(Fluid& fluid, double dt) {
  if (!fluid.far_field.spherical) return;
  for (std::size_t s = 0; s < sides.size(); ++s) {
    if (fluid.setup.boundary[s] == Boundary::wall) continue;
    along(fluid, sides[s], Part::awake, [&](std::ptrdiff_t cell, std::size_t place) {
      double& slow = fluid.far_field.slow_speed[s][place];
      slow += dt * fluid.sound_speed[cell] * spreading(fluid, sides[s], cell) *
              (outward_speed(fluid, sides[s], cell) - slow);
    });
  }
}

void set_boundary_pressure(Fluid& fluid, double dt) {
  const Grid& grid = fluid.grid;
  for (std::size_t s = 0; s < sides.size(); ++s) {
    if (fluid.setup.boundary[s] == Boundary::wall) continue;
    const Side side = sides[s];
    const std::ptrdiff_t stride = grid.stride(side.axis);
    const double outward = side.upper ? 1.0 : -1.0;
    along(fluid, side, Part::awake, [&](std::ptrdiff_t cell, std::size_t place) {
      const std::ptrdiff_t ghost = side.upper ? cell + stride : cell - stride;
      const double slow = fluid.far_field.spherical ? fluid.far_field.slow_speed[s][place] : 0.0;
      const std::size_t k = static_cast<std::size_t>(cell / grid.sz);
      const Ambient& ambient = outside(fluid, side, cell);
      double pressure = ambient.pressure, inside = fluid.predicted_pressure[cell];
      if (side.axis == 2) {
        // From the height of the cell's centre to the face, with the ambient density and with that inside.
        const double density = ambient.density[0] + ambient.density[1];
        pressure -= outward * fluid.setup.gravity * (0.5 * grid.dz[k] * density);
        inside -= outward * fluid.setup.gravity * (0.5 * grid.dz[k] * fluid.density[cell]);
      }
      const double impedance = fluid.density[cell] * fluid.sound_speed[cell];
      // The outward speed is that of the middle of the step: by then what drives the half cell at the face, inside less
      // outside, has changed it by dt/2 over density times half a width. (With the speed at the start of the step 4 %
      // of a wave of twenty cells came back, now 0.7 %.)
      const double share = fluid.sound_speed[cell] * dt / width(grid, side.axis, cell);
      const double now = pressure + impedance * (outward_speed(fluid, side, cell) - slow);
      fluid.predicted_pressure[ghost] = (now + share * inside) / (1.0 + share);
    });
  }
}

namespace {

/// Force of a cell along a side on what lies beyond it, along the outward direction, N.
double force_on_side(const Fluid& fluid, Side side, bool wall, std::ptrdiff_t cell) {
  const std::ptrdiff_t stride = fluid.grid.stride(side.axis);
  const std::ptrdiff_t face = side.upper ? cell + stride : cell, ghost = side.upper ? cell + stride : cell - stride;
  const std::ptrdiff_t opposite = side.upper ? cell : cell + stride;
  const double area = face_area(fluid.grid, side.axis, cell);
  const double open = area * mean_open(fluid, side.axis, face) * fluid.predicted_pressure[ghost];
  // What closes the cell besides its open faces and the bodies is the wall of the domain.
  return wall ? open + area * mean_open(fluid, side.axis, opposite) * fluid.predicted_pressure[cell] : open;
}

}  // namespace

void book_boundary(Fluid& fluid, double dt, const std::vector<StepWall>& walls) {
  const Grid& grid = fluid.grid;
  Account& account = fluid.account;
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const Side side = sides[s];
    const std::ptrdiff_t stride = grid.stride(side.axis);
    const double outward = side.upper ? 1.0 : -1.0;
    double impulse = 0, work = 0;
    along(fluid, side, Part::awake, [&](std::ptrdiff_t cell, std::size_t) {
      const std::ptrdiff_t face = side.upper ? cell + stride : cell, ghost = side.upper ? cell + stride : cell - stride;
      const bool wall = fluid.setup.boundary[s] == Boundary::wall;
      impulse += dt * outward * force_on_side(fluid, side, wall, cell);
      double at_face = fluid.predicted_pressure[ghost];
      if (wall) {  // that moves with the grid does work, of half a cell's weight too
        at_face = fluid.predicted_pressure[cell];
        if (side.axis == 2)
          at_face -= outward * fluid.setup.gravity * (0.5 * width(grid, 2, cell) * fluid.density[cell]);
      }
      work += dt * outward * fluid.face_rate[side.axis][face] * at_face;
    });
    impulse += dt * fluid.sleeping.boundary_force[s];
    if (fluid.setup.boundary[s] == Boundary::wall) {
      for (const StepWall& wall : walls) {
        int index[3];
        grid.position(wall.cell, index[0], index[1], index[2]);
        if (index[side.axis] != (side.upper ? number(grid, side.axis) : 1)) continue;
        if (number(grid, side.axis) == 1) continue;  // one cell thick: both sides share it, and nothing moves across
        impulse -= dt * fluid.predicted_pressure[wall.cell] * (wall.area[0][side.axis] + wall.area[1][side.axis]);
      }
    }
    account.boundary_impulse[side.axis] += impulse;
    account.boundary_work += work;
  }
}

void book_boundary_flow(Fluid& fluid) {
  const Grid& grid = fluid.grid;
  Account& account = fluid.account;
  for (std::size_t s = 0; s < sides.size(); ++s) {
    if (fluid.setup.boundary[s] == Boundary::wall) continue;
    const Side side = sides[s];
    const double outward = side.upper ? 1.0 : -1.0;
    along(fluid, side, Part::awake, [&](std::ptrdiff_t, std::size_t place) {
      const Fluid::Outflow& out = fluid.outflow[s][place];
      for (int m = 0; m < 2; ++m) {
        account.boundary_mass[m] += out.mass[m];
        account.boundary_energy += out.energy[m];
      }
    });
    const std::ptrdiff_t t1 = grid.stride((side.axis + 1) % 3), t2 = grid.stride((side.axis + 2) % 3);
    const double* mass = fluid.face_mass[side.axis].data();
    along(fluid, side, Part::touched_nodes, [&](std::ptrdiff_t node, std::size_t) {
      const double out = outward * 0.25 * ((mass[node] + mass[node - t1]) + (mass[node - t2] + mass[node - t1 - t2]));
      for (int d = 0; d < 3; ++d) account.boundary_impulse[d] += out * fluid.next_velocity[d][node];
    });
  }
}

void copy_face_mass_to_ghosts(Fluid& fluid) {
  const Grid& grid = fluid.grid;
  for (const Side side : sides) {
    const std::ptrdiff_t stride = grid.stride(side.axis);
    along(fluid, side, Part::awake, [&](std::ptrdiff_t cell, std::size_t) {
      const std::ptrdiff_t face = side.upper ? cell + stride : cell;
      fluid.face_mass[side.axis][side.upper ? face + stride : face - stride] = fluid.face_mass[side.axis][face];
    });
  }
}

void copy_velocity_to_ghosts(Fluid& fluid) {
  const Grid& grid = fluid.grid;
  for (const Side side : sides) {
    const std::ptrdiff_t stride = grid.stride(side.axis);
    along(fluid, side, Part::touched_nodes, [&](std::ptrdiff_t node, std::size_t) {
      const std::ptrdiff_t ghost = side.upper ? node + stride : node - stride;
      for (auto& component : fluid.next_velocity) component[ghost] = component[node];
    });
  }
}

void close_wall_nodes(Fluid& fluid) {
  for (std::size_t s = 0; s < sides.size(); ++s) {
    if (fluid.setup.boundary[s] != Boundary::wall) continue;
    const int axis = sides[s].axis;
    const double wall = side_speed(fluid, sides[s]);
    along(fluid, sides[s], Part::touched_nodes, [&](std::ptrdiff_t node, std::size_t) {
      double& u = fluid.velocity[axis][node];
      if (u == wall) return;
      fluid.account.boundary_impulse[axis] += fluid.node_mass[node] * (u - wall);
      fluid.account.node_fix += 0.5 * fluid.node_mass[node] * (u - wall) * (u + wall);
      u = wall;
    });
  }
}

void rest_boundaries(Fluid& fluid) {
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const Side side = sides[s];
    const std::ptrdiff_t out = side.upper ? fluid.grid.stride(side.axis) : -fluid.grid.stride(side.axis);
    double force = 0;
    along(fluid, side, Part::asleep, [&](std::ptrdiff_t cell, std::size_t) {
      force += force_on_side(fluid, side, fluid.setup.boundary[s] == Boundary::wall, cell);
      fluid.face_mass[side.axis][side.upper ? cell + 2 * out : cell + out] = 0;
    });
    fluid.sleeping.boundary_force[s] = side.upper ? force : -force;
    along(fluid, side, Part::all_nodes, [&](std::ptrdiff_t node, std::size_t) {
      for (auto& component : fluid.next_velocity) component[node + out] = component[node];
    });
  }
}

void mirror_pressure(Fluid& fluid) {
  const Grid& grid = fluid.grid;
  double* p = fluid.pressure.data();
  for (int k = 1; k <= grid.nz; ++k) {
    for (int j = 1; j <= grid.ny; ++j) {
      p[grid.at(0, j, k)] = p[grid.at(1, j, k)];
      p[grid.at(grid.nx + 1, j, k)] = p[grid.at(grid.nx, j, k)];
    }
    for (int i = 0; i <= grid.nx + 1; ++i) {
      p[grid.at(i, 0, k)] = p[grid.at(i, 1, k)];
      p[grid.at(i, grid.ny + 1, k)] = p[grid.at(i, grid.ny, k)];
    }
  }
  for (int j = 0; j <= grid.ny + 1; ++j) {
    for (int i = 0; i <= grid.nx + 1; ++i) {
      p[grid.at(i, j, 0)] = p[grid.at(i, j, 1)];
      p[grid.at(i, j, grid.nz + 1)] = p[grid.at(i, j, grid.nz)];
    }
  }
}

}  // namespace polynya::fluid
