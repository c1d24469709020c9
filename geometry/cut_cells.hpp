#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/compute/state_archive.hpp"
#include "geometry/error.hpp"
#include "geometry/grid_lines.hpp"

namespace polynya::geometry {

/// The wetted surface of one body: triangles oriented outward. The surface is closed, or open only along walls of the
/// grid (planes of symmetry, sides of the ice). Vertices of open edges, and of triangles that face a wall, are taken to
/// lie on the wall when they are within half a cell of it: no film of fluid opens beside a side that shrinks a little.
struct BodySurface {
  std::span<const double> positions;        ///< [vertices][3], m
  std::span<const double> velocities;       ///< [vertices][3], m/s
  std::span<const std::int32_t> triangles;  ///< [triangles][3], vertices; vertices in no triangle are ignored
};

/// The part of one triangle in one cell. A caller turns pressures into forces on vertices: the force on the body is
/// -p(centroid) * area, given to the triangle's vertices by `weights`; summed over the pieces of a cell and body this
/// is p * wall_area exactly when p is uniform, and exact when p is linear.
struct WallPiece {
  std::int32_t body;
  std::int32_t triangle;
  std::int64_t entry;             ///< position in CutCells::cell
  std::array<double, 3> area;     ///< m^2, outward of the body
  std::array<double, 3> weights;  ///< barycentric coordinates of the centroid of the piece
  double height;                  ///< m, of the centroid above the centre of the cell
};

/// Solid fractions of the faces normal to one axis. Faces that are not listed are free of solid.
struct CutFaces {
  std::vector<std::int64_t> face;  ///< sorted; x: i + (nx+1)*(j + ny*k), y: i + nx*(j + (ny+1)*k), z: i + nx*(j + ny*k)
  std::vector<double> solid;       ///< [faces], fraction covered by the union of the bodies, 0..1

  POLYNYA_STATE(face, solid)
};

/// A body's volume in a cell whose bound of rounding is too large to be trusted.
struct UncertainVolume {
  std::int64_t entry;  ///< position in CutCells::cell
  std::int32_t body;
};

/// What solids take from a grid. One entry per cell that contains solid, wall or debris, sorted by cell.
struct CutCells {
  std::size_t bodies = 0;
  std::vector<std::int64_t> cell;     ///< i + nx*(j + ny*k)
  std::vector<double> solid_volume;   ///< [entries], m^3, union of the bodies, <= volume of the cell
  std::vector<double> debris_volume;  ///< [entries], m^3, displaced by particles, not part of solid_volume
  std::vector<double> body_volume;    ///< [entries][bodies], m^3
  std::vector<double> wall_area;  ///< [entries][bodies][3], m^2, INTO the body; summed over the bodies it equals the
                                  ///< sum over the cell's faces of solid fraction * outward face vector
  std::vector<double> wall_velocity;  ///< [entries][bodies][3], m/s, mean over the wall in the cell; 0 without wall
  /// [entries][bodies], m^3/s, volume the wall gives way per time: the integral of velocity over area INTO the body.
  /// The product of area and mean velocity misses it where parts of the wall move apart, as cracks that open do.
  std::vector<double> wall_sweep;
  std::vector<std::uint8_t> walled;  ///< [entries], 1: `pieces` has pieces of the entry
  std::array<CutFaces, 3> faces;     ///< normal to x, y, z
  std::vector<WallPiece> pieces;     ///< sum of area per entry and body = -wall_area; mostly in the order of triangles

  std::vector<UncertainVolume> uncertain;  ///< by cell; see recut_uncertain (exact_cut.hpp)

  std::int64_t shared_cells = 0;    ///< cells that hold two bodies
  std::int64_t united_cells = 0;    ///< of them, those where a body's surface lies in another body and is not wetted
  std::int64_t united_exactly = 0;  ///< cells where this was found by exact numbers
  std::int64_t doubted_unions = 0;  ///< cells where it is not certain: three bodies, loose edges, or no exact numbers
  std::int64_t overlapping_cells = 0;  ///< cells whose solid volume exceeded the cell and was clamped
  std::int64_t corrected_faces = 0;    ///< faces whose fraction left [0, 1] (overlap, folded surface) and was clamped
  std::int64_t loose_edges = 0;        ///< open edges of the surfaces away from the walls of the grid: should be 0
  std::int64_t kept_triangles = 0;     ///< that lay where they lay at the cut before: not clipped again
  double squeezed_volume = 0;          ///< m^3 of debris that found no room

  POLYNYA_STATE(bodies, cell, solid_volume, debris_volume, body_volume, wall_area, wall_velocity, wall_sweep, walled,
                faces, pieces, uncertain, shared_cells, united_cells, united_exactly, doubted_unions, overlapping_cells,
                corrected_faces, loose_edges, kept_triangles, squeezed_volume)
};

template <class Number>
struct BasicCorner;
struct PieceRecord;

/// Clips the triangles [begin, end) of a placed surface by the planes of the grid and appends what they leave in cells.
using ClipTriangles = void (*)(const std::array<LineLocator, 3>& lines, std::span<const BasicCorner<double>> corners,
                               std::span<const std::int32_t> triangles, std::size_t begin, std::size_t end,
                               std::vector<PieceRecord>& records);

struct JointCell;
struct JointTriangle;
struct JointSum;

/// Adds what of a piece of surface lies below triangles of another body (joint_pieces.hpp). False if it is not certain.
using AddBelow = bool (*)(const JointCell& cell, const JointTriangle& piece, std::span<const JointTriangle> others,
                          JointSum& sum);

/// Cuts a grid by bodies, column by column: a point is solid when more surface leaves the body than enters it on the
/// upward ray, so volumes, areas and fractions are sums of exact integrals over clipped triangles, and no point is ever
/// classified. Exact up to rounding, of which every volume has a bound; deterministic for any number of threads;
/// buffers are kept between cuts. A chunk of triangles that lie
/// where they lay is not clipped again.
///
/// Coincidence: vertices within 1e-12 of a cell from a grid plane count as lying on it, and then on the side the
/// surface faces, so the wall of a grid-aligned body lies in the fluid cell beside it and the face between them is
/// solid. On a wall of the grid (within 1e-9 of a cell) they count as outside: surface lying on the walls is never
/// wetted.
class Cutter {
 public:
  explicit Cutter(const GridLines& grid);
  ~Cutter();
  Cutter(Cutter&&) noexcept;
  Cutter& operator=(Cutter&&) noexcept;

  const GridLines& grid() const;
  /// Cuts this grid from now on. Throws GeometryError as at construction.
  void set_lines(const GridLines& grid);

  /// Clips by another method from now on than by doubles (exact_cut.hpp has one).
  void set_method(ClipTriangles method);

  /// Decides by `exact` (exact_cut.hpp) where surfaces of two bodies lie in one another, if doubles cannot, or always.
  void set_exact_union(AddBelow exact, bool always = false);

  /// Cuts by all bodies; `out` is overwritten, its debris is zero. Throws GeometryError on bad indices or positions
  /// that are not finite.
  void cut(std::span<const BodySurface> bodies, CutCells& out);

  /// Deposits particles as cubes of their volume (positions [n][3] m, volumes [n] m^3) into the cells by exact overlap
  /// with the grid. A cell keeps at least `least_free` of what the solids leave; the excess moves to neighbours with
  /// room, and what finds none is counted in squeezed_volume. Particles with their centre outside the grid
  /// are left out; cubes that stick out of it are moved inside.
  void deposit_debris(std::span<const double> positions, std::span<const double> volumes, CutCells& out,
                      double least_free = 0.1);

 private:
  struct Workspace;
  std::unique_ptr<Workspace> workspace_;
};

/// Forces of the fluid on one body.
struct WallForces {
  std::vector<double> on_vertices;  ///< [vertices][3], N
  double without_gradient = 0;      ///< N, the vertical force that the pressures at the centres of the cells alone give
  double area_z = 0;                ///< m^2, vertical component of the area vector into the body
};

/// Forces on all bodies from the pressures of the cells: p(z) = pressure[entry] - gradient_z[entry] * (z - centre of
/// the cell). `bodies` are those that made the cut.
std::vector<WallForces> pressure_forces(const CutCells& cut, std::span<const BodySurface> bodies,
                                        std::span<const double> pressure, std::span<const double> gradient_z);

}  // namespace polynya::geometry
