#pragma once
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

  /// What `take` needs of the last cut alone: while the fluid computes, there is time for it.
  void prepare();

  /// Remembers with the solids the forces of the fluid's pressure at time 0, which belongs to the last cut.
  void set_start_forces(Conversation& conversation, const WallPressure& pressure) const;

  /// Adds the impulses of a span of length `span` (s) to the solids' outstanding fluid impulses and to the ledger, and
  /// gives the vertices their impedance. After `prepare`. Surfaces may have lost vertices since the cut before.
  void take(Conversation& conversation, const FluidAnswer& answer, double span, Ledger& ledger) const;

  /// Of all cuts so far.
  struct Counts {
    long cells = 0;   ///< with wall
    long exact = 0;   ///< of them, recut by exact numbers because rounding made them uncertain, or all
    long shared = 0;  ///< cells that hold both bodies
    POLYNYA_STATE(cells, exact, shared)
  };
  const Counts& counts() const { return counts_; }

  const geometry::CutCells& before() const { return before_.cells; }
  const geometry::CutCells& now() const { return now_.cells; }

  /// Recuts a seeded sample of cells by CGAL's exact kernel. Returns the largest difference relative to the cell's
  /// volume.
  double verify_sample(std::uint64_t seed, std::size_t count) const;

  /// Between spans, when only the last cut is looked at again.
  POLYNYA_STATE_WITHOUT((cutter_, debris_displaces_fluid_, exact_, atmospheric_pressure_, before_), cutter_,
                        debris_displaces_fluid_, exact_, atmospheric_pressure_, counts_, before_, now_)

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
    std::vector<double> piece_size;  ///< [pieces] m^2
    std::vector<double> wall_size;   ///< [entries][bodies] m^2, their sum by cell
    std::vector<geometry::BodySurface> views() const;

    POLYNYA_STATE(cells, surfaces, piece_size, wall_size)
  };
  /// Adds the impulses of one cut's pressures, which acted for `time` (s).
  void book(Conversation& conversation, const Cut& cut, const std::vector<geometry::WallForces>& forces, double time,
            Ledger& ledger) const;
  PerBody wall_impulses(const Conversation& conversation, std::span<const double> impulse) const;
  PerBody impedances(const Conversation& conversation, std::span<const double> impedance) const;

  geometry::Cutter cutter_;
  bool debris_displaces_fluid_, exact_;
  double atmospheric_pressure_;  ///< Pa
  Counts counts_;
  Cut before_, now_;
};

}  // namespace polynya::coupler
