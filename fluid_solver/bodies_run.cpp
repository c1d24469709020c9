#include "fluid_solver/bodies_run.hpp"

#include "core/results/time_series.hpp"
#include "fluid_solver/alone.hpp"
#include "fluid_solver/phases.hpp"

namespace polynya::fluid {
namespace {

constexpr double rows = 2000;

struct Series {
  results::TimeSeries file;
  PrescribedBodies& bodies;
  double interval;                ///< s between rows, from the end that the run began with
  double next = 0;                ///< s, when the next row is due
  double last_time = 0;           ///< s, of the last row
  std::vector<BodyImpulse> last;  ///< given until then

  POLYNYA_STATE(file, bodies, interval, next, last_time, last)
};

std::vector<results::Column> columns_of(const PrescribedBodies& bodies) {
  std::vector<results::Column> columns{{"time", "s"}};
  const std::pair<const char*, const char*> kinds[]{
      {"force", "N"}, {"moment", "N m"}, {"position", "m"}, {"velocity", "m/s"}};
  for (std::size_t b = 0; b < bodies.count(); ++b)
    for (const auto& [kind, unit] : kinds)
      for (const char* axis : {"x", "y", "z"}) columns.push_back({bodies.name(b) + "_" + kind + "_" + axis, unit});
  return columns;
}

void append(Series& series, double time) {
  std::vector<double> row{time};
  const PrescribedBodies& bodies = series.bodies;
  const double passed = time - series.last_time;
  for (std::size_t b = 0; b < bodies.count(); ++b) {
    const BodyImpulse &now = bodies.given()[b], &then = series.last[b];
    for (std::size_t d = 0; d < 3; ++d) row.push_back(passed > 0 ? (now.linear[d] - then.linear[d]) / passed : 0.0);
    for (std::size_t d = 0; d < 3; ++d) row.push_back(passed > 0 ? (now.angular[d] - then.angular[d]) / passed : 0.0);
    const scene::Pose pose = scene::pose_at(bodies.body(b), time);
    const scene::Vector velocity = scene::velocity_at(bodies.body(b), time);
    row.insert(row.end(), pose.position.begin(), pose.position.end());
    row.insert(row.end(), velocity.begin(), velocity.end());
  }
  series.file.append(row);
  series.last = bodies.given();
  series.last_time = time;
}

/// Water and air at rest, or the potential flow around bodies that move from the start.
void start(const scene::Scene& scene, Fluid& fluid, PrescribedBodies& bodies) {
  fill_hydrostatic(fluid, bodies.start(), scene.fluid->waterline);
  if (scene.fluid->start == "potential_flow" && bodies.moves_at_start()) {
    const int iterations = start_potential_flow(fluid);
    spdlog::info("potential flow: {} iterations, kinetic energy {:.6g} J", iterations, fluid.account.kinetic);
  }
  spdlog::info("start: water {:.9g} kg, air {:.9g} kg, stable step {:.3e} s, {} groups of cut cells",
               fluid.account.mass[water], fluid.account.mass[air], stable_step(fluid), fluid.groups.count());
}

}  // namespace

void run_bodies(const scene::Scene& scene, Fluid& fluid, PrescribedBodies& bodies, Output& output,
                const results::Checkpoints& checkpoints) {
  const bool flows = scene.fluid->start == "potential_flow" && bodies.moves_at_start();
  if (!checkpoints.resuming()) {
    const auto lap = fluid.watch.lap("start");
    start(scene, fluid, bodies);
  }
  Series series{{output.folder() + "/series/bodies.csv", columns_of(bodies),
                 checkpoints.resuming() ? results::Opening::continued : results::Opening::fresh},
                bodies,
                scene.run.end_time / rows,
                0,
                0,
                std::vector<BodyImpulse>(bodies.count())};
  const auto advance = [&](double dt) {
    const Overlap now = fluid.steps == 0 ? bodies.start() : Overlap{};
    const Overlap& next = [&]() -> const Overlap& {
      const auto lap = fluid.watch.lap("overlap");
      return bodies.advance(fluid.time, dt);
    }();
    if (fluid.steps == 0 && flows) adapt_potential_flow(fluid, now, next, scene.fluid->waterline);
    step(fluid, dt, next);
    bodies.take(fluid, dt);
  };
  run_alone(scene, fluid, output, checkpoints, series, advance, [&] {
    if (fluid.time < series.next) return;
    while (series.next <= fluid.time) series.next += series.interval;
    append(series, fluid.time);
  });
}

}  // namespace polynya::fluid
