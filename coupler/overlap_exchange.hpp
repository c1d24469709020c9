#pragma once
#include <array>
#include <vector>

#include "core/compute/timer.hpp"
#include "coupler/conversation.hpp"
#include "coupler/ledger.hpp"

namespace polynya::coupler {

/// Lets the solids' surfaces cut the fluid's grid and turns the fluid's pressures into impulses on surface vertices.
///
/// Over a span the fluid sees walls that are the mean of those at its start and its end, so the impulse it gives to a
/// piece of wall is span * pressure * (area at the start + area at the end) / 2. The same two sets of pieces hand it to
/// the vertices: what the fluid gave and what the solids get agree to rounding.
class OverlapExchange {
 public:
  /// `exact`: the cut is made in exact numbers throughout.
  OverlapExchange(const FluidSide& fluid, bool debris_displaces_fluid, double atmospheric_pressure, bool exact);

  /// Cuts the grid by the solids where they are now and remembers the cut before. The watch's headings "overlap" and
  /// "debris_displacement" take the time.
  const geometry::CutCells& cut(const Conversation& conversation, compute::Stopwatch& watch);

  /// Cuts another grid of as many cells from now on: the planes have moved.
  void move_grid(const geometry::GridLines& grid) { cutter_.set_lines(grid); }

  /// What `take` needs of the last cut alone: while the fluid computes, there is time for it.
  void prepare();
  /// Cells that hold wall in the cut before and in the last one. After `prepare`.
  std::size_t walls_before() const { return before_.walls; }
  std::size_t walls() const { return now_.walls; }

  /// Remembers with the solids the forces of the fluid's pressure at time 0, which belongs to the last cut.
  void set_start_forces(Conversation& conversation, const WallPressure& pressure) const;

  /// Adds the impulses of a span of length `span` (s) to the solids' outstanding fluid impulses and to the ledger, and
  /// gives the vertices what the fluid expects of the next one: force and impedance. After `prepare`. Surfaces may have
  /// lost vertices since the cut before.
  void take(Conversation& conversation, const FluidAnswer& answer, double span, Ledger& ledger) const;

  /// Of all cuts so far.
  struct Counts {
    long cells = 0;           ///< with wall
    long exact = 0;           ///< of them, recut by exact numbers because rounding made them uncertain, or all
    long shared = 0;          ///< cells that hold both bodies
    long united = 0;          ///< of them, those where one body's surface lies in the other and is not wetted
    long united_exactly = 0;  ///< cells where that was found by exact numbers
    long doubted = 0;         ///< cells where it is not certain: a surface has loose edges
    long kept = 0;            ///< triangles that lay where they lay, and were not clipped again
    POLYNYA_STATE(cells, exact, shared, united, united_exactly, doubted, kept)
  };
  const Counts& counts() const { return counts_; }

  const geometry::CutCells& now() const { return now_.cells; }

  /// [cuts] from and to, s, on the clock of exchange::Waits.
  const std::vector<std::array<double, 2>>& times() const { return times_; }

  /// Recuts a seeded sample of cells by CGAL's exact kernel. Returns the largest difference relative to the cell's
  /// volume.
  double verify_sample(std::uint64_t seed, std::size_t count) const;

  /// Between spans, when only the last cut is looked at again.
  POLYNYA_STATE_WITHOUT((cutter_, debris_displaces_fluid_, exact_, atmospheric_pressure_, before_, times_), cutter_,
                        debris_displaces_fluid_, exact_, atmospheric_pressure_, counts_, before_, now_, times_)

 private:
  using PerBody = std::array<std::vector<double>, body_count>;  ///< by vertex of the body's surface

  /// A cut with the surfaces that made it.
  struct Cut {
    geometry::CutCells cells;
    struct Surface {
      Body body;
      std::vector<std::int64_t> ids;
      std::vector<double> positions, velocities;
      std::vector<std::int32_t> triangles;
      geometry::BodySurface view() const { return {positions, velocities, triangles}; }

      POLYNYA_STATE(body, ids, positions, velocities, triangles)
    };
    std::vector<Surface> surfaces;
    std::size_t walls = 0;              ///< cells that hold wall
    std::vector<std::int32_t> wall_of;  ///< [entries] which of them, -1: none
    std::vector<double> piece_size;     ///< [pieces] m^2
    std::vector<double> wall_size;      ///< [walls][bodies] m^2, their sum by cell
    std::vector<geometry::BodySurface> views() const;

    POLYNYA_STATE(cells, surfaces, walls, wall_of, piece_size, wall_size)
  };
  /// What the pieces of one cut hand from the fluid to the vertices of its surfaces.
  struct Given {
    PerBody impulse;                           ///< [nv][3] N s
    PerBody expected;                          ///< [nv][3] N, in the next span; empty if the fluid does not forecast
    PerBody impedance;                         ///< [nv][6] kg/s; likewise
    std::array<double, body_count> weight{};   ///< N s, part of the vertical impulse: see Ledger::fluid_weight
    std::array<double, body_count> carried{};  ///< N s, likewise: Ledger::fluid_carried
    std::array<double, body_count> area_z{};   ///< m^2, into the body
  };
  /// Pressures that acted for `time` (s), and what else an answer gives by the walls of the last cut.
  static Given spread(const Cut& cut, const WallPressureView& pressure, double time, const FluidAnswer* last);
  /// Hands it to the solids, and to the ledger.
  void book(Conversation& conversation, const Cut& cut, const Given& given, double time, Ledger& ledger) const;

  geometry::Cutter cutter_;
  bool debris_displaces_fluid_, exact_;
  double atmospheric_pressure_;  ///< Pa
  Counts counts_;
  Cut before_, now_;
  std::vector<std::array<double, 2>> times_;
};

}  // namespace polynya::coupler
