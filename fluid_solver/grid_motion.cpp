// A grid whose planes move by prescription or follow a body (Hirt, Amsden & Cook 1974, J. Comput. Phys. 14:227; Benson
// 1992). The Lagrange phase does not know of it. In the remap the volume through a face is that of the fluid less that
// of the plane; the latter is (shift of the plane) times the widths across: new ones along axes already swept, old ones
// along the others, so that the three sweeps add up to the product of the new widths (geometric conservation, Thomas &
// Lombard 1979, AIAA J. 17:1030). Where solids close a part of a face, its plane sweeps the open part alone, open as in
// the mean of the step's two ends; what of a cell's change of free volume this does not explain is the walls' motion
// past the planes. A body that goes with its grid leaves volumes and faces as they are.
#include "fluid_solver/grid_motion.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "fluid_solver/phases.hpp"

namespace polynya::fluid {
namespace {

constexpr const char* axis_name[3] = {"x", "y", "z"};

const std::vector<double>& width_of(const Grid& grid, int axis) {
  return axis == 0 ? grid.dx : axis == 1 ? grid.dy : grid.dz;
}

/// Part of the way from the lower to the upper end at which a plane stands.
double share(const std::vector<double>& line, std::size_t plane) {
  return (line[plane] - line.front()) / (line.back() - line.front());
}

/// Value of a linear function between the ends, at a plane.
double between(const std::array<double, 2>& ends, double share) {
  return ends[0] + (ends[1] - ends[0]) * share;
}

/// Width of the cells along `other` while `axis` is swept: steps go xyz and zyx in turns (remap.cpp).
const std::vector<double>& width_in_sweep(const Fluid& fluid, int axis, int other) {
  const bool swept = fluid.steps % 2 == 0 ? other < axis : other > axis;
  return swept ? fluid.motion.next_width[other] : width_of(fluid.grid, other);
}

void set_speeds(GridMotion& motion, double time) {
  if (motion.follows) return;
  for (int axis = 0; axis < 3; ++axis) {
    const std::array<double, 2> ends = motion.prescribed[axis].speed_at(time);
    const std::vector<double>& line = motion.first_line[axis];
    for (std::size_t p = 0; p < line.size(); ++p) motion.speed[axis][p + 1] = between(ends, share(line, p));
  }
}

void check_that_it_can_move(const Fluid& fluid) {
  if (fluid.setup.sweeps != Sweeps::alternating)
    throw std::invalid_argument("a grid that moves is remapped in alternating orders of the sweeps");
  if (fluid.setup.sleeping_threshold > 0)
    throw std::invalid_argument("nothing sleeps on a grid that moves: fluid passes through every cell");
}

/// Throws FluidError unless cells along an axis outlive the shift of their planes.
void check_shift(const Fluid& fluid, int axis, double dt) {
  const std::vector<double>&shift = fluid.motion.shift[axis], &width = width_of(fluid.grid, axis);
  for (std::size_t p = 1; p + 2 < shift.size(); ++p) {
    const double most = 0.5 * std::min(width[p], fluid.motion.next_width[axis][p]);
    if (std::abs(shift[p]) <= most && std::abs(shift[p + 1]) <= most) continue;
    std::ostringstream text;
    text << "the grid moves too fast along " << axis_name[axis] << ": a step of " << dt << " s at time " << fluid.time
         << " s shifts a side of a cell of " << width[p] << " m by " << shift[p] << " or " << shift[p + 1]
         << " m; at most half a cell is possible";
    throw FluidError(text.str());
  }
}

/// Moves whole lines, from where they were at first, so that no rounding gathers.
void place_planes(Fluid& fluid) {
  Grid& grid = fluid.grid;
  const std::array<std::vector<double>*, 3> line{&grid.x, &grid.y, &grid.z}, width{&grid.dx, &grid.dy, &grid.dz};
  bool stretched = false;
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<double>& first = fluid.motion.first_line[axis];
    for (std::size_t p = 0; p < first.size(); ++p)
      (*line[axis])[p] = first[p] + between(fluid.motion.next_displaced[axis], share(first, p));
    stretched |= *width[axis] != fluid.motion.next_width[axis];
    *width[axis] = fluid.motion.next_width[axis];
  }
  if (!stretched) return;
  for_rows(grid, 0, [&](int j, int k) {
    for (int i = 1; i <= grid.nx; ++i) {
      const std::ptrdiff_t c = grid.at(i, j, k);
      grid.cell_volume[c] = fluid.before.volume[c] = fluid.after.volume[c] = grid.dx[i] * grid.dy[j] * grid.dz[k];
    }
  });
}

/// Layer of the first grid that holds a height; the outermost beyond.
std::size_t layer_at(const std::vector<double>& line, double z) {
  const auto above = std::upper_bound(line.begin() + 1, line.end() - 1, z);
  return static_cast<std::size_t>(above - line.begin());
}

/// The ambient fluid of a layer from z0 to z1: the first layers continued by their own weight. In a layer that held
/// both materials the first lies below the second.
Ambient ambient_between(const Fluid& fluid, double z0, double z1) {
  const std::vector<double>& line = fluid.motion.first_line[2];
  const auto& first = fluid.motion.first_ambient;
  const double centre = 0.5 * (z0 + z1);
  const std::size_t own = layer_at(line, centre);
  const double height = 0.5 * (line[own - 1] + line[own]);
  Ambient layer;
  layer.pressure =
      first[own].pressure - fluid.setup.gravity * (first[own].density[0] + first[own].density[1]) * (centre - height);
  double held = 0;
  for (std::size_t k = layer_at(line, z0); k <= layer_at(line, z1); ++k) {
    const double low = k == 1 ? z0 : std::max(z0, line[k - 1]),
                 high = k + 1 == line.size() ? z1 : std::min(z1, line[k]);
    const double border = line[k - 1] + first[k].fraction[0] * (line[k] - line[k - 1]);
    const bool both = first[k].fraction[0] > 0 && first[k].fraction[1] > 0;
    const double lower = both ? std::clamp(border, low, high) - low : first[k].fraction[0] * (high - low);
    layer.fraction[0] += std::max(lower, 0.0);
    held += std::max(high - low, 0.0);
  }
  layer.fraction[0] = layer.fraction[0] >= held ? 1.0 : layer.fraction[0] / held;
  layer.fraction[1] = 1.0 - layer.fraction[0];
  for (int m = 0; m < 2; ++m) {
    if (!(layer.fraction[m] > 0)) continue;
    std::size_t source = own;  // the nearest layer that holds this material
    for (std::size_t away = 0; away < line.size() && !(first[source].fraction[m] > 0); ++away) {
      const std::size_t below = own > away ? own - away : 1, above = std::min(own + away, line.size() - 1);
      source = first[below].fraction[m] > 0 ? below : above;
    }
    const Ambient& held_by = first[source];
    double density = held_by.density[m] / held_by.fraction[m];
    const double energy = held_by.energy_density[m] / held_by.density[m];
    if (layer.pressure != held_by.pressure) density = density_at(fluid.setup.law[m], layer.pressure, energy, density);
    layer.density[m] = layer.fraction[m] * density;
    layer.energy_density[m] = layer.density[m] * energy;
  }
  return layer;
}

void move_ambient(Fluid& fluid) {
  const Grid& grid = fluid.grid;
  for (int k = 1; k <= grid.nz; ++k)
    fluid.ambient[static_cast<std::size_t>(k)] = ambient_between(fluid, grid.z[k - 1], grid.z[k]);
  apply_ambient(fluid);
}

}  // namespace

std::array<double, 2> EndMotion::at(double t) const {
  std::array<double, 2> place{speed[0] * t, speed[1] * t};
  if (time.empty()) return place;
  const std::size_t later = static_cast<std::size_t>(std::upper_bound(time.begin(), time.end(), t) - time.begin());
  for (int end = 0; end < 2; ++end) {
    const std::vector<double>& way = displacement[end];
    if (later == 0 || later == time.size()) {
      place[end] += later == 0 ? way.front() : way.back();
    } else {
      const double part = (t - time[later - 1]) / (time[later] - time[later - 1]);
      place[end] += way[later - 1] + part * (way[later] - way[later - 1]);
    }
  }
  return place;
}

std::array<double, 2> EndMotion::speed_at(double t) const {
  std::array<double, 2> now = speed;
  const std::size_t later = static_cast<std::size_t>(std::upper_bound(time.begin(), time.end(), t) - time.begin());
  if (later == 0 || later == time.size()) return now;
  for (int end = 0; end < 2; ++end)
    now[end] += (displacement[end][later] - displacement[end][later - 1]) / (time[later] - time[later - 1]);
  return now;
}

GridMotion::GridMotion(const Grid& grid)
    : first_line{grid.x, grid.y, grid.z}, first_width{grid.dx, grid.dy, grid.dz}, displaced{}, next_displaced{} {
  for (int axis = 0; axis < 3; ++axis) {
    shift[axis].assign(first_line[axis].size() + 2, 0.0);
    speed[axis] = shift[axis];
  }
}

void prescribe_motion(Fluid& fluid, const std::array<EndMotion, 3>& motion) {
  check_that_it_can_move(fluid);
  fluid.motion.prescribed = motion;
  set_speeds(fluid.motion, fluid.time);
}

void let_grid_follow(Fluid& fluid) {
  check_that_it_can_move(fluid);
  if (fluid.setup.boundary[4] == Boundary::wall || fluid.setup.boundary[5] == Boundary::wall)
    throw std::invalid_argument("a grid that follows a body is open at its ends along z: walls would be pistons");
  fluid.motion.follows = true;
}

double follow_vehicle(Fluid& fluid) {
  double area = 0, moved = 0;
  for (const WallPiece& wall : fluid.after.walls) {
    const double own = std::hypot(wall.area[0][0], wall.area[0][1], wall.area[0][2]);
    area += own;
    moved += own * wall.velocity[0][2];
  }
  std::vector<double>& speed = fluid.motion.speed[2];
  if (area > 0) std::fill(speed.begin() + 1, speed.end() - 1, moved / area);
  return speed[1];
}

void follow_to(Fluid& fluid, double displacement) {
  fluid.motion.follow_to = displacement;
}

double volume_by_planes(const Fluid& fluid, const CutGeometry& before, const CutGeometry& after, std::ptrdiff_t cell) {
  int i, j, k;
  fluid.grid.position(cell, i, j, k);
  double volume = 0;
  for (int end = 0; end < 2; ++end) {
    const std::ptrdiff_t face = cell + end * fluid.grid.sz;
    const double open = 0.5 * (before.open[2][face] + after.open[2][face]), shift = fluid.motion.shift[2][k + end];
    volume += (end == 0 ? -1.0 : 1.0) * shift * open * fluid.grid.dx[i] * fluid.grid.dy[j];
  }
  return volume;
}

void begin_grid_motion(Fluid& fluid, double dt) {
  GridMotion& motion = fluid.motion;
  if (!motion.active()) return;
  if (!fluid.sleeping.all_awake) throw std::logic_error("a part of the fluid sleeps, but its grid moves");
  if (motion.first_ambient.empty()) motion.first_ambient = fluid.ambient;
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<double>& line = motion.first_line[axis];
    const bool following = motion.follows && axis == 2;
    const std::array<double, 2> now = motion.displaced[axis],
                                next = following ? std::array{motion.follow_to, motion.follow_to}
                                                 : motion.prescribed[axis].at(fluid.time + dt);
    const std::array<double, 2> way{next[0] - now[0], next[1] - now[1]};
    const double factor = 1.0 + (next[1] - next[0]) / (line.back() - line.front());
    motion.next_displaced[axis] = next;
    motion.next_width[axis] = motion.first_width[axis];
    for (double& width : motion.next_width[axis]) width *= factor;
    for (std::size_t p = 0; p < line.size(); ++p) {
      motion.shift[axis][p + 1] = between(way, share(line, p));
      motion.speed[axis][p + 1] = motion.shift[axis][p + 1] / dt;
    }
    check_shift(fluid, axis, dt);
  }
  close_wall_nodes(fluid);
}

void set_wall_flow(const Fluid& fluid, int axis, int j, int k, double* flow) {
  if (!fluid.motion.active()) return;
  const Grid& grid = fluid.grid;
  const std::array<int, 3> index{0, j, k}, count{grid.nx, grid.ny, grid.nz};
  const std::array<bool, 2> wall{fluid.setup.boundary[2 * axis] == Boundary::wall,
                                 fluid.setup.boundary[2 * axis + 1] == Boundary::wall};
  for (int other = 1; other < 3; ++other)
    if (other != axis && (index[other] < 1 || index[other] > count[other])) return;
  const int t1 = axis == 0 ? 1 : 0, t2 = axis == 2 ? 1 : 2;
  const std::vector<double>&w1 = width_in_sweep(fluid, axis, t1), &w2 = width_in_sweep(fluid, axis, t2);
  const std::vector<double>& speed = fluid.motion.speed[axis];
  for (int end = 0; end < 2; ++end) {
    const int plane = end == 0 ? 1 : count[axis] + 1;
    if (!wall[end]) continue;
    if (axis == 0) {
      flow[plane] = speed[plane] * w1[j] * w2[k];
    } else if (index[axis] == plane) {
      for (int i = 1; i <= grid.nx; ++i) flow[i] = speed[plane] * w1[i] * w2[axis == 1 ? k : j];
    }
  }
}

void subtract_plane_motion(Fluid& fluid, double dt) {
  if (!fluid.motion.active()) return;
  const Grid& grid = fluid.grid;
  const double over_dt = 1.0 / dt;
  const auto& side = fluid.setup.boundary;
  const auto shut = [&](int axis, int plane, int count) {
    return (plane == 1 && side[2 * axis] == Boundary::wall) ||
           (plane == count + 1 && side[2 * axis + 1] == Boundary::wall);
  };
  for_rows(grid, 1, [&](int j, int k) {
    const std::ptrdiff_t row = grid.at(0, j, k);
    const auto rate = [&](int axis) { return fluid.face_rate[axis].data() + row; };
    if (j <= grid.ny && k <= grid.nz) {
      double* q = rate(0);
      const double across = width_in_sweep(fluid, 0, 1)[j] * width_in_sweep(fluid, 0, 2)[k] * over_dt;
      for (int i = 1; i <= grid.nx + 1; ++i)
        q[i] = shut(0, i, grid.nx) ? 0.0 : q[i] - fluid.motion.shift[0][i] * across;
    }
    if (k <= grid.nz) {
      double* q = rate(1);
      const std::vector<double>& dx = width_in_sweep(fluid, 1, 0);
      const double across = fluid.motion.shift[1][j] * width_in_sweep(fluid, 1, 2)[k] * over_dt;
      for (int i = 1; i <= grid.nx; ++i) q[i] = shut(1, j, grid.ny) ? 0.0 : q[i] - dx[i] * across;
    }
    if (j <= grid.ny) {
      double* q = rate(2);
      const std::vector<double>& dx = width_in_sweep(fluid, 2, 0);
      const double across = fluid.motion.shift[2][k] * width_in_sweep(fluid, 2, 1)[j] * over_dt;
      const double *open = fluid.before.open[2].data() + row, *opens = fluid.after.open[2].data() + row;
      for (int i = 1; i <= grid.nx; ++i)
        q[i] = shut(2, k, grid.nz) ? 0.0 : q[i] - 0.5 * (open[i] + opens[i]) * dx[i] * across;
    }
  });
}

void end_grid_motion(Fluid& fluid) {
  GridMotion& motion = fluid.motion;
  if (!motion.active()) return;
  place_planes(fluid);
  const bool climbed = motion.displaced[2] != motion.next_displaced[2];
  if (motion.follows) fluid.far_field.centre[2] += motion.next_displaced[2][0] - motion.displaced[2][0];
  motion.displaced = motion.next_displaced;
  set_speeds(motion, fluid.time);
  if (motion.follows) follow_vehicle(fluid);
  if (climbed) move_ambient(fluid);
}

}  // namespace polynya::fluid
