#include <omp.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <optional>

#include "core/exchange/environment.hpp"
#include "core/exchange/record_reader.hpp"
#include "core/exchange/replay_options.hpp"
#include "structure_solver/conversation.hpp"
#include "structure_solver/free_flight.hpp"
#include "structure_solver/surface_file.hpp"

namespace {

using namespace polynya;

struct Options {
  std::string scene, out, endpoint, run, name = "structure", surface, resume;
  exchange::Replay replay;
  int threads = 0;
};

/// Reads the command line; a value means that the process ends with this exit code.
std::optional<int> parse(int argc, char** argv, Options& options) {
  CLI::App app{"Moves the vehicle: elastic finite elements or a rigid body. Without --connect: free flight."};
  app.add_option("--scene", options.scene, "resolved scene (RUN/scene.json)")->required();
  app.add_option("--out", options.out, "run folder")->required();
  auto* connect = app.add_option("--connect", options.endpoint, "the coupler's endpoint");
  app.add_option("--run", options.run, "identity of the run, the coupler's")->needs(connect);
  app.add_option("--name", options.name, "name under which the coupler expects this process");
  app.add_option("--write-surface", options.surface, "write the hull to this file (JSON) and end")->excludes(connect);
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

void describe(const structure::BuiltVehicle& v) {
  spdlog::info("mesh: {} elements, {} nodes, {} hull triangles, {} element(s) through the wall or around the core",
               v.mesh.hexahedra.element_count(), v.mesh.hexahedra.node_count(), v.mesh.hull_triangles.size() / 3,
               v.mesh.layers);
  spdlog::info("quality: scaled Jacobian >= {:.3f}, aspect <= {:.2f}, edge >= {:.4f} mm, stable step {:.3e} s",
               v.quality.least_scaled_jacobian, v.quality.greatest_aspect, v.quality.smallest_edge * 1e3,
               v.body->stable_step());
  spdlog::info("mass: {:.9g} kg modelled, {:.9g} kg in all, wall {:.4f} mm, density {:.2f} kg/m^3. {}", v.mass,
               v.whole_mass, v.mesh.wall_thickness * 1e3, v.density, v.mass_note);
}

results::Checkpoints checkpoints_of(const Options& options, const scene::Scene& scene) {
  if (options.replay.wanted()) return {};
  return {options.out, options.name, "structure_solver", scene::to_json(scene).dump(), options.resume};
}

void run(const Options& options, const scene::Scene& scene, structure::BuiltVehicle& vehicle) {
  const results::Checkpoints checkpoints = checkpoints_of(options, scene);
  structure::Output output(options.out, options.name, scene.run.end_time, vehicle,
                           checkpoints.resuming() ? results::Opening::continued : results::Opening::fresh);
  if (options.endpoint.empty() && !options.replay.wanted()) {
    structure::run_free_flight(vehicle, scene.run, output);
    output.close({});
    output.write_summary();
    spdlog::info("finished: {}", output.summary().dump());
    return;
  }
  exchange::Participant coupler({options.endpoint, options.run, options.name, 60, options.replay});
  try {
    structure::run_coupled(vehicle, scene.run.step_factor, coupler, output, checkpoints);
    output.close(coupler.waits().intervals());
  } catch (const exchange::Stopped&) {
    output.close(coupler.waits().intervals());
    throw;
  } catch (const exchange::CouplerLost&) {
    output.close(coupler.waits().intervals());
    throw;
  } catch (const std::exception& error) {
    coupler.fail(error.what());
    output.close(coupler.waits().intervals());
    throw;
  }
}

}  // namespace

int main(int argc, char** argv) {
  exchange::die_with_parent();
  Options options;
  if (const auto code = parse(argc, argv, options)) return *code;
  scene::Scene scene;
  structure::BuiltVehicle vehicle;
  try {
    scene = scene::load_resolved_scene(options.scene);
    if (options.replay.wanted()) exchange::check_replayable(options.replay.record, options.name);
    if (!options.resume.empty()) {
      if (options.endpoint.empty())
        throw std::runtime_error("a vehicle that flies alone keeps no checkpoints; run it again");
      checkpoints_of(options, scene).check();
    }
    start_log(options);
    vehicle = structure::build_vehicle(scene);
    describe(vehicle);
    if (!options.surface.empty()) {
      structure::write_surface(options.surface, vehicle);
      return 0;
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "structure_solver: %s\n", error.what());
    return 2;
  }
  try {
    run(options, scene, vehicle);
    return 0;
  } catch (const exchange::ReplayEnded& verdict) {
    std::printf("%s\n", verdict.what());
    return 0;
  } catch (const results::CheckpointError& error) {
    spdlog::error("{}", error.what());
    std::fprintf(stderr, "%s: %s\n", "structure_solver", error.what());
    return 2;
  } catch (const std::exception& error) {
    spdlog::error("{}", error.what());
    std::fprintf(stderr, "structure_solver: %s\n", error.what());
    return 1;
  }
}
