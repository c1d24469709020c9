// Geometry of one step: time-centred open areas, divided by the node fractions of each face, so that the volume through
// a face is coefficient * sum(fraction * velocity) over its four nodes, and its adjoint is as short.
#include <algorithm>

#include "fluid_solver/phases.hpp"

namespace polynya::fluid {

std::vector<StepWall> join_walls(const CutGeometry& before, const CutGeometry& after) {
  std::vector<StepWall> walls;
  walls.reserve(std::max(before.walls.size(), after.walls.size()));
  const auto add = [&](const WallPiece* old_piece, const WallPiece* new_piece) {
    StepWall wall;
    wall.cell = new_piece ? new_piece->cell : old_piece->cell;
    for (int body = 0; body < 2; ++body) {
      double seen = 0;
      for (int axis = 0; axis < 3; ++axis) {
        wall.area[body][axis] =
            0.5 * ((old_piece ? old_piece->area[body][axis] : 0.0) + (new_piece ? new_piece->area[body][axis] : 0.0));
        if (new_piece) seen += new_piece->area[body][axis] * new_piece->area[body][axis];
      }
      // A wall that has just left the cell moved with the velocity it was last seen to have.
      const WallPiece* source = new_piece && (seen > 0 || !old_piece) ? new_piece : old_piece ? old_piece : new_piece;
      wall.velocity[body] = source->velocity[body];
      // Both areas move with the velocities of this step.
      if (new_piece) wall.sweep[body] += 0.5 * new_piece->sweep[body];
      if (old_piece) {
        wall.sweep[body] += 0.5 * old_piece->sweep[body];
        for (int axis = 0; axis < 3; ++axis)
          wall.sweep[body] +=
              0.5 * old_piece->area[body][axis] * (wall.velocity[body][axis] - old_piece->velocity[body][axis]);
      }
    }
    walls.push_back(wall);
  };
  std::size_t o = 0, n = 0;
  while (o < before.walls.size() || n < after.walls.size()) {
    const bool take_old =
        n == after.walls.size() || (o < before.walls.size() && before.walls[o].cell <= after.walls[n].cell);
    const bool take_new =
        o == before.walls.size() || (n < after.walls.size() && after.walls[n].cell <= before.walls[o].cell);
    add(take_old ? &before.walls[o] : nullptr, take_new ? &after.walls[n] : nullptr);
    o += take_old;
    n += take_new;
  }
  return walls;
}

namespace {

/// Rows whose coefficients solids touch, now or in the last step; the others keep theirs.
std::vector<unsigned char> rows_to_update(Fluid& fluid) {
  const std::ptrdiff_t width = fluid.grid.ny + 3;
  std::vector<unsigned char> rows = fluid.cut_rows;
  std::fill(fluid.cut_rows.begin(), fluid.cut_rows.end(), 0);
  for (const CutGeometry* cut : {&fluid.before, &fluid.after}) {
    for (const std::ptrdiff_t n : cut->nodes()) {
      unsigned char* row = fluid.cut_rows.data() + n / fluid.grid.sy;
      row[0] = row[-1] = row[-width] = row[-width - 1] = 1;
    }
  }
  for (std::size_t r = 0; r < rows.size(); ++r) rows[r] |= fluid.cut_rows[r];
  return rows;
}

/// What rows that no solid touches are made from.
void set_open_rows(Fluid& fluid) {
  const Grid& grid = fluid.grid;
  const std::size_t width = static_cast<std::size_t>(grid.nx) + 3;
  fluid.open_quarter.assign(width, 0.0);
  fluid.quarter_width.assign(width, 0.0);
  fluid.whole_nodes.assign(width + 2, 0.0);
  for (int i = 1; i <= grid.nx + 1; ++i) {
    const bool shut = (i == 1 && fluid.setup.boundary[0] == Boundary::wall) ||
                      (i == grid.nx + 1 && fluid.setup.boundary[1] == Boundary::wall);
    fluid.whole_nodes[i + 1] = 1.0;
    fluid.open_quarter[i] = shut ? 0.0 : 0.25;
    fluid.quarter_width[i] = i <= grid.nx ? 0.25 * grid.dx[i] : 0.0;
  }
}

}  // namespace

void update_face_coefficients(Fluid& fluid) {
  const Grid& grid = fluid.grid;
  set_open_rows(fluid);
  const std::ptrdiff_t sy = grid.sy, sz = grid.sz;
  const double *b0 = fluid.before.node_fraction.data(), *b1 = fluid.after.node_fraction.data();
  double* beta = fluid.node_fraction.data();
  const std::vector<unsigned char> rows = rows_to_update(fluid);
  const auto unchanged = [&](int j, int k) { return rows[static_cast<std::size_t>(j + (grid.ny + 3) * k)] == 0; };
  for_rows(grid, 1, [&](int j, int k) {
    if (unchanged(j, k)) return;
    const std::ptrdiff_t begin = grid.at(1, j, k), end = begin + grid.nx + 1;
    const double *v0 = fluid.before.volume.data(), *v1 = fluid.after.volume.data();
    double* change = fluid.volume_change.data();
    for (std::ptrdiff_t n = begin; n < end; ++n) {
      beta[n] = std::min(b0[n], b1[n]);
      change[n] = v1[n] - v0[n];
    }
    if (!fluid.motion.follows) return;
    for (std::ptrdiff_t n = begin; n < begin + grid.nx && j <= grid.ny && k <= grid.nz; ++n)
      change[n] -= volume_by_planes(fluid, fluid.before, fluid.after, n);
  });
  for_rows(grid, 1, [&](int j, int k) {
    if (unchanged(j, k)) return;
    const std::ptrdiff_t row = grid.at(0, j, k);
    const double area_x = grid.dy[j] * grid.dz[k], dy = grid.dy[j], dz = grid.dz[k];
    const double *x0 = fluid.before.open[0].data() + row, *x1 = fluid.after.open[0].data() + row;
    const double *y0 = fluid.before.open[1].data() + row, *y1 = fluid.after.open[1].data() + row;
    const double *z0 = fluid.before.open[2].data() + row, *z1 = fluid.after.open[2].data() + row;
    double* __restrict ax = fluid.face_coefficient[0].data() + row;
    double* __restrict ay = fluid.face_coefficient[1].data() + row;
    double* __restrict az = fluid.face_coefficient[2].data() + row;
    const double* b = beta + row;
    const double* dx = grid.dx.data();
    for (int i = 1; i <= grid.nx + 1; ++i) {
      const double bx = b[i] + b[i + sy] + b[i + sz] + b[i + sy + sz];
      const double by = b[i] + b[i + 1] + b[i + sz] + b[i + 1 + sz];
      const double bz = b[i] + b[i + 1] + b[i + sy] + b[i + 1 + sy];
      const double sx = 0.5 * (x0[i] + x1[i]) * area_x, syy = 0.5 * (y0[i] + y1[i]) * dx[i] * dz;
      const double szz = 0.5 * (z0[i] + z1[i]) * dx[i] * dy;
      ax[i] = bx > 0 ? sx / (bx > 0 ? bx : 1.0) : 0.0;
      ay[i] = by > 0 ? syy / (by > 0 ? by : 1.0) : 0.0;
      az[i] = bz > 0 ? szz / (bz > 0 ? bz : 1.0) : 0.0;
    }
  });
}

void apply_to_cells(Fluid& fluid, const VolumeCorrection& correction) {
  for (std::size_t c = 0; c < correction.cells.size(); ++c) {
    fluid.volume_change[correction.cells[c]] += correction.outflow[c];
    fluid.cut_rows[static_cast<std::size_t>(correction.cells[c] / fluid.grid.sy)] = 1;
  }
}

void apply_to_faces(Fluid& fluid, const VolumeCorrection& correction, double dt) {
  for (const auto& [face, axis, volume] : correction.faces) fluid.face_rate[axis][face] += volume / dt;
}

}  // namespace polynya::fluid
