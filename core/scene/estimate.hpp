#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "core/scene/scene.hpp"

namespace polynya::scene {

/// What one unit of work costs. Estimates, good to a factor of two; a run's report has the measured times.
struct CostModel {
  /// s of one core per cell and step with solids: remap, groups, cut cells, volume correction and exchange. The kernel
  /// alone takes 131 ns (docs/verification_fluid.md); the quick base scene's fluid took some 90 s for 4,200 steps of
  /// 51,840 cells on two busy cores.
  double fluid_cell_step = 400e-9;
  double hexahedron_step = 150e-9;      ///< s of one core per element and step
  double window = 300e-6;               ///< s per coupling window: messages, contact search, ledger
  double cut_triangle = 8e-3 / 5000;    ///< s of one core per triangle and span: overlap of surface and grid
  double fluid_cell_memory = 600;       ///< bytes
  double hexahedron_memory = 800;       ///< bytes
  double process_memory = 60e6;         ///< bytes per process
  double fluid_cell_frame = 150;        ///< bytes per cell in a field frame
  double hexahedron_frame = 200;        ///< bytes per element in a field frame
  double window_rows = 1500;            ///< bytes of all time series per window
  double fluid_cell_checkpoint = 520;   ///< bytes per cell: 27 MB of the quick base scene's 51,840 cells
  double hexahedron_checkpoint = 2400;  ///< bytes per element: 10 MB of its 4,117 elements, the coupler's part too
  double checkpoints_kept = 3;          ///< the last two and the one in work
  double usable = 0.9;                  ///< fraction of the available memory and disk that a run may take
};

struct Machine {
  double memory = 0;  ///< bytes available
  double disk = 0;    ///< bytes available where the results go
  int cores = 1;
};

/// This machine, for results written at or below `folder`.
Machine machine(const std::filesystem::path& folder);

struct Estimate {
  std::size_t cells = 0, ice_elements = 0, vehicle_elements = 0, nodes = 0;
  double ice_step = 0, vehicle_step = 0;  ///< s, stable times step_factor; 0: no such part
  double fluid_span = 0;                  ///< s between two fluid steps; 0: no fluid
  double windows = 0, fluid_steps = 0, frames = 0;
  double wall_time = 0;  ///< s until end_time
  double memory = 0, disk = 0;
  Machine available;
  bool fits = false;
  std::string reason;
};

Estimate estimate(const Scene& scene, const Machine& machine, const CostModel& costs = {});
nlohmann::json to_json(const Estimate& estimate);

/// Speed of sound (m/s): of dilatational waves in a solid, of a fluid at its density and this pressure (Pa).
double sound_speed(const MaterialCard& card, double pressure = 101325);

}  // namespace polynya::scene
