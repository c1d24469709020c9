// The ice: reads the resolved scene, talks to the coupler or runs alone.
#include <omp.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include "core/compute/threads.hpp"
#include "core/exchange/environment.hpp"
#include "core/exchange/record_reader.hpp"
#include "core/exchange/replay_options.hpp"
#include "core/results/durable_file.hpp"
#include "core/results/process_report.hpp"
#include "ice_solver/imported_mesh.hpp"
#include "ice_solver/run.hpp"
#include "ice_solver/scene_options.hpp"

namespace {

using namespace polynya;

struct Options {
  std::string scene, out, endpoint, run, name = "ice", resume;
  exchange::Replay replay;
  int threads = 0;  // 0: what OpenMP finds
};

void start_log(const Options& options) {
  auto logger =
      spdlog::basic_logger_mt(options.name, options.out + "/logs/" + options.name + ".log", options.resume.empty());
  logger->flush_on(spdlog::level::trace);
  spdlog::set_default_logger(logger);
}

/// A card's hidden meaning belongs in the log: the strengths it implies.
void log_law(const continuum::Law& law, const std::string& card) {
  const auto* brittle = std::get_if<continuum::JohnsonHolmquist2>(&law);
  if (!brittle) return;
  spdlog::info("{}: tensile strength {:.3g} MPa at 1/s", card,
               1e-6 * continuum::uniaxial_tensile_strength(*brittle, 1));
  for (const double rate : {1.0, 10.0, 100.0, 1e3, 1e4})
    spdlog::info("{}: unconfined compressive strength {:.3g} MPa at {:g}/s", card,
                 1e-6 * continuum::unconfined_compressive_strength(*brittle, rate), rate);
}

/// The ice of the scene; its mesh lies beside the scene, where it has one from a file.
ice::IceBody make_ice(const Options& options, const scene::Scene& scene) {
  ice::IceOptions ice_options = ice::options_from_scene(scene);
  if (!scene.ice->mesh) return ice::make_ice(ice_options);
  const auto file = std::filesystem::absolute(options.scene).parent_path() / "ice_mesh.h5";
  const results::MeshFile mesh = ice::use_imported_mesh(ice_options, *scene.ice->mesh, file.string());
  ice::IceBody ice = ice::make_ice(ice_options);
  spdlog::info("{}: {}", scene.ice->mesh->file, ice::element_that_sets_the_step(ice, mesh));
  return ice;
}

void write_report(const Options& options, const ice::IceRun& run, const exchange::Participant* participant) {
  results::ProcessReport report;
  if (participant) report.waits["coupler"] = participant->waits().intervals();
  report.set_headings(run.ice.watch.seconds(), run.ice.watch.cpu_seconds());
  report.threads = compute::threads();
  report.counts = {{"steps", static_cast<double>(run.steps)},
                   {"elements", static_cast<double>(run.ice.solid.element_count())},
                   {"particles", static_cast<double>(run.ice.particles.count())},
                   {"awake_percent", 100 * run.ice.solid.sleeping.share_awake()},
                   {"list_builds", static_cast<double>(run.ice.list.builds())}};
  report.write(options.out, options.name);
}

/// Everything after the input was found good. Returns the exit code.
int work(const Options& options, ice::IceRun& run) {
  std::optional<exchange::Participant> participant;
  int code = 0;
  try {
    if (options.endpoint.empty() && !options.replay.wanted()) {
      results::replace_text(options.out + "/" + options.name + "_summary.json", ice::run_alone(run).dump(1) + "\n");
    } else {
      participant.emplace(
          exchange::Participant::Options{options.endpoint, options.run, options.name, 60, options.replay});
      ice::run_coupled(run, *participant);
    }
    spdlog::info("end: {}", ice::last_words(run).dump());
  } catch (const exchange::ReplayEnded& verdict) {
    std::printf("%s\n", verdict.what());
  } catch (const exchange::Stopped& stop) {
    spdlog::error("{}", stop.what());
    code = 1;
  } catch (const std::exception& error) {
    spdlog::error("{}", error.what());
    std::fprintf(stderr, "ice_solver: %s\n", error.what());
    if (participant) participant->fail(error.what());
    code = dynamic_cast<const results::CheckpointError*>(&error) ? 2 : 1;
  }
  write_report(options, run, participant ? &*participant : nullptr);
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  exchange::die_with_parent();
  Options options;
  CLI::App app{
      "The ice: finite elements that become particles. Alone, or with --connect as a participant of a coupled run."};
  app.add_option("--scene", options.scene, "resolved scene (RUN/scene.json)")->required();
  app.add_option("--out", options.out, "run folder")->required();
  auto* connect =
      app.add_option("--connect", options.endpoint, "endpoint of the coupler; without it the ice runs alone");
  auto* run_id = app.add_option("--run", options.run, "identity of the run, as given to the coupler");
  connect->needs(run_id);
  app.add_option("--name", options.name, "name of this participant");
  app.add_option("--resume", options.resume, "go on from this checkpoint (RUN/checkpoints/NUMBER)");
  exchange::add_replay_options(app, options.replay);
  app.add_option("--threads", options.threads, "threads; 0: as many as OpenMP finds")->check(CLI::NonNegativeNumber);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  if (options.threads > 0) omp_set_num_threads(options.threads);
  ice::IceRun run;
  try {
    run.scene = scene::load_resolved_scene(options.scene);
    if (options.replay.wanted()) exchange::check_replayable(options.replay.record, options.name);
    run.folder = options.out;
    if (!options.replay.wanted())
      run.checkpoints = {options.out, options.name, "ice_solver", scene::to_json(run.scene).dump(), options.resume};
    if (!options.resume.empty()) run.checkpoints.check();
    start_log(options);
    run.ice = make_ice(options, run.scene);
    log_law(run.ice.solid.law, run.scene.ice->material);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "ice_solver: %s\n", error.what());
    return 2;
  }
  spdlog::info("{} elements, {} nodes, stable step {:.3e} s", run.ice.solid.element_count(), run.ice.solid.node_count(),
               ice::stable_step(run.ice));
  return work(options, run);
}
