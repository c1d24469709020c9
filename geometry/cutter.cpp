#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "core/compute/parallel.hpp"
#include "geometry/columns.hpp"
#include "geometry/cut_cells.hpp"
#include "geometry/cutter_workspace.hpp"
#include "geometry/face_excess.hpp"

namespace polynya::geometry {
namespace {

/// Gives every chunk its places, sorted by k; within one k in the order of the columns, so the result is sorted by
/// index. Returns the number of places.
std::size_t assign_places(std::vector<ColumnChunk>& chunks, std::size_t levels, Rows& (*rows_of)(ColumnChunk&)) {
  std::int64_t place = 0;
  for (std::size_t k = 0; k < levels; ++k)
    for (ColumnChunk& chunk : chunks) {
      Rows& rows = rows_of(chunk);
      rows.first[k] = place;
      place += rows.start[k + 1] - rows.start[k];
    }
  return static_cast<std::size_t>(place);
}

void scatter_cells(const GridLines& grid, Rows& rows, CutCells& out) {
  const std::size_t bodies = out.bodies;
  rows.position.resize(rows.size());
  for (std::size_t level = 0; level + 1 < rows.start.size(); ++level) {
    const auto k = static_cast<std::int64_t>(level);
    auto at = static_cast<std::size_t>(rows.first[level]);
    for (std::int32_t n = rows.start[level]; n < rows.start[level + 1]; ++n, ++at) {
      const auto r = static_cast<std::size_t>(rows.order[static_cast<std::size_t>(n)]);
      const Place& place = rows.place[r];
      const double* values = rows.values.data() + r * bodies * cell_stride;
      const double volume = grid.width(0, place.i) * grid.width(1, place.j) * grid.width(2, k);
      for (std::size_t b = 0; b < bodies; ++b) {
        const double* value = values + b * cell_stride;
        out.body_volume[at * bodies + b] = value[0] * volume;
        out.wall_sweep[at * bodies + b] = -value[7];
        for (std::size_t d = 0; d < 3; ++d) {
          out.wall_area[(at * bodies + b) * 3 + d] = -value[1 + d];
          out.wall_velocity[(at * bodies + b) * 3 + d] = value[4 + d];
        }
      }
      out.cell[at] = grid.cell_index(place.i, place.j, k);
      out.solid_volume[at] = std::clamp(rows.total[r], 0.0, 1.0) * volume;
      out.debris_volume[at] = 0;
      out.walled[at] = rows.walled[r];
      if (place.k == k) rows.position[r] = static_cast<std::int64_t>(at);
    }
  }
}

void scatter_faces(const Rows& rows, std::int64_t count_x, std::int64_t count_y, CutFaces& out) {
  for (std::size_t level = 0; level + 1 < rows.start.size(); ++level) {
    const auto k = static_cast<std::int64_t>(level);
    auto at = static_cast<std::size_t>(rows.first[level]);
    for (std::int32_t n = rows.start[level]; n < rows.start[level + 1]; ++n, ++at) {
      const auto r = static_cast<std::size_t>(rows.order[static_cast<std::size_t>(n)]);
      out.face[at] = rows.place[r].i + count_x * (rows.place[r].j + count_y * k);
      out.solid[at] = rows.values[r];
    }
  }
}

/// Of the centroid of a piece above the centre of its cell, m.
double height(const GridLines& grid, const BodySurface& surface, const PieceRecord& piece) {
  const auto k = static_cast<std::size_t>(piece.k);
  double height = -0.5 * (grid.lines[2][k] + grid.lines[2][k + 1]);
  for (std::size_t c = 0; c < 3; ++c) {
    const std::int32_t vertex = surface.triangles[3 * static_cast<std::size_t>(piece.triangle) + c];
    height += piece.weights[c] * surface.positions[3 * static_cast<std::size_t>(vertex) + 2];
  }
  return height;
}

/// Tells the records where their cells went, or which part is left of them.
void note_entries(ColumnChunk& chunk) {
  for (std::size_t r = 0; r < chunk.entry.size(); ++r)
    *chunk.entry[r] = chunk.row[r] < 0 ? -1 : chunk.cells.position[static_cast<std::size_t>(chunk.row[r])];
  for (std::size_t p = 0; p < chunk.parts.size(); ++p) {
    std::int64_t& entry = *chunk.entry[static_cast<std::size_t>(chunk.parts[p].record)];
    chunk.parts[p].entry = entry;
    if (entry >= 0) entry = -2 - static_cast<std::int64_t>(chunk.first_part + p);
  }
}

/// Whether the boxes along the axes around any two bodies touch: elsewhere neither has surface in the other.
bool boxes_meet(const std::vector<PlacedSurface>& surfaces) {
  std::vector<std::array<double, 6>> boxes;
  for (const PlacedSurface& surface : surfaces) {
    std::array<double, 6> box;
    for (std::size_t d = 0; d < 3; ++d) {
      box[d] = std::numeric_limits<double>::infinity(), box[3 + d] = -box[d];
      for (const Corner& c : surface.corners())
        box[d] = std::min(box[d], c.x[d]), box[3 + d] = std::max(box[3 + d], c.x[d]);
    }
    for (const std::array<double, 6>& other : boxes) {
      bool meet = true;
      for (std::size_t d = 0; d < 3; ++d) {
        const double near = 1e-9 * (std::abs(box[d]) + std::abs(box[3 + d]));
        meet = meet && box[d] <= other[3 + d] + near && other[d] <= box[3 + d] + near;
      }
      if (meet) return true;
    }
    boxes.push_back(box);
  }
  return false;
}

void resize(CutCells& out, std::size_t entries) {
  out.cell.resize(entries);
  out.solid_volume.resize(entries);
  out.debris_volume.resize(entries);
  out.body_volume.resize(entries * out.bodies);
  out.wall_area.resize(entries * out.bodies * 3);
  out.wall_velocity.resize(entries * out.bodies * 3);
  out.wall_sweep.resize(entries * out.bodies);
  out.walled.resize(entries);
}

void resize(CutFaces& out, std::size_t faces) {
  out.face.resize(faces);
  out.solid.resize(faces);
}

}  // namespace

Cutter::Cutter(const GridLines& grid) : workspace_(std::make_unique<Workspace>()) {
  set_lines(grid);
}
Cutter::~Cutter() = default;
Cutter::Cutter(Cutter&&) noexcept = default;
Cutter& Cutter::operator=(Cutter&&) noexcept = default;

const GridLines& Cutter::grid() const {
  return workspace_->grid;
}

void Cutter::set_lines(const GridLines& grid) {
  check_grid(grid);
  for (std::size_t axis = 0; axis < 3; ++axis) workspace_->locators[axis] = LineLocator(grid.lines[axis]);
  workspace_->grid = grid;
  workspace_->complete = false;
}

void Cutter::set_method(ClipTriangles method) {
  workspace_->method = method;
  workspace_->complete = false;
}

void Cutter::set_exact_union(AddBelow exact, bool always) {
  workspace_->union_method.exact = exact;
  workspace_->union_method.always_exact = always;
}

void Cutter::cut(std::span<const BodySurface> bodies, CutCells& out) {
  Workspace& work = *workspace_;
  out.bodies = bodies.size();
  out.shared_cells = out.overlapping_cells = out.corrected_faces = out.loose_edges = out.kept_triangles = 0;
  out.united_cells = out.united_exactly = out.doubted_unions = 0;
  out.squeezed_volume = 0;
  if (!std::exchange(work.complete, false))
    for (PlacedSurface& surface : work.surfaces) surface.forget();
  work.surfaces.resize(bodies.size());
  work.reach.resize(bodies.size());
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    work.surfaces[b].place(bodies[b], work.locators);
    out.loose_edges += work.surfaces[b].loose_edges();
    work.reach[b] = work.surfaces[b].reach(work.locators);
  }
  out.kept_triangles = work.clip(bodies);
  work.complete = true;
  work.prepare_union(bodies);
  work.sum(bodies);
  work.collect(out);
  work.collect_uncertain(out);
  work.collect_pieces(bodies, out);
  correct_excess(work.grid, work.excesses, out);
}

std::int64_t Cutter::Workspace::clip(std::span<const BodySurface> bodies) {
  clipped.resize(bodies.size());
  clips.clear();
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    clipped[b].resize((bodies[b].triangles.size() / 3 + triangle_chunk - 1) / triangle_chunk);
    for (std::size_t c = 0; c < clipped[b].size(); ++c) clips.push_back({b, c});
  }
  std::vector<std::int64_t> kept(clips.size(), 0);
  compute::for_uneven_chunks(clips.size(), 1, [&](std::size_t at, std::size_t) {
    const auto [b, c] = clips[at];
    const std::size_t begin = c * triangle_chunk,
                      end = std::min(bodies[b].triangles.size() / 3, begin + triangle_chunk);
    if (surfaces[b].unmoved(begin, end))
      kept[at] = static_cast<std::int64_t>(end - begin);
    else
      clipped[b][c].clip(method, locators, surfaces[b].corners(), bodies[b].triangles, begin, end);
  });
  return std::accumulate(kept.begin(), kept.end(), std::int64_t{0});
}

void Cutter::Workspace::prepare_union(std::span<const BodySurface> bodies) {
  union_bodies.clear();
  shifts.resize(bodies.size());
  if (boxes_meet(surfaces))
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      shifts[b] = joint_shifts(grid, locators, bodies[b], surfaces[b].corners(), b);
      union_bodies.push_back({surfaces[b].corners(), shifts[b]});
    }
  union_method.bodies = union_bodies;
}

void Cutter::Workspace::sum(std::span<const BodySurface> bodies) {
  chunks.resize((columns() + column_chunk - 1) / column_chunk);
  compute::for_uneven_chunks(columns(), column_chunk, [&](std::size_t begin, std::size_t) {
    gather_columns(grid, clipped, begin, chunks[begin / column_chunk]);
  });
  compute::for_uneven_chunks(columns(), column_chunk, [&](std::size_t begin, std::size_t end) {
    sum_columns(grid, bodies, reach, union_method, begin, end, chunks);
  });
}

void Cutter::Workspace::collect(CutCells& out) {
  const auto levels = static_cast<std::size_t>(grid.cells(2)) + 1;
  const std::size_t entries = assign_places(chunks, levels, [](ColumnChunk& c) -> Rows& { return c.cells; });
  const std::array<std::size_t, 3> faces{
      assign_places(chunks, levels, [](ColumnChunk& c) -> Rows& { return c.faces[0]; }),
      assign_places(chunks, levels, [](ColumnChunk& c) -> Rows& { return c.faces[1]; }),
      assign_places(chunks, levels, [](ColumnChunk& c) -> Rows& { return c.faces[2]; })};
  excesses.clear();
  parts.clear();
  std::size_t all_parts = 0;
  for (ColumnChunk& chunk : chunks) {
    chunk.first_part = all_parts;
    all_parts += chunk.parts.size();
    out.united_cells += chunk.united_cells;
    out.united_exactly += chunk.united_exactly;
    out.doubted_unions += chunk.doubted_unions;
    excesses.insert(excesses.end(), chunk.excesses.begin(), chunk.excesses.end());
    out.overlapping_cells += chunk.overlapping_cells;
    out.shared_cells += chunk.shared_cells;
  }
  resize(out, entries);
  for (std::size_t axis = 0; axis < 3; ++axis) resize(out.faces[axis], faces[axis]);
  compute::for_uneven_chunks(chunks.size(), 1, [&](std::size_t c, std::size_t) {
    scatter_cells(grid, chunks[c].cells, out);
    for (std::size_t axis = 0; axis < 3; ++axis)
      scatter_faces(chunks[c].faces[axis], grid.cells(0) + (axis == 0), grid.cells(1) + (axis == 1), out.faces[axis]);
    note_entries(chunks[c]);
  });
  for (const ColumnChunk& chunk : chunks) parts.insert(parts.end(), chunk.parts.begin(), chunk.parts.end());
}

void Cutter::Workspace::collect_uncertain(CutCells& out) const {
  out.uncertain.clear();
  for (const ColumnChunk& chunk : chunks)
    for (const auto& [at, body] : chunk.uncertain)
      for (std::int32_t k = at.k; k < at.k + at.count; ++k) {
        const auto found = std::ranges::lower_bound(out.cell, grid.cell_index(at.i, at.j, k));
        out.uncertain.push_back({found - out.cell.begin(), body});
      }
}

void Cutter::Workspace::collect_pieces(std::span<const BodySurface> bodies, CutCells& out) {
  piece_start.assign(1, 0);
  for (const auto& [b, c] : clips) {
    std::size_t count = 0;
    for (const ColumnChunk& chunk : chunks) count += static_cast<std::size_t>(chunk.pieces[b][c]);
    piece_start.push_back(piece_start.back() + count);
  }
  out.pieces.resize(piece_start.back());
  compute::for_uneven_chunks(clips.size(), 1, [&](std::size_t at, std::size_t) {
    const auto [b, c] = clips[at];
    WallPiece* next = out.pieces.data() + piece_start[at];
    const ClippedChunk& from = clipped[b][c];
    for (std::size_t r = 0; r < from.records.size(); ++r) {
      if (from.entry[r] == -1) continue;
      PieceRecord piece = from.records[r];
      std::int64_t entry = from.entry[r];
      if (entry < -1) {
        const PiecePart& part = parts[static_cast<std::size_t>(-2 - entry)];
        piece.area = part.area, piece.weights = part.weights;
        entry = part.entry;
      }
      *next++ = {static_cast<std::int32_t>(b),  piece.triangle, entry, piece.area, piece.weights,
                 height(grid, bodies[b], piece)};
    }
  });
}

void Cutter::deposit_debris(std::span<const double> positions, std::span<const double> volumes, CutCells& out,
                            double least_free) {
  workspace_->debris.deposit(workspace_->grid, workspace_->locators, positions, volumes, least_free, out);
}

}  // namespace polynya::geometry
