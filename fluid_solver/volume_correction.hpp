#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "fluid_solver/cut_geometry.hpp"

namespace polynya::fluid {

/// Wall pieces of one step: mean area vectors, the velocity of the motion, and the volume they give way per time.
struct StepWall {
  std::ptrdiff_t cell = 0;
  std::array<std::array<double, 3>, 2> area{}, velocity{};
  std::array<double, 2> sweep{};  ///< m^3/s
  double by_planes = 0;           ///< m^3 that the motion of the grid's planes gives to the cell in the step
};

/// Mean areas times wall velocity miss the true change of a cell's free volume, by much where a wall crosses a face of
/// the grid within the step; taken at face value the miss would be compression. These volumes, moved between
/// neighbouring cells near the walls by the remap alone, make up for it: what enters one cell leaves
/// another, and what cannot be balanced among neighbours stays and is felt as pressure. Debris is treated the same way:
/// the water makes room without being pushed, so an element that becomes a particle in one step sends out no shock.
struct VolumeCorrection {
  struct Face {
    std::ptrdiff_t face;
    int axis;
    double volume;  ///< through the lower face of the cell, m^3
  };
  std::vector<Face> faces;
  std::vector<std::ptrdiff_t> cells;
  std::vector<double> outflow;  ///< of those cells, m^3
  int iterations = 0;
};

/// `label` is scratch of the grid's size, -1 everywhere, and is left so.
VolumeCorrection correct_volumes(const Grid& grid, const CutGeometry& before, const CutGeometry& after,
                                 const std::vector<StepWall>& walls, double dt, std::vector<std::int32_t>& label);

/// Change of free volume of a cell that the motion of walls and of the grid's planes does not explain: the miss of the
/// mean areas, particles that came or went, ice that turned into particles, m^3.
double unexplained_change(const StepWall& wall, const CutGeometry& before, const CutGeometry& after, double dt);

}  // namespace polynya::fluid
