#pragma once
#include <string>

#include "core/results/checkpoint_file.hpp"
#include "core/scene/scene.hpp"

namespace polynya::coupler {

/// Binds the endpoint, waits for the participants that the scene calls for, runs to the scene's end and writes
/// RUN/series/coupler.csv, RUN/series/ledger.csv, RUN/coupler_summary.json and RUN/logs/coupler.json.
/// When anything fails the participants still here are told to stop before the exception leaves.
void run_coupled(const scene::Scene& scene, const std::string& run_folder, const std::string& endpoint,
                 const std::string& run_id, double connect_timeout, const results::Checkpoints& checkpoints = {});

}  // namespace polynya::coupler
