#include "fluid_solver/cut_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "core/compute/large_pages.hpp"

namespace polynya::fluid {

double empty_open_fraction(const Grid& grid, const std::array<Boundary, 6>& boundary, int axis, std::ptrdiff_t face) {
  const std::array<int, 3> number{grid.nx, grid.ny, grid.nz};
  std::array<int, 3> index{};
  grid.position(face, index[0], index[1], index[2]);
  for (int other = 0; other < 3; ++other) {
    if (index[other] < 1 || index[other] > number[other] + (other == axis)) return 0.0;
  }
  if (index[axis] == 1) return boundary[2 * axis] == Boundary::wall ? 0.0 : 1.0;
  if (index[axis] == number[axis] + 1) return boundary[2 * axis + 1] == Boundary::wall ? 0.0 : 1.0;
  return 1.0;
}

CutGeometry::CutGeometry(const Grid& grid, const std::array<Boundary, 6>& boundary)
    : volume(compute::zeros_in_large_pages(grid.size)),
      node_fraction(compute::zeros_in_large_pages(grid.size)),
      listed_(grid.size, 0) {
  for (auto& fraction : open) fraction = compute::zeros_in_large_pages(grid.size);
  for_rows(grid, 1, [&](int j, int k) {
    for (int i = 1; i <= grid.nx + 1; ++i) {
      const std::ptrdiff_t c = grid.at(i, j, k);
      if (i <= grid.nx && j <= grid.ny && k <= grid.nz) volume[c] = grid.cell_volume[c];
      for (int axis = 0; axis < 3; ++axis) open[axis][c] = empty_open_fraction(grid, boundary, axis, c);
      node_fraction[c] = 1.0;
    }
  });
}

void CutGeometry::restore(const Grid& grid) {
  for (const std::ptrdiff_t c : cells_) volume[c] = grid.cell_volume[c];
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t f = faces_[axis].size(); f-- > 0;) open[axis][faces_[axis][f].index] = faces_[axis][f].empty;
    faces_[axis].clear();
  }
  for (const std::ptrdiff_t n : nodes_) node_fraction[n] = 1.0;
  cells_.clear();
  nodes_.clear();
  walls.clear();
  dry_walls.clear();
  clamped_debris = 0;
}

void CutGeometry::set(const Grid& grid, const std::array<Boundary, 6>& boundary, const Overlap& overlap) {
  restore(grid);
  for (std::size_t m = 0; m < overlap.cell.size(); ++m) {
    const std::ptrdiff_t c = grid.from_message(overlap.cell[m]);
    const double full = grid.cell_volume[c], solid = overlap.solid_volume[m];
    double debris = overlap.debris_volume.empty() ? 0.0 : overlap.debris_volume[m];
    if (!(solid >= -1e-9 * full && solid <= full * (1.0 + 1e-9) && debris >= 0)) {
      throw std::invalid_argument("overlap cell " + std::to_string(overlap.cell[m]) + ": solid volume " +
                                  std::to_string(solid / full) + " and debris " + std::to_string(debris / full) +
                                  " of the cell's volume; expected 0 to 1");
    }
    const double room = std::max(0.0, full - solid);
    // Particles may be packed closer than the cell allows where solids crowd it; some fluid always stays between them.
    if (debris > 0.9 * room) {
      debris = 0.9 * room;
      ++clamped_debris;
    }
    const double free = room - debris;
    volume[c] = free < void_fraction * full ? 0.0 : free;
    cells_.push_back(c);
    WallPiece piece{.cell = c, .debris = debris, .area = {}, .velocity = {}, .size = 0, .sweep = {}};
    for (int body = 0; body < 2; ++body) {
      for (int axis = 0; axis < 3; ++axis) {
        piece.area[body][axis] = overlap.wall_area[6 * m + 3 * body + axis];
        piece.velocity[body][axis] = overlap.wall_velocity[6 * m + 3 * body + axis];
        piece.sweep[body] += piece.area[body][axis] * piece.velocity[body][axis];
      }
      if (!overlap.wall_sweep.empty()) piece.sweep[body] = overlap.wall_sweep[2 * m + body];
    }
    for (const auto& [x, y, z] : piece.area) piece.size += std::hypot(x, y, z);
    if (!overlap.wall_size.empty()) piece.size = overlap.wall_size[m];
    walls.push_back(piece);
  }
  const auto in_order = [](const WallPiece& a, const WallPiece& b) { return a.cell < b.cell; };
  if (!std::is_sorted(walls.begin(), walls.end(), in_order)) std::sort(walls.begin(), walls.end(), in_order);
  find_dry_walls(grid);
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t m = 0; m < overlap.face[axis].size(); ++m) {
      const std::ptrdiff_t f = grid.face_from_message(axis, overlap.face[axis][m]);
      const double solid = std::clamp(overlap.face_solid[axis][m], 0.0, 1.0);
      const double empty = open[axis][f];  // as `restore` has left it
      open[axis][f] = empty * (1.0 - solid);
      faces_[axis].push_back({f, empty});
    }
  }
  // Nothing flows through the faces of a cell without fluid.
  for (const std::ptrdiff_t c : cells_) {
    if (volume[c] > 0) continue;
    for (int axis = 0; axis < 3; ++axis) {
      for (const std::ptrdiff_t f : {c, c + grid.stride(axis)}) {
        if (open[axis][f] == 0.0) continue;
        faces_[axis].push_back({f, empty_open_fraction(grid, boundary, axis, f)});
        open[axis][f] = 0.0;
      }
    }
  }
  update_nodes(grid);
}

void CutGeometry::find_dry_walls(const Grid& grid) {
  for (const WallPiece& wall : walls) {
    if (volume[wall.cell] > 0) continue;
    // Areas point into the body: the fluid is on the other side.
    double largest = 0;
    std::ptrdiff_t towards = 0;
    for (const auto& area : wall.area) {
      for (int axis = 0; axis < 3; ++axis) {
        if (std::abs(area[axis]) <= largest) continue;
        largest = std::abs(area[axis]);
        towards = area[axis] > 0 ? -grid.stride(axis) : grid.stride(axis);
      }
    }
    if (towards != 0 && volume[wall.cell + towards] > 0) dry_walls.push_back({wall.cell, wall.cell + towards});
  }
}

std::ptrdiff_t CutGeometry::pressing_on(std::ptrdiff_t cell) const {
  const auto at = std::lower_bound(dry_walls.begin(), dry_walls.end(), cell,
                                   [](const DryWall& wall, std::ptrdiff_t c) { return wall.cell < c; });
  return at != dry_walls.end() && at->cell == cell ? at->wet : cell;
}

const WallPiece* CutGeometry::wall_in(std::ptrdiff_t cell) const {
  const auto at = std::lower_bound(walls.begin(), walls.end(), cell,
                                   [](const WallPiece& wall, std::ptrdiff_t c) { return wall.cell < c; });
  return at != walls.end() && at->cell == cell ? &*at : nullptr;
}

void CutGeometry::open_like(const CutGeometry& later) {
  std::vector<double> own_volume = std::move(volume);
  const std::vector<std::ptrdiff_t> own_cells = std::move(cells_), own_nodes = std::move(nodes_);
  const auto own_faces = std::move(faces_);
  *this = later;
  volume = std::move(own_volume);
  // What was touched before has to be restored as well.
  cells_.insert(cells_.end(), own_cells.begin(), own_cells.end());
  nodes_.insert(nodes_.end(), own_nodes.begin(), own_nodes.end());
  for (int axis = 0; axis < 3; ++axis)
    faces_[axis].insert(faces_[axis].end(), own_faces[axis].begin(), own_faces[axis].end());
}

void CutGeometry::update_nodes(const Grid& grid) {
  for (const std::ptrdiff_t c : cells_) {
    for (int corner = 0; corner < 8; ++corner) {
      const std::ptrdiff_t n = c + (corner & 1) + (corner & 2 ? grid.sy : 0) + (corner & 4 ? grid.sz : 0);
      if (listed_[n]) continue;
      listed_[n] = 1;
      nodes_.push_back(n);
    }
  }
  for (const std::ptrdiff_t n : nodes_) {
    listed_[n] = 0;
    double sum = 0;
    int number = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const std::ptrdiff_t c = n - (corner & 1) - (corner & 2 ? grid.sy : 0) - (corner & 4 ? grid.sz : 0);
      const double full = grid.cell_volume[c];
      const bool inside = full > 0;
      sum += inside ? volume[c] / full : 0.0;
      number += inside;
    }
    node_fraction[n] = sum / number;
  }
}

}  // namespace polynya::fluid
