#pragma once
#include <array>
#include <vector>

#include "core/compute/state_archive.hpp"
#include "fluid_solver/grid.hpp"
#include "fluid_solver/overlap.hpp"

namespace polynya::fluid {

enum class Boundary { wall, non_reflecting };  ///< wall: closed, also a plane of symmetry

/// A cell that holds solid, in grid terms.
struct WallPiece {
  std::ptrdiff_t cell = 0;
  double debris = 0;                                ///< displaced by particles, m^3
  std::array<std::array<double, 3>, 2> area{};      ///< per body, into the body, m^2
  std::array<std::array<double, 3>, 2> velocity{};  ///< m/s
  double size = 0;                                  ///< m^2 of both bodies' wall, whichever way it faces
  std::array<double, 2> sweep{};                    ///< volume given way per time, m^3/s
};

/// A wall in a cell that holds no fluid, as where it lies in a plane of faces but for rounding.
struct DryWall {
  std::ptrdiff_t cell = 0;
  std::ptrdiff_t wet = 0;  ///< the neighbour that the wall faces, whose fluid presses on it
};

/// What the solids leave to the fluid at one time: free volume of cells, open fraction of faces, and the free fraction
/// around nodes. Only entries touched by solid differ from the empty grid, and only those are rewritten by `set`.
struct CutGeometry {
  std::vector<double> volume;               ///< free volume, m^3; ghosts 0
  std::array<std::vector<double>, 3> open;  ///< open fraction of lower faces; closed boundaries and ghosts 0
  std::vector<double> node_fraction;        ///< mean free fraction of the cells around a node ("beta")
  std::vector<WallPiece> walls;             ///< sorted by cell
  std::vector<DryWall> dry_walls;           ///< sorted by cell
  long clamped_debris = 0;                  ///< cells whose debris did not fit

  CutGeometry(const Grid& grid, const std::array<Boundary, 6>& boundary);
  /// Corners of the cells that hold solid, each once.
  const std::vector<std::ptrdiff_t>& nodes() const { return nodes_; }
  /// The cell whose fluid presses on a dry wall in this cell; the cell itself where there is none.
  std::ptrdiff_t pressing_on(std::ptrdiff_t cell) const;
  /// The piece of wall in a cell; null where there is none.
  const WallPiece* wall_in(std::ptrdiff_t cell) const;
  /// Throws std::invalid_argument naming the first entry that is out of range or not a number.
  void set(const Grid& grid, const std::array<Boundary, 6>& boundary, const Overlap& overlap);
  /// Takes the open faces and the walls of `later` and keeps the volumes: the limit from the right at an instant when
  /// walls that lie in planes of faces begin to leave them.
  void open_like(const CutGeometry& later);

  POLYNYA_STATE_WITHOUT((listed_), volume, open, node_fraction, walls, dry_walls, clamped_debris, cells_, nodes_,
                        listed_, faces_)

 private:
  struct Touched {
    std::ptrdiff_t index;
    double empty;  ///< open fraction in the empty grid
  };
  void restore(const Grid& grid);
  void find_dry_walls(const Grid& grid);
  void update_nodes(const Grid& grid);
  std::vector<std::ptrdiff_t> cells_, nodes_;
  std::vector<char> listed_;  ///< scratch by node, 0 between calls
  std::array<std::vector<Touched>, 3> faces_;
};

/// Open fraction of a face without solids: 1 inside and at open boundaries, 0 at walls and outside.
double empty_open_fraction(const Grid& grid, const std::array<Boundary, 6>& boundary, int axis, std::ptrdiff_t face);

/// A free volume below this fraction of its cell holds no fluid.
inline constexpr double void_fraction = 1e-8;

}  // namespace polynya::fluid
