#include <omp.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <optional>

#include "core/exchange/environment.hpp"
#include "core/exchange/errors.hpp"
#include "core/exchange/record_reader.hpp"
#include "core/exchange/replay_options.hpp"
#include "fluid_solver/bodies_run.hpp"
#include "fluid_solver/cards.hpp"
#include "fluid_solver/conversation.hpp"
#include "fluid_solver/dam_run.hpp"
#include "fluid_solver/tube.hpp"

namespace {

using namespace polynya;

struct Options {
  std::string scene, out, endpoint, run, name = "fluid", resume;
  exchange::Replay replay;
  int threads = 0;

  bool alone() const { return endpoint.empty() && !replay.wanted(); }
};

/// Reads the command line; a value means that the process ends with this exit code.
std::optional<int> parse(int argc, char** argv, Options& options) {
  CLI::App app{
      "Moves water and air around the solids that cut its grid. Without --connect: a shock tube, a dam that "
      "breaks, or bodies that move as the scene says."};
  app.add_option("--scene", options.scene, "resolved scene (RUN/scene.json)")->required();
  app.add_option("--out", options.out, "run folder")->required();
  auto* connect = app.add_option("--connect", options.endpoint, "the coupler's endpoint");
  app.add_option("--run", options.run, "identity of the run, the coupler's")->needs(connect);
  app.add_option("--name", options.name, "name under which the coupler expects this process");
  app.add_option("--resume", options.resume, "go on from this checkpoint (RUN/checkpoints/NUMBER)");
  exchange::add_replay_options(app, options.replay);
  app.add_option("--threads", options.threads, "threads to use; 0: as many as OpenMP offers")
      ->check(CLI::NonNegativeNumber);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  if (options.threads > 0) omp_set_num_threads(options.threads);
  return {};
}

void start_log(const Options& options) {
  auto logger =
      spdlog::basic_logger_mt(options.name, options.out + "/logs/" + options.name + ".log", options.resume.empty());
  logger->flush_on(spdlog::level::info);
  spdlog::set_default_logger(logger);
}

fluid::Fluid build(const Options& options, const scene::Scene& scene) {
  if (!scene.fluid) throw std::runtime_error(options.scene + ": the scene has no fluid");
  const bool tube = scene.fluid->tube.has_value();
  const bool alone = tube || scene.fluid->dam || scene.fluid->bodies;
  if (alone != options.alone()) {
    throw std::runtime_error(
        options.scene + (alone ? ": a tube, a dam or a body whose motion is prescribed runs alone, without --connect"
                               : ": water and air move around solids; give --connect, or a scene with [tube], [dam] or "
                                 "[body.NAME]"));
  }
  fluid::Fluid built = tube ? fluid::make_tube(scene) : fluid::make_fluid(scene);
  spdlog::info("grid: {} x {} x {} = {} cells", built.grid.nx, built.grid.ny, built.grid.nz, built.grid.cells());
  return built;
}

/// Runs body; if the fluid loses its meaning the last good state becomes a frame and the error says so.
template <class Body>
void keeping_last_good(fluid::Output& output, Body&& body) {
  try {
    body();
  } catch (const fluid::FluidError& error) {
    throw fluid::FluidError(std::string(error.what()) + "; " + output.write_last_good());
  }
}

results::Checkpoints checkpoints_of(const Options& options, const scene::Scene& scene) {
  if (options.replay.wanted()) return {};
  return {options.out, options.name, "fluid_solver", scene::to_json(scene).dump(), options.resume};
}

void run(const Options& options, const scene::Scene& scene, fluid::Fluid& built) {
  const results::Checkpoints checkpoints = checkpoints_of(options, scene);
  fluid::Output output(options.out, options.name, scene.run.end_time, scene,
                       checkpoints.resuming() ? results::Opening::continued : results::Opening::fresh);
  if (options.alone()) {
    try {
      double error = -1;
      nlohmann::json more = nlohmann::json::object();
      keeping_last_good(output, [&] {
        if (scene.fluid->dam) {
          fluid::run_dam(scene, built, output, checkpoints);
        } else if (scene.fluid->bodies) {
          fluid::PrescribedBodies bodies(scene, built.grid);
          fluid::run_bodies(scene, built, bodies, output, checkpoints);
          more = {{"overlap_cells", bodies.counts().cells},
                  {"overlap_cells_exact", bodies.counts().exact},
                  {"overlap_cells_two_bodies", bodies.counts().shared},
                  {"overlap_cells_united", bodies.counts().united},
                  {"overlap_cells_united_exactly", bodies.counts().united_exactly},
                  {"overlap_cells_doubted", bodies.counts().doubted}};
        } else
          error = fluid::run_tube(scene, built, output, checkpoints);
      });
      if (error >= 0) spdlog::info("mean error of the density: {:.4f} of its mean", error);
      output.write_summary(built, error, more);
    } catch (...) {
      output.close(built, {});
      throw;
    }
    output.close(built, {});
    spdlog::info("finished: {}", output.summary(built).dump());
    return;
  }
  exchange::Participant coupler({options.endpoint, options.run, options.name, 60, options.replay});
  const auto close = [&] { output.close(built, coupler.waits().intervals()); };
  try {
    keeping_last_good(output, [&] { fluid::run_coupled(scene, built, coupler, output, checkpoints); });
    close();
  } catch (const exchange::Stopped&) {
    close();
    throw;
  } catch (const exchange::CouplerLost&) {
    close();
    throw;
  } catch (const std::exception& error) {
    coupler.fail(error.what());
    close();
    throw;
  }
}

}  // namespace

int main(int argc, char** argv) {
  exchange::die_with_parent();
  Options options;
  if (const auto code = parse(argc, argv, options)) return *code;
  scene::Scene scene;
  std::optional<fluid::Fluid> built;
  try {
    scene = scene::load_resolved_scene(options.scene);
    if (options.replay.wanted()) exchange::check_replayable(options.replay.record, options.name);
    if (!options.resume.empty()) checkpoints_of(options, scene).check();
    start_log(options);
    built.emplace(build(options, scene));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", options.name.c_str(), error.what());
    return 2;
  }
  try {
    run(options, scene, *built);
    return 0;
  } catch (const exchange::ReplayEnded& verdict) {
    std::printf("%s\n", verdict.what());
    return 0;
  } catch (const results::CheckpointError& error) {
    spdlog::error("{}", error.what());
    std::fprintf(stderr, "%s: %s\n", options.name.c_str(), error.what());
    return 2;
  } catch (const std::exception& error) {
    spdlog::error("{}", error.what());
    std::fprintf(stderr, "%s: %s\n", options.name.c_str(), error.what());
    return 1;
  }
}
