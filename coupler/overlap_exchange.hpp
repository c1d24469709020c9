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
  OverlapExchange(const FluidSide& fluid, bool debris_displaces_fluid, double atmospheric_pressure);

  /// Cuts the grid by the solids where they are now and remembers the cut before. The watch's headings "overlap" and
  /// "debris_displacement" take the time.
  const geometry::CutCells& cut(const Conversation& conversation, compute::Stopwatch& watch);

  /// Adds the impulses of a span of length `span` (s) to the solids' outstanding fluid impulses and to the ledger.
  /// `at_start` belongs to the cut before, `at_end` to the last one. Surfaces may have lost vertices in between.
  void give_impulses(Conversation& conversation, const WallPressure& at_start, const WallPressure& at_end, double span,
                     Ledger& ledger) const;

  /// Remembers with the solids the forces of the fluid's pressure at time 0, which belongs to the last cut.
  void set_start_forces(Conversation& conversation, const WallPressure& pressure) const;

  /// Adds impulses that the fluid gave to walls other than by pressure, [entries of the last cut][2][3] N s. They spread
  /// over the cell's pieces of wall by area.
  void give_wall_impulses(Conversation& conversation, std::span<const double> impulse, Ledger& ledger) const;

  /// Spreads the fluid's impedance at each cell's wall ([entries of the last cut], kg/(m^2 s)) over the vertices.
  void set_impedance(Conversation& conversation, std::span<const double> impedance) const;

  const geometry::CutCells& before() const { return before_.cells; }
  const geometry::CutCells& now() const { return now_.cells; }

  /// Recuts a seeded sample of cells by CGAL's exact kernel. Returns the largest difference relative to the cell's
  /// volume.
  double verify_sample(std::uint64_t seed, std::size_t count) const;

 private:
  /// A cut with the surfaces that made it.
  struct Cut {
    geometry::CutCells cells;
    struct Surface {
      Body body;
      std::vector<std::int64_t> ids;
      std::vector<double> positions, velocities;
      std::vector<std::int32_t> triangles;
      geometry::BodySurface view() const { return {positions, velocities, triangles}; }
    };
    std::vector<Surface> surfaces;
    std::vector<geometry::BodySurface> views() const;
  };
  void give(SolidSide& side, const Cut& cut, std::int32_t index, const WallPressure& pressure, double factor,
            Ledger& ledger) const;

  geometry::Cutter cutter_;
  bool debris_displaces_fluid_;
  double atmospheric_pressure_;  ///< Pa
  Cut before_, now_;
};

}  // namespace polynya::coupler
