#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/results/checkpoint_folder.hpp"
#include "core/results/time_series.hpp"
#include "ice_solver/account.hpp"
#include "ice_solver/bending_record.hpp"
#include "ice_solver/last_good.hpp"
#include "ice_solver/rigid_target.hpp"
#include "ice_solver/run.hpp"
#include "ice_solver/scene_options.hpp"

namespace polynya::ice {
namespace {

constexpr int rows_per_frame = 100;  // of the time series, between two field frames

std::vector<results::Column> columns() {
  return {{"time", "s"},          {"load", "N"},          {"support_reaction", "N"},
          {"deflection", "m"},    {"kinetic", "J"},       {"internal", "J"},
          {"hourglass", "J"},     {"viscous", "J"},       {"conversion_heat", "J"},
          {"boundary_flux", "J"}, {"external_work", "J"}, {"gravity_work", "J"},
          {"balance", "J"},       {"broken_mass", "kg"},  {"particles", ""},
          {"most_damage", ""},    {"sag", "m"},           {"stored_in_contact", "J"},
          {"impulse", "N s"},     {"step", "s"}};
}

/// What acts on the ice when it runs alone.
struct Experiment {
  std::optional<BendingRig> rig;
  BendingRecord bending;
  std::optional<RigidTarget> target;
  std::vector<double> node_loads, particle_loads;
  double balance_at_start = 0, kinetic_at_start = 0;  ///< J, of the modelled part

  POLYNYA_STATE(rig, bending, target, node_loads, particle_loads, balance_at_start, kinetic_at_start)
};

double most_damage(const IceBody& ice) {
  return *std::max_element(ice.solid.element.damage.begin(), ice.solid.element.damage.end());
}

/// Extensive values are those of the full model.
void append_row(results::TimeSeries& series, const IceRun& run, const Experiment& experiment, double factor,
                double dt) {
  const Account a = account_of(run.ice);
  const auto& rig = experiment.rig;
  const auto& target = experiment.target;
  const double push = target ? factor * target->force : 0;
  const double load = rig ? roller_load(*rig, run.ice) : push;
  const double reaction = rig ? support_reaction(*rig, run.ice) : push;
  const double row[] = {run.ice.solid.time,
                        load,
                        reaction,
                        rig ? rig->deflection : 0,
                        factor * a.kinetic,
                        factor * a.internal,
                        factor * a.hourglass,
                        factor * a.viscous,
                        factor * a.conversion_heat,
                        factor * a.boundary_flux,
                        factor * a.external_work,
                        factor * a.gravity_work,
                        factor * a.balance(),
                        factor * a.broken_mass,
                        a.particles,
                        most_damage(run.ice),
                        rig ? sag(*rig, run.ice) : 0,
                        target ? factor * target->stored : 0,
                        target ? factor * target->impulse : 0,
                        dt};
  series.append(row);
}

std::optional<BendingRig> rig_of(IceRun& run) {
  const auto& bending = run.scene.ice->bending;
  if (!bending) return std::nullopt;
  BendingRig rig =
      make_bending_rig(run.ice, bending->support_span, bending->load_span, bending->speed, bending->ramp_time);
  spdlog::info("bending: supports {:.4g} m apart ({} nodes), loads {:.4g} m apart ({} nodes)", rig.support_span,
               rig.supports.size(), rig.load_span, rig.loads.size());
  return rig;
}

std::optional<RigidTarget> target_of(const IceRun& run, double step) {
  if (!run.ice.options.ball) return std::nullopt;
  return make_rigid_target(run.ice, run.scene.ice->lower_face, run.scene.contact.stiffness_factor, step);
}

void load_ice(Experiment& experiment, const IceBody& ice) {
  if (experiment.target) push_back(*experiment.target, ice, experiment.node_loads, experiment.particle_loads);
}

/// Impulse of the plate over the momentum of the ball, force at its greatest, and what is missing of the energy: that
/// of the account, and what the plate did on the ball beyond what its springs hold or released. Share of kinetic
/// energy.
nlohmann::json ball_findings(const IceRun& run, const Experiment& experiment, double peak_force) {
  const Account a = account_of(run.ice);
  const RigidTarget& target = *experiment.target;
  const double momentum = a.mass * run.ice.options.ball->speed, start = experiment.kinetic_at_start;
  const double factor = multiplicity(run.scene);
  return {{"momentum", factor * momentum},
          {"impulse", factor * target.impulse},
          {"impulse_over_momentum", target.impulse / momentum},
          {"peak_force", factor * peak_force},
          {"released_by_contact", target.released / start},
          {"energy_error", (std::abs(a.balance() - experiment.balance_at_start) +
                            std::abs(a.external_work + target.stored + target.released)) /
                               start}};
}

/// The error of energy relative to all that is stored and dissipated.
nlohmann::json findings(const IceRun& run, const Experiment& experiment, double peak_force) {
  const Account a = account_of(run.ice);
  const double there = a.kinetic + a.internal + a.hourglass + a.viscous + a.conversion_heat + a.boundary_flux;
  nlohmann::json found = last_words(run);
  found["end_reason"] = "time";
  found["end_time"] = run.ice.solid.time;
  found["energy_error"] = there > 0 ? std::abs(a.balance() - experiment.balance_at_start) / there : 0.0;
  if (experiment.rig) found.update(findings(experiment.bending, *experiment.rig, run.ice));
  if (experiment.target) found.update(ball_findings(run, experiment, peak_force));
  return found;
}

/// What goes on from step to step.
struct Course {
  IceRun& run;
  Experiment experiment;
  double dt = 0;           ///< s
  int frame = 0, row = 0;  ///< the next ones
  double peak_force = 0;   ///< N, of a plate that a ball hits
  IceFrames frames;
  results::TimeSeries series;
  LastGood last_good = {};

  POLYNYA_STATE_WITHOUT((last_good), run, experiment, dt, frame, row, peak_force, frames, series, last_good)
};

void save(Course& course) {
  const IceRun& run = course.run;
  const auto lap = course.run.ice.watch.lap("checkpoints");
  run.checkpoints.save(results::checkpoint_folder(run.steps), run.steps, run.ice.solid.time, course);
  results::commit_checkpoint(run.folder, run.steps, run.ice.solid.time, {run.checkpoints.file()});
}

void begin(Course& course) {
  IceRun& run = course.run;
  if (run.checkpoints.resuming()) {
    const results::Checkpoints checkpoints = run.checkpoints;
    if (const std::string remark = checkpoints.load(course); !remark.empty()) spdlog::warn("{}", remark);
    spdlog::info("goes on at t = {:.6e} s, step {}", run.ice.solid.time, run.steps);
    return;
  }
  course.dt = run.scene.run.step_factor * stable_step(run.ice);
  Experiment& experiment = course.experiment;
  experiment.target = target_of(run, course.dt);
  internal_forces(run.ice, 0);
  load_ice(experiment, run.ice);
  advance_velocities(run.ice, experiment.node_loads, experiment.particle_loads, 0, course.dt);
  const Account a = account_of(run.ice);
  experiment.balance_at_start = a.balance();
  experiment.kinetic_at_start = a.kinetic;
}

}  // namespace

nlohmann::json run_alone(IceRun& run) {
  IceBody& ice = run.ice;
  const auto& settings = run.scene.run;
  const double factor = (ice.options.planes.x ? 2.0 : 1.0) * (ice.options.planes.y ? 2.0 : 1.0);
  Course course{.run = run,
                .experiment = {},
                .frames = IceFrames(run.folder),
                .series = results::TimeSeries(run.folder + "/series/ice.csv", columns(), run.opening())};
  auto& [same_run, experiment, dt, frame, row, peak_force, frames, series, last_good] = course;
  auto& rig = experiment.rig = rig_of(run);
  const double interval = settings.frame_interval > 0 ? settings.frame_interval : settings.end_time;
  begin(course);
  last_good.keep(ice);
  results::CheckpointSchedule schedule(run.scene.checkpoint.interval, run.scene.checkpoint.wall_interval,
                                       ice.solid.time);
  while (true) {
    const bool last = ice.solid.time >= settings.end_time;
    if (rig) record(experiment.bending, *rig, ice, dt);
    if (experiment.target) peak_force = std::max(peak_force, experiment.target->force);
    if (last || ice.solid.time >= row * interval / rows_per_frame) {
      append_row(series, run, experiment, factor, dt);
      row = static_cast<int>(ice.solid.time * rows_per_frame / interval) + 1;
    }
    if (last || ice.solid.time >= frame * interval) {
      const auto lap = ice.watch.lap("frames");
      frames.write(frame, ice);
      frame = static_cast<int>(ice.solid.time / interval) + 1;
    }
    if (last) break;
    convert_failed_elements(ice);
    if (rig) move_rollers(*rig, ice, ice.solid.time, dt);
    advance_positions(ice, dt);
    last_good.internal_forces(ice, dt, frames);
    const double next = std::min(settings.step_factor * stable_step(ice), 1.1 * dt);
    load_ice(experiment, ice);
    advance_velocities(ice, experiment.node_loads, experiment.particle_loads, dt, next);
    if (experiment.target) book_impulse(*experiment.target, 0.5 * (dt + next));
    run.smallest_step = std::min(run.smallest_step, dt);
    ++run.steps;
    dt = next;
    if (!run.checkpoints.active() || ice.solid.time >= settings.end_time || !schedule.due(ice.solid.time)) continue;
    schedule.taken(ice.solid.time);
    save(course);
  }
  return findings(run, experiment, peak_force);
}

}  // namespace polynya::ice
