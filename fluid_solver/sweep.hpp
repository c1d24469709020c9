#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "fluid_solver/fluid.hpp"
#include "fluid_solver/interface_plane.hpp"

/// The remap goes axis by axis. A sweep moves volume through the faces across one axis; between sweeps a cell holds the
/// volume `sweep_volume`, from the Lagrangian one to the free volume at the end of the step.
namespace polynya::fluid {

/// A cell that both materials share, at the beginning of a sweep: its plane, and what it can still give in this sweep.
struct SharedCell {
  InterfacePlane plane;  ///< below it: water
  std::array<double, 2> volume{}, mass{}, energy{};
};

/// All shared cells, by layer k; `Fluid::label` of such a cell is its place in its layer, -1 elsewhere.
using SharedCells = std::vector<std::vector<SharedCell>>;

/// interfaces.cpp: finds shared cells and lays the planes. Labels them until `forget_shared_cells`.
void find_shared_cells(Fluid& fluid, SharedCells& cells);
void forget_shared_cells(Fluid& fluid);

/// What `volume` (>= 0) through the lower or upper face of a shared cell across an axis takes with it, per material. It
/// is taken off what the cell can still give.
struct Given {
  std::array<double, 2> volume{}, mass{}, energy{};
};
Given give(SharedCell& cell, int axis, bool upper, double volume, double cell_volume);

/// sweep.cpp: one sweep along an axis.
void sweep(Fluid& fluid, int axis, double dt, SharedCells& shared);
/// Two sweeps along x and y or y and x. Layers without shared cells go through both while they are in cache.
void sweep_layers(Fluid& fluid, int first, int second, double dt, SharedCells& shared);

/// remap.cpp: materials that a row of cells and its neighbours all around hold: bit 1 water, bit 2 air.
int materials_around(const Fluid& fluid, int j, int k);

/// smoothing.cpp: adds to face masses what evens out pressures that alternate from cell to cell (rows of water only).
/// Keeps means of pressures from one row of a sweep to the next.
class FaceSmoothing {
 public:
  void faces(const Fluid& fluid, double dt, int axis, int j, int k, double* mass);

 private:
  const double* mean_across(const Fluid& fluid, int axis, int j, int k);
  std::array<std::vector<double>, 2> mean_;
  std::array<std::ptrdiff_t, 2> row_{-1, -1};
};

}  // namespace polynya::fluid
