#pragma once
#include <array>
#include <string>
#include <vector>

#include "core/scene/body_motion.hpp"
#include "fluid_solver/fluid.hpp"
#include "geometry/cut_cells.hpp"

namespace polynya::fluid {

/// What the fluid gave to one whole body, mirror images of a model of half or a quarter included, since the start.
struct BodyImpulse {
  std::array<double, 3> linear{};   ///< N s
  std::array<double, 3> angular{};  ///< N m s, about the reference point

  POLYNYA_STATE(linear, angular)
};

/// Rigid bodies whose motion a scene prescribes: cuts the fluid's grid by their surfaces, as the coupler does in a run
/// with solids, and sums what the fluid gives to each.
class PrescribedBodies {
 public:
  /// Throws GeometryError where a body's file cannot be read.
  PrescribedBodies(const scene::Scene& scene, const Grid& grid);

  /// The cut at the fluid's time 0, walls moving as they do then.
  const Overlap& start();
  /// The cut `dt` after `time`, walls with their mean velocity in between: what a step needs. Throws GeometryError
  /// where more than two bodies overlap; two count once.
  const Overlap& advance(double time, double dt);
  /// After the step: adds what it gave to the bodies. Over the step the fluid saw the mean of the walls at both ends.
  void take(const Fluid& fluid, double dt);

  std::size_t count() const { return bodies_.size(); }
  const std::string& name(std::size_t b) const { return bodies_[b].name; }
  const scene::Body& body(std::size_t b) const { return bodies_[b].body; }
  bool moves_at_start() const;

  /// Over all cuts made: cells with wall, those cut by exact numbers, those that hold two bodies, of them those where
  /// one lies in the other, those where that was found by exact numbers, and where it is not certain.
  struct Counts {
    long cells = 0, exact = 0, shared = 0, united = 0, united_exactly = 0, doubted = 0;

    POLYNYA_STATE(cells, exact, shared, united, united_exactly, doubted)
  };
  const Counts& counts() const { return counts_; }
  const std::vector<BodyImpulse>& given() const { return given_; }

  /// The cuts are made anew from the fluid's time.
  POLYNYA_STATE_WITHOUT((bodies_, cutter_, exact_, before_, now_), bodies_, cutter_, exact_, counts_, given_, before_,
                        now_)

 private:
  struct Surface {
    std::string name;
    scene::Body body;
    std::array<bool, 2> mirrored{};             ///< in the planes normal to x and y
    std::vector<scene::Vector> points;          ///< before it moves
    std::vector<double> positions, velocities;  ///< at the last cut
    std::vector<std::int32_t> triangles;
  };
  struct Cut {
    geometry::CutCells cells;
    Overlap overlap;
    double time = -1;
    std::vector<scene::Vector> centre;  ///< by body: its reference point
    std::vector<scene::Vector> lever;   ///< by piece: from there to the middle of the piece
  };
  void cut(double time);
  void add(const Fluid& fluid, const Cut& cut, double time, bool last);
  void give(std::size_t body, const scene::Vector& impulse, const scene::Vector& lever);

  std::vector<Surface> bodies_;
  geometry::Cutter cutter_;
  bool exact_;
  Counts counts_;
  std::vector<BodyImpulse> given_;
  Cut before_, now_;
};

/// The cut of any number of bodies as the fluid takes it: the first body in the place of the vehicle, all others in
/// that of the ice. A cell's wall moves so that it gives way the volume that the bodies' walls do.
Overlap overlap_of(const geometry::CutCells& cut);

}  // namespace polynya::fluid
