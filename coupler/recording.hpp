#pragma once
#include <memory>
#include <string>

#include "core/exchange/hub.hpp"
#include "core/scene/scene.hpp"

namespace polynya::coupler {

/// Starts the recorder that the scene asks for, into RUN/record, and lets the hub note its messages; null if none.
std::unique_ptr<exchange::Recorder> start_recorder(const scene::Scene& scene, const std::string& run_folder,
                                                   const std::string& run_id, exchange::Hub& hub);

/// Writes what is left of the record and says in the log what it cost. Throws results::ResultsError.
void finish_recorder(exchange::Recorder& recorder);

}  // namespace polynya::coupler
