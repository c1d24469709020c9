// From bricks that are awake to what the kernels run over, and what a sleeping part adds up to.
#include "fluid_solver/sleeping.hpp"

#include <algorithm>
#include <cmath>

#include "fluid_solver/node_forces.hpp"
#include "fluid_solver/phases.hpp"

namespace polynya::fluid {
namespace {

using Spans = std::vector<Span>;

std::size_t row_number(const Grid& grid, int j, int k) {
  return static_cast<std::size_t>(j + (grid.ny + 3) * k);
}

/// From the first brick awake to the last in a row of bricks, counted from 0.
Span bricks_awake(const Sleeping& sleeping, int row) {
  const int count = sleeping.bricks[0];
  const unsigned char* awake = sleeping.awake.data() + static_cast<std::ptrdiff_t>(count) * row;
  Span span{0, count - 1};
  while (!span.empty() && !awake[span.first]) ++span.first;
  while (!span.empty() && !awake[span.last]) --span.last;
  return span;
}

/// One span for every row of cells, from the first brick awake to the last.
Spans cells_awake(const Grid& grid, const Sleeping& sleeping) {
  constexpr int edge = Sleeping::edge;
  const int ny = sleeping.bricks[1], nz = sleeping.bricks[2];
  Spans spans(static_cast<std::size_t>(grid.ny + 3) * (grid.nz + 3));
  for (int z = 0; z < nz; ++z) {
    for (int y = 0; y < ny; ++y) {
      const Span bricks = bricks_awake(sleeping, y + ny * z);
      if (bricks.empty()) continue;
      const Span span{1 + edge * bricks.first, std::min(grid.nx, edge * (bricks.last + 1))};
      for (int k = 1 + edge * z; k <= std::min(grid.nz, edge * (z + 1)); ++k) {
        for (int j = 1 + edge * y; j <= std::min(grid.ny, edge * (y + 1)); ++j) spans[row_number(grid, j, k)] = span;
      }
    }
  }
  return spans;
}

/// By row the hull of the spans from `lower` rows before to `upper` rows after it, along y and z.
Spans hull_of_rows(const Grid& grid, const Spans& spans, int lower, int upper) {
  Spans along_y(spans.size()), all(spans.size());
  const int ny = grid.ny + 2, nz = grid.nz + 2;
  for (int k = 0; k <= nz; ++k) {
    for (int j = 0; j <= ny; ++j) {
      Span& out = along_y[row_number(grid, j, k)];
      for (int y = std::max(j + lower, 0); y <= std::min(j + upper, ny); ++y)
        out = hull(out, spans[row_number(grid, y, k)]);
    }
  }
  for (int k = 0; k <= nz; ++k) {
    for (int j = 0; j <= ny; ++j) {
      Span& out = all[row_number(grid, j, k)];
      for (int z = std::max(k + lower, 0); z <= std::min(k + upper, nz); ++z)
        out = hull(out, along_y[row_number(grid, j, z)]);
    }
  }
  return all;
}

/// Nodes all of whose cells in the grid are awake.
Span nodes_within(const Grid& grid, const Spans& cells, int j, int k) {
  Span nodes{1, grid.nx + 1};
  for (int z = std::max(k - 1, 1); z <= std::min(k, grid.nz); ++z) {
    for (int y = std::max(j - 1, 1); y <= std::min(j, grid.ny); ++y) {
      const Span row = cells[row_number(grid, y, z)];
      if (row.empty()) return {};
      nodes.first = std::max(nodes.first, row.first == 1 ? 1 : row.first + 1);
      nodes.last = std::min(nodes.last, row.last == grid.nx ? grid.nx + 1 : row.last);
    }
  }
  return nodes.empty() ? Span{} : nodes;
}

void set_spans(const Grid& grid, Sleeping& sleeping) {
  sleeping.cells = cells_awake(grid, sleeping);
  sleeping.near = hull_of_rows(grid, sleeping.cells, -2, 2);
  for (Span& span : sleeping.near)
    if (!span.empty()) span = {std::max(span.first - 2, 1), std::min(span.last + 2, grid.nx)};
  sleeping.touched = hull_of_rows(grid, sleeping.cells, -1, 0);
  for (Span& span : sleeping.touched)
    if (!span.empty()) ++span.last;
  sleeping.nodes.assign(sleeping.cells.size(), {});
  sleeping.layers.assign(static_cast<std::size_t>(grid.nz) + 3, 0);
  sleeping.planes.assign(static_cast<std::size_t>(grid.ny) + 3, 0);
  sleeping.cells_awake = 0;
  for (int k = 1; k <= grid.nz + 1; ++k) {
    for (int j = 1; j <= grid.ny + 1; ++j) {
      sleeping.nodes[row_number(grid, j, k)] = nodes_within(grid, sleeping.cells, j, k);
      const Span row = sleeping.cells[row_number(grid, j, k)];
      if (row.empty()) continue;
      sleeping.layers[k] = sleeping.planes[j] = 1;
      sleeping.cells_awake += static_cast<std::size_t>(row.last - row.first + 1);
    }
  }
  sleeping.all_awake = sleeping.cells_awake == grid.cells();
}

/// Parts a block into blocks whose rows all have the same span.
void part(const Grid& grid, const Spans& spans, const Block& block, std::vector<Block>& parts) {
  const auto differ = [&](int j, int k, int y, int z) {
    return spans[row_number(grid, j, k)] != spans[row_number(grid, y, z)];
  };
  for (int j = block.first_j + 1; j <= block.last_j; ++j) {
    for (int k = block.first_k; k <= block.last_k; ++k) {
      if (!differ(j, k, j - 1, k)) continue;
      part(grid, spans, {block.first_j, j - 1, block.first_k, block.last_k, {}}, parts);
      part(grid, spans, {j, block.last_j, block.first_k, block.last_k, {}}, parts);
      return;
    }
  }
  for (int k = block.first_k + 1; k <= block.last_k; ++k) {
    if (!differ(block.first_j, k, block.first_j, k - 1)) continue;
    part(grid, spans, {block.first_j, block.last_j, block.first_k, k - 1, {}}, parts);
    part(grid, spans, {block.first_j, block.last_j, k, block.last_k, {}}, parts);
    return;
  }
  const Span along = spans[row_number(grid, block.first_j, block.first_k)];
  if (!along.empty()) parts.push_back({block.first_j, block.last_j, block.first_k, block.last_k, along});
}

/// Blocks that cover the spans of rows 1..ny+extra, 1..nz+extra; they depend on the grid and the spans alone.
std::vector<Block> blocks_of(const Grid& grid, const Spans& spans, int extra) {
  constexpr int rows = 32, layers = 16;
  const int ny = grid.ny + extra, nz = grid.nz + extra;
  const int across = (ny + rows - 1) / rows, up = (nz + layers - 1) / layers;
  // Even shares, so that no block is a thin rest.
  const auto share = [](int n, int parts, int number) { return n * number / parts; };
  std::vector<Block> blocks;
  for (int z = 0; z < up; ++z) {
    for (int y = 0; y < across; ++y) {
      part(grid, spans,
           {1 + share(ny, across, y), share(ny, across, y + 1), 1 + share(nz, up, z), share(nz, up, z + 1), {}},
           blocks);
    }
  }
  return blocks;
}

void set_sheltered(Sleeping& sleeping) {
  sleeping.sheltered.assign(sleeping.awake.size(), 1);
  for (std::size_t b = 0; b < sleeping.awake.size(); ++b)
    for_neighbours(sleeping.bricks, b, [&](std::size_t other) { sleeping.sheltered[b] &= sleeping.awake[other]; });
}

/// Cells that have fallen asleep: what their neighbours will read of them is that of a state at rest.
void put_cells_to_rest(Fluid& fluid, std::ptrdiff_t row, Span before, Span now) {
  for (int i = before.first; i <= before.last; ++i) {
    if (now.holds(i)) continue;
    fluid.predicted_pressure[row + i] = fluid.pressure[row + i];
    fluid.sweep_volume[row + i] = fluid.before.volume[row + i];
  }
}

/// No face of a row lets anything through until a step finds that it does.
void shut_faces(Fluid& fluid, std::ptrdiff_t row, Span faces) {
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = faces.first; i <= faces.last; ++i) fluid.face_rate[axis][row + i] = fluid.face_mass[axis][row + i] = 0;
  }
}

/// Nodes that no longer move. Returns the momentum (N s) and the kinetic energy (J) that they lose.
std::array<double, 4> put_nodes_to_rest(Fluid& fluid, std::ptrdiff_t row, Span before, Span now) {
  std::array<double, 4> taken{};
  for (int i = before.first; i <= before.last; ++i) {
    if (now.holds(i)) continue;
    const std::ptrdiff_t n = row + i;
    for (int d = 0; d < 3; ++d) {
      const double momentum = fluid.node_mass[n] * fluid.velocity[d][n];
      taken[d] += momentum;
      taken[3] += 0.5 * momentum * fluid.velocity[d][n];
      fluid.velocity[d][n] = fluid.next_velocity[d][n] = 0;
    }
  }
  return taken;
}

/// What the cells at rest do to the nodes of a row that no cell awake touches, N. Around these all is open.
std::array<double, 3> force_at_rest(const Fluid& fluid, int j, int k) {
  const NodeForces<OpenRow> force(fluid, j, k);
  const Span touched = fluid.sleeping.touched[row_number(fluid.grid, j, k)];
  std::array<double, 3> sum{};
  for (int i = 1; i <= fluid.grid.nx + 1; ++i) {
    if (touched.holds(i)) continue;
    sum[0] += force.x(i);
    sum[1] += force.y(i);
    sum[2] += force.z(i);
  }
  return sum;
}

/// Sums over the cells of a row, its lower z-faces and its nodes that are at rest.
RowAtRest sum_at_rest(const Fluid& fluid, int j, int k) {
  const Grid& grid = fluid.grid;
  const std::ptrdiff_t row = grid.at(0, j, k);
  const Span awake = fluid.sleeping.cells[row_number(grid, j, k)],
             faces = fluid.sleeping.touched[row_number(grid, j, k)];
  const bool cells = k <= grid.nz;
  RowAtRest sum;
  sum.force = force_at_rest(fluid, j, k);
  for (int i = 1; i <= grid.nx && j <= grid.ny; ++i) {
    const std::ptrdiff_t c = row + i;
    if (!faces.holds(i) && fluid.setup.gravity != 0) {
      const bool shut = (k == 1 && fluid.setup.boundary[4] == Boundary::wall) ||
                        (k > grid.nz && fluid.setup.boundary[5] == Boundary::wall);
      const double area = shut ? 0.0 : grid.dx[i] * grid.dy[j];
      sum.weight += area * 0.5 * (grid.dz[k - 1] * fluid.density[c - grid.sz] + grid.dz[k] * fluid.density[c]);
    }
    if (!cells || awake.holds(i)) continue;
    for (int m = 0; m < 2; ++m) {
      sum.mass[m] += fluid.material[m].mass[c];
      sum.internal += fluid.material[m].energy[c];
      if (fluid.material[m].mass[c] > 0) sum.materials |= static_cast<unsigned char>(1 << m);
    }
    if (fluid.sound_speed[c] > 0)
      sum.least_step = std::min(sum.least_step, std::min({grid.dx[i], grid.dy[j], grid.dz[k]}) / fluid.sound_speed[c]);
  }
  return sum;
}

void sum_rows_at_rest(Fluid& fluid) {
  const Grid& grid = fluid.grid;
  RowAtRest& all = fluid.sleeping.at_rest;
  all = {};
  for (int k = 1; k <= grid.nz + 1; ++k) {
    for (int j = 1; j <= grid.ny + 1; ++j) {
      const RowAtRest& row = fluid.sleeping.rows_at_rest[row_number(grid, j, k)];
      for (int d = 0; d < 3; ++d) all.force[d] += row.force[d];
      for (int m = 0; m < 2; ++m) all.mass[m] += row.mass[m];
      all.internal += row.internal;
      all.weight += row.weight;
      all.least_step = std::min(all.least_step, row.least_step);
      all.materials |= row.materials;
    }
  }
}

}  // namespace

Span hull(Span a, Span b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  return {std::min(a.first, b.first), std::max(a.last, b.last)};
}

void join_along_rows(Sleeping& sleeping) {
  const int nx = sleeping.bricks[0], rows = sleeping.bricks[1] * sleeping.bricks[2];
  for (int row = 0; row < rows; ++row) {
    const Span span = bricks_awake(sleeping, row);
    for (int b = span.first; b <= span.last; ++b) sleeping.awake[static_cast<std::size_t>(nx) * row + b] = 1;
  }
}

void wake_all(Fluid& fluid) {
  const Grid& grid = fluid.grid;
  Sleeping& sleeping = fluid.sleeping;
  const auto bricks = [](int cells) { return (cells + Sleeping::edge - 1) / Sleeping::edge; };
  sleeping = {};
  sleeping.bricks = {bricks(grid.nx), bricks(grid.ny), bricks(grid.nz)};
  const std::size_t count = static_cast<std::size_t>(sleeping.bricks[0]) * sleeping.bricks[1] * sleeping.bricks[2];
  sleeping.awake.assign(count, 1);
  sleeping.quiet_looks.assign(count, 0);
  sleeping.disturbance.assign(count, -1.0);
  arrange_awake(fluid);
}

void arrange_awake(Fluid& fluid) {
  const Grid& grid = fluid.grid;
  Sleeping& sleeping = fluid.sleeping;
  const Spans cells = sleeping.cells, nodes = sleeping.nodes, touched = sleeping.touched;
  join_along_rows(sleeping);
  set_spans(grid, sleeping);
  set_sheltered(sleeping);
  sleeping.cell_blocks = blocks_of(grid, sleeping.cells, 0);
  sleeping.touched_blocks = blocks_of(grid, sleeping.touched, 1);
  if (cells.empty()) {
    sleeping.rows_at_rest.assign(sleeping.cells.size(), {});
    return;
  }
  const auto taken = row_sums<4>(grid, 1, [&](int j, int k) {
    const std::size_t row = row_number(grid, j, k);
    const std::ptrdiff_t at = grid.at(0, j, k);
    if (touched[row] != sleeping.touched[row]) shut_faces(fluid, at, touched[row]);
    if (cells[row] != sleeping.cells[row]) put_cells_to_rest(fluid, at, cells[row], sleeping.cells[row]);
    if (nodes[row] == sleeping.nodes[row]) return std::array<double, 4>{};
    return put_nodes_to_rest(fluid, at, nodes[row], sleeping.nodes[row]);
  });
  for (int d = 0; d < 3; ++d) fluid.account.rest_impulse[d] += taken[d];
  fluid.account.put_to_rest += taken[3];
  // Only now: forces on nodes come from several rows of cells.
  for_rows(grid, 1, [&](int j, int k) {
    const std::size_t row = row_number(grid, j, k);
    if (cells[row] == sleeping.cells[row] && touched[row] == sleeping.touched[row]) return;
    sleeping.rows_at_rest[row] = sum_at_rest(fluid, j, k);
    const Span awake = sleeping.cells[row];
    for (std::ptrdiff_t c = grid.at(awake.first, j, k); c <= grid.at(awake.last, j, k); ++c)
      fluid.total_mass[c] = fluid.material[0].mass[c] + fluid.material[1].mass[c];
  });
  update_node_mass(fluid);
  sum_rows_at_rest(fluid);
  rest_boundaries(fluid);
}

void let_time_pass(Fluid& fluid, double dt) {
  fluid.time += dt;
  ++fluid.steps;
  fluid.sleeping.cells_in_all += static_cast<double>(fluid.grid.cells());
  fluid.account.gravity_impulse += dt * fluid.setup.gravity * fluid.sleeping.at_rest.weight;
  for (int d = 0; d < 3; ++d) fluid.account.rest_impulse[d] += dt * fluid.sleeping.at_rest.force[d];
  for (int side = 0; side < 6; ++side)
    fluid.account.boundary_impulse[side / 2] += dt * fluid.sleeping.boundary_force[side];
}

}  // namespace polynya::fluid
