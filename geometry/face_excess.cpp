#include "geometry/face_excess.hpp"

#include <algorithm>
#include <cmath>

namespace polynya::geometry {
namespace {

/// Area vector that is taken from the wall of one cell.
struct Correction {
  std::int64_t entry;
  std::array<double, 3> area;
  std::ptrdiff_t piece = -1;  ///< largest piece of the body with most wall
};

double square(const std::array<double, 3>& v) {
  return v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
}

void note(const GridLines& grid, const CutCells& out, const FaceExcess& at, int side,
          std::vector<Correction>& corrections) {
  std::array<std::int64_t, 3> p{at.i, at.j, at.k};
  const auto axis = static_cast<std::size_t>(at.axis);
  p[axis] -= side;
  if (p[axis] < 0 || p[axis] >= grid.cells(at.axis)) return;
  const std::int64_t cell = grid.cell_index(p[0], p[1], p[2]);
  const auto found = std::ranges::lower_bound(out.cell, cell);
  if (found == out.cell.end() || *found != cell) return;
  Correction correction{found - out.cell.begin(), {0, 0, 0}};
  correction.area[axis] = side == 1 ? at.area : -at.area;  // the face is the upper one of the cell below it
  corrections.push_back(correction);
}

void merge(std::vector<Correction>& corrections) {
  std::ranges::stable_sort(corrections, {}, &Correction::entry);
  std::size_t count = 0;
  for (const Correction& c : corrections) {
    if (count > 0 && corrections[count - 1].entry == c.entry)
      for (std::size_t d = 0; d < 3; ++d) corrections[count - 1].area[d] += c.area[d];
    else
      corrections[count++] = c;
  }
  corrections.resize(count);
}

void find_pieces(const CutCells& out, std::vector<Correction>& corrections) {
  std::vector<std::ptrdiff_t> correction_of(out.cell.size(), -1);
  for (std::size_t c = 0; c < corrections.size(); ++c)
    correction_of[static_cast<std::size_t>(corrections[c].entry)] = static_cast<std::ptrdiff_t>(c);
  for (std::size_t p = 0; p < out.pieces.size(); ++p) {
    const std::ptrdiff_t c = correction_of[static_cast<std::size_t>(out.pieces[p].entry)];
    if (c < 0) continue;
    std::ptrdiff_t& best = corrections[static_cast<std::size_t>(c)].piece;
    if (best < 0 || square(out.pieces[p].area) > square(out.pieces[static_cast<std::size_t>(best)].area))
      best = static_cast<std::ptrdiff_t>(p);
  }
}

}  // namespace

void correct_excess(const GridLines& grid, const std::vector<FaceExcess>& excesses, CutCells& out) {
  out.corrected_faces = static_cast<std::int64_t>(excesses.size());
  if (excesses.empty()) return;
  std::vector<Correction> corrections;
  for (const FaceExcess& excess : excesses)
    for (int side : {0, 1}) note(grid, out, excess, side, corrections);
  merge(corrections);
  find_pieces(out, corrections);
  for (const Correction& c : corrections) {
    if (c.piece < 0) continue;  // no wall: the excess is the same on opposite faces and cancels
    WallPiece extra = out.pieces[static_cast<std::size_t>(c.piece)];
    extra.area = c.area;
    out.pieces.push_back(extra);
    const std::size_t at = static_cast<std::size_t>(c.entry) * out.bodies + static_cast<std::size_t>(extra.body);
    for (std::size_t d = 0; d < 3; ++d) {
      out.wall_area[3 * at + d] -= c.area[d];
      out.wall_sweep[at] -= c.area[d] * out.wall_velocity[3 * at + d];
    }
  }
}

}  // namespace polynya::geometry
