#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "core/exchange/participant.hpp"
#include "core/results/checkpoint_file.hpp"
#include "core/results/time_series.hpp"
#include "core/scene/scene.hpp"
#include "ice_solver/ice_body.hpp"

namespace polynya::ice {

/// What a run needs besides the ice, and what it leaves for the report.
struct IceRun {
  scene::Scene scene;
  std::string folder;
  IceBody ice;
  long steps = 0;
  double smallest_step = 1e300;  ///< s
  results::Checkpoints checkpoints;

  results::Opening opening() const {
    return checkpoints.resuming() ? results::Opening::continued : results::Opening::fresh;
  }

  POLYNYA_STATE_WITHOUT((scene, folder, checkpoints), scene, folder, ice, steps, smallest_step, checkpoints)
};

/// The role of a solid in the coupled conversation (docs/protocol.md), until the coupler says `bye`.
void run_coupled(IceRun& run, exchange::Participant& participant);

/// Without partners until scene.run.end_time: bending between rollers, or the plate left to itself. Writes
/// RUN/series/ice.csv and returns what belongs in the run's summary.
nlohmann::json run_alone(IceRun& run);

/// What the ice has to say at the end; masses and energies are those of the full plate.
nlohmann::json last_words(const IceRun& run);

}  // namespace polynya::ice
