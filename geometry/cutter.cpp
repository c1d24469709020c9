#include <algorithm>
#include <utility>

#include "core/compute/parallel.hpp"
#include "geometry/columns.hpp"
#include "geometry/cut_cells.hpp"
#include "geometry/cutter_workspace.hpp"
#include "geometry/face_excess.hpp"

namespace polynya::geometry {
namespace {

constexpr std::size_t triangle_chunk = 512;
constexpr std::size_t column_chunk = 64;

/// Gives every chunk its places, sorted by k; within one k in the order of the columns, so the result is sorted by
/// index. Returns the number of places.
std::size_t assign_places(std::vector<ColumnChunk>& chunks, std::size_t levels, Rows& (*rows_of)(ColumnChunk&)) {
  std::int64_t place = 0;
  for (std::size_t k = 0; k < levels; ++k)
    for (ColumnChunk& chunk : chunks) {
      std::int64_t& next = rows_of(chunk).next[k];
      place += std::exchange(next, place);
    }
  return static_cast<std::size_t>(place);
}

void scatter_cells(const GridLines& grid, Rows& rows, CutCells& out) {
  const std::size_t bodies = out.bodies;
  rows.position.resize(rows.size());
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const Place& place = rows.place[r];
    const double* values = rows.values.data() + r * bodies * cell_stride;
    rows.position[r] = rows.next[static_cast<std::size_t>(place.k)];
    for (std::int32_t k = place.k; k < place.k + place.count; ++k) {
      const auto at = static_cast<std::size_t>(rows.next[static_cast<std::size_t>(k)]++);
      const double volume = grid.width(0, place.i) * grid.width(1, place.j) * grid.width(2, k);
      double total = 0;
      for (std::size_t b = 0; b < bodies; ++b) {
        const double* value = values + b * cell_stride;
        total += value[0];
        out.body_volume[at * bodies + b] = value[0] * volume;
        for (std::size_t d = 0; d < 3; ++d) {
          out.wall_area[(at * bodies + b) * 3 + d] = -value[1 + d];
          out.wall_velocity[(at * bodies + b) * 3 + d] = value[4 + d];
        }
      }
      out.cell[at] = grid.cell_index(place.i, place.j, k);
      out.solid_volume[at] = std::clamp(total, 0.0, 1.0) * volume;
      out.debris_volume[at] = 0;
    }
  }
}

void scatter_faces(Rows& rows, std::int64_t count_x, std::int64_t count_y, std::size_t bodies, CutFaces& out) {
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const Place& place = rows.place[r];
    const double* values = rows.values.data() + r * bodies;
    double total = 0;
    for (std::size_t b = 0; b < bodies; ++b) total += values[b];
    for (std::int32_t k = place.k; k < place.k + place.count; ++k) {
      const auto at = static_cast<std::size_t>(rows.next[static_cast<std::size_t>(k)]++);
      for (std::size_t b = 0; b < bodies; ++b) out.body_solid[at * bodies + b] = values[b];
      out.face[at] = place.i + count_x * (place.j + count_y * k);
      out.solid[at] = std::clamp(total, 0.0, 1.0);
    }
  }
}

void scatter_pieces(const ColumnRecords& records, std::int32_t body, const Rows& cells, std::size_t begin,
                    std::size_t end, WallPiece*& next) {
  for (auto r = static_cast<std::size_t>(records.start[begin]); r < static_cast<std::size_t>(records.start[end]); ++r) {
    if (records.row[r] < 0) continue;
    const PieceRecord& piece = *records.record[r];
    *next++ = {body, piece.triangle, cells.position[static_cast<std::size_t>(records.row[r])], piece.area,
               piece.weights};
  }
}

void resize(CutCells& out, std::size_t entries, std::size_t pieces) {
  out.cell.resize(entries);
  out.solid_volume.resize(entries);
  out.debris_volume.resize(entries);
  out.body_volume.resize(entries * out.bodies);
  out.wall_area.resize(entries * out.bodies * 3);
  out.wall_velocity.resize(entries * out.bodies * 3);
  out.pieces.resize(pieces);
}

void resize(CutFaces& out, std::size_t faces, std::size_t bodies) {
  out.face.resize(faces);
  out.solid.resize(faces);
  out.body_solid.resize(faces * bodies);
}

}  // namespace

Cutter::Cutter(GridLines grid) : workspace_(std::make_unique<Workspace>()) {
  check_grid(grid);
  for (std::size_t axis = 0; axis < 3; ++axis) workspace_->locators[axis] = LineLocator(grid.lines[axis]);
  workspace_->grid = std::move(grid);
}
Cutter::~Cutter() = default;
Cutter::Cutter(Cutter&&) noexcept = default;
Cutter& Cutter::operator=(Cutter&&) noexcept = default;

const GridLines& Cutter::grid() const {
  return workspace_->grid;
}

void Cutter::cut(std::span<const BodySurface> bodies, CutCells& out) {
  Workspace& work = *workspace_;
  out.bodies = bodies.size();
  out.overlapping_cells = out.corrected_faces = out.loose_edges = 0;
  out.squeezed_volume = 0;
  work.surfaces.resize(bodies.size());
  work.pieces.resize(bodies.size());
  work.records.resize(bodies.size());
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    work.surfaces[b].place(bodies[b], work.locators);
    out.loose_edges += work.surfaces[b].loose_edges();
    work.clip(b, bodies[b]);
  }
  work.sum(bodies);
  work.collect(out);
  correct_excess(work.grid, work.excesses, out);
}

void Cutter::Workspace::clip(std::size_t body, const BodySurface& surface) {
  const std::vector<Corner>& corners = surfaces[body].corners();
  const std::size_t triangles = surface.triangles.size() / 3;
  pieces[body].resize((triangles + triangle_chunk - 1) / triangle_chunk);
  compute::for_chunks(triangles, triangle_chunk, [&](std::size_t begin, std::size_t end) {
    std::vector<PieceRecord>& mine = pieces[body][begin / triangle_chunk];
    mine.clear();
    TriangleClipper clipper(locators, mine);
    for (std::size_t t = begin; t < end; ++t) {
      const auto corner = [&](std::size_t c) -> const Corner& {
        return corners[static_cast<std::size_t>(surface.triangles[3 * t + c])];
      };
      clipper.cut(static_cast<std::int32_t>(t), corner(0), corner(1), corner(2));
    }
  });
  records[body].sort(pieces[body], columns(), static_cast<std::int32_t>(grid.cells(0)) + 1);
}

void Cutter::Workspace::sum(std::span<const BodySurface> bodies) {
  chunks.resize((columns() + column_chunk - 1) / column_chunk);
  compute::for_chunks(columns(), column_chunk, [&](std::size_t begin, std::size_t end) {
    sum_columns(grid, bodies, records, begin, end, chunks[begin / column_chunk]);
  });
}

void Cutter::Workspace::collect(CutCells& out) {
  const auto levels = static_cast<std::size_t>(grid.cells(2)) + 1;
  const std::size_t entries = assign_places(chunks, levels, [](ColumnChunk& c) -> Rows& { return c.cells; });
  const std::array<std::size_t, 3> faces{
      assign_places(chunks, levels, [](ColumnChunk& c) -> Rows& { return c.faces[0]; }),
      assign_places(chunks, levels, [](ColumnChunk& c) -> Rows& { return c.faces[1]; }),
      assign_places(chunks, levels, [](ColumnChunk& c) -> Rows& { return c.faces[2]; })};
  piece_start.assign(1, 0);
  excesses.clear();
  for (const ColumnChunk& chunk : chunks) {
    piece_start.push_back(piece_start.back() + chunk.pieces);
    excesses.insert(excesses.end(), chunk.excesses.begin(), chunk.excesses.end());
    out.overlapping_cells += chunk.overlapping_cells;
  }
  resize(out, entries, piece_start.back());
  for (std::size_t axis = 0; axis < 3; ++axis) resize(out.faces[axis], faces[axis], out.bodies);
  compute::for_chunks(columns(), column_chunk, [&](std::size_t begin, std::size_t end) {
    const std::size_t c = begin / column_chunk;
    scatter_cells(grid, chunks[c].cells, out);
    for (std::size_t axis = 0; axis < 3; ++axis)
      scatter_faces(chunks[c].faces[axis], grid.cells(0) + (axis == 0), grid.cells(1) + (axis == 1), out.bodies,
                    out.faces[axis]);
    WallPiece* piece = out.pieces.data() + piece_start[c];
    for (std::size_t b = 0; b < out.bodies; ++b)
      scatter_pieces(records[b], static_cast<std::int32_t>(b), chunks[c].cells, begin, end, piece);
  });
}

void Cutter::deposit_debris(std::span<const double> positions, std::span<const double> volumes, CutCells& out,
                            double least_free) {
  workspace_->debris.deposit(workspace_->grid, workspace_->locators, positions, volumes, least_free, out);
}

}  // namespace polynya::geometry
