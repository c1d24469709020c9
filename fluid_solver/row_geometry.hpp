#pragma once
#include <array>

#include "fluid_solver/fluid.hpp"

/// Faces and nodes as the kernels of the Lagrange phase see them, row by row. Rows that no solid touches, nearly all,
/// have the geometry of the empty grid: it is made from the widths and needs no field to be read.
namespace polynya::fluid {

/// True if no solid touches the cells (j, k) of a row, their lower faces or their nodes.
inline bool untouched(const Fluid& fluid, int j, int k) {
  return fluid.cut_rows[static_cast<std::size_t>(j + (fluid.grid.ny + 3) * k)] == 0;
}

/// What of a row is stepped (see Sleeping): cells, nodes that move, nodes and faces of awake cells; cells that are
/// read.
inline Span awake_cells(const Fluid& fluid, int j, int k) {
  return fluid.sleeping.cells[static_cast<std::size_t>(j + (fluid.grid.ny + 3) * k)];
}
inline Span awake_nodes(const Fluid& fluid, int j, int k) {
  return fluid.sleeping.nodes[static_cast<std::size_t>(j + (fluid.grid.ny + 3) * k)];
}
inline Span touched_nodes(const Fluid& fluid, int j, int k) {
  return fluid.sleeping.touched[static_cast<std::size_t>(j + (fluid.grid.ny + 3) * k)];
}
inline Span near_cells(const Fluid& fluid, int j, int k) {
  return fluid.sleeping.near[static_cast<std::size_t>(j + (fluid.grid.ny + 3) * k)];
}

/// Materials in the cells of a row that sleep: bit 1 water, bit 2 air.
inline int materials_at_rest(const Fluid& fluid, int j, int k) {
  return fluid.sleeping.rows_at_rest[static_cast<std::size_t>(j + (fluid.grid.ny + 3) * k)].materials;
}

/// Lower faces and nodes of an untouched row: coefficients (open area over the sum of node fractions) by i.
struct OpenRow {
  const double *by_x, *by_width;  ///< a quarter where the x-face is open; a quarter of dx
  double area, dz, dy;            ///< dy dz; dz and dy where the y- and z-face is open

  OpenRow(const Fluid& fluid, int j, int k)
      : by_x(fluid.open_quarter.data()), by_width(fluid.quarter_width.data()), area(0), dz(0), dy(0) {
    const Grid& grid = fluid.grid;
    const bool in_y = j >= 1 && j <= grid.ny, in_z = k >= 1 && k <= grid.nz;
    const auto& side = fluid.setup.boundary;
    const bool shut_y = (j == 1 && side[2] == Boundary::wall) || (j == grid.ny + 1 && side[3] == Boundary::wall);
    const bool shut_z = (k == 1 && side[4] == Boundary::wall) || (k == grid.nz + 1 && side[5] == Boundary::wall);
    if (in_y && in_z) area = grid.dy[j] * grid.dz[k];
    if (in_z && j >= 1 && !shut_y) dz = grid.dz[k];
    if (in_y && k >= 1 && !shut_z) dy = grid.dy[j];
  }
  double x(std::ptrdiff_t i) const { return by_x[i] * area; }
  double y(std::ptrdiff_t i) const { return by_width[i] * dz; }
  double z(std::ptrdiff_t i) const { return by_width[i] * dy; }
  double node(std::ptrdiff_t) const { return 1.0; }  ///< free fraction of a node, also of the next rows
};

/// The same for any row, from the fields.
struct TouchedRow {
  const double *ax, *ay, *az, *fraction;

  TouchedRow(const Fluid& fluid, int j, int k) {
    const std::ptrdiff_t row = fluid.grid.at(0, j, k);
    ax = fluid.face_coefficient[0].data() + row;
    ay = fluid.face_coefficient[1].data() + row;
    az = fluid.face_coefficient[2].data() + row;
    fraction = fluid.node_fraction.data() + row;
  }
  double x(std::ptrdiff_t i) const { return ax[i]; }
  double y(std::ptrdiff_t i) const { return ay[i]; }
  double z(std::ptrdiff_t i) const { return az[i]; }
  double node(std::ptrdiff_t i) const { return fraction[i]; }
};

/// Volume per time through the lower faces (entry i) of a row across each axis, from the velocities at its first node
/// (index 0 of the row): coefficient times the sum of fraction times velocity over the four nodes.
template <class Row, class Velocity>
inline double flow_x(const Row& at, const Velocity& u, std::ptrdiff_t i, std::ptrdiff_t sy, std::ptrdiff_t sz) {
  return at.x(i) * ((at.node(i) * u[i] + at.node(i + sy) * u[i + sy]) +
                    (at.node(i + sz) * u[i + sz] + at.node(i + sy + sz) * u[i + sy + sz]));
}
template <class Row, class Velocity>
inline double flow_y(const Row& at, const Velocity& v, std::ptrdiff_t i, std::ptrdiff_t sz) {
  return at.y(i) * ((at.node(i) * v[i] + at.node(i + 1) * v[i + 1]) +
                    (at.node(i + sz) * v[i + sz] + at.node(i + sz + 1) * v[i + sz + 1]));
}
template <class Row, class Velocity>
inline double flow_z(const Row& at, const Velocity& w, std::ptrdiff_t i, std::ptrdiff_t sy) {
  return at.z(i) * ((at.node(i) * w[i] + at.node(i + 1) * w[i + 1]) +
                    (at.node(i + sy) * w[i + sy] + at.node(i + sy + 1) * w[i + sy + 1]));
}

/// Calls body(row) with the row's geometry, open or touched.
template <class Body>
inline void with_row(const Fluid& fluid, int j, int k, Body&& body) {
  if (untouched(fluid, j, k))
    body(OpenRow(fluid, j, k));
  else
    body(TouchedRow(fluid, j, k));
}

/// Mass of both materials in a row of cells: of the only one there is where the row holds one.
inline const double* row_mass(const Fluid& fluid, int j, int k) {
  const std::size_t number = static_cast<std::size_t>(j + (fluid.grid.ny + 3) * k);
  const int held = fluid.row_materials[number];
  const std::vector<double>& mass = held == 3 || fluid.cut_rows[number] ? fluid.total_mass
                                    : held == 2                         ? fluid.material[1].mass
                                                                        : fluid.material[0].mass;
  return mass.data() + fluid.grid.at(0, j, k);
}

/// Runs body(number, block) for blocks of `Sleeping`.
template <class Body>
void for_blocks(const std::vector<Block>& blocks, Body&& body) {
  compute::for_uneven_chunks(blocks.size(), 1, [&](std::size_t b, std::size_t) { body(b, blocks[b]); });
}

}  // namespace polynya::fluid
