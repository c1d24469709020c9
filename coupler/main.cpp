#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <cstdio>

#include "core/exchange/environment.hpp"
#include "core/exchange/errors.hpp"
#include "core/scene/scene.hpp"
#include "coupler/coupled_run.hpp"

namespace {

struct Options {
  std::string scene, out, endpoint, run, resume;
  double connect_timeout = 0;  // s, for participants that never come; 0: the scene's
};

void start_log(const std::string& run_folder, bool fresh) {
  auto logger = spdlog::basic_logger_mt("coupler", run_folder + "/logs/coupler.log", fresh);
  logger->flush_on(spdlog::level::info);
  spdlog::set_default_logger(logger);
}

}  // namespace

int main(int argc, char** argv) {
  polynya::exchange::die_with_parent();
  Options options;
  CLI::App app{"Keeps time, finds contact and overlap, hands out loads and keeps the ledger of a coupled run."};
  app.add_option("--scene", options.scene, "resolved scene (RUN/scene.json)")->required();
  app.add_option("--out", options.out, "run folder")->required();
  app.add_option("--bind", options.endpoint, "endpoint, e.g. ipc:///tmp/x/coupler or tcp://0.0.0.0:5555")->required();
  app.add_option("--run", options.run, "identity of the run; participants must name the same")->required();
  app.add_option("--resume", options.resume, "go on from this checkpoint (RUN/checkpoints/NUMBER)");
  app.add_option("--connect-timeout", options.connect_timeout,
                 "seconds to wait for all participants (default: the scene's)");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  polynya::scene::Scene scene;
  polynya::results::Checkpoints checkpoints;
  try {
    scene = polynya::scene::load_resolved_scene(options.scene);
    if (options.connect_timeout <= 0) options.connect_timeout = scene.run.join_timeout;
    checkpoints = {options.out, "coupler", "coupler", polynya::scene::to_json(scene).dump(), options.resume};
    if (checkpoints.resuming()) checkpoints.check();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "coupler: %s\n", error.what());
    return 2;
  }
  try {
    start_log(options.out, options.resume.empty());
    polynya::coupler::run_coupled(scene, options.out, options.endpoint, options.run, options.connect_timeout,
                                  checkpoints);
    return 0;
  } catch (const std::exception& error) {
    spdlog::error("{}", error.what());
    std::fprintf(stderr, "coupler: %s\n", error.what());
    return dynamic_cast<const polynya::results::CheckpointError*>(&error) ? 2 : 1;
  }
}
