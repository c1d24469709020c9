#include "coupler/pacing.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

#include "core/compute/threads.hpp"
#include "coupler/end_condition.hpp"
#include "coupler/handed_loads.hpp"
#include "coupler/horizon.hpp"
#include "coupler/stability_limits.hpp"

namespace polynya::coupler {
namespace {

constexpr double least_free_window = 3;  // steps: shorter ones are not worth it

/// A step that collapses would never reach the end: says what limits it, and stops when it is hopeless.
void watch_step(Run& run) {
  run.first_planned_step = std::max(run.first_planned_step, run.planned_step);
  if (run.planned_step > run.first_planned_step / 20) return;
  std::string solids;
  for (const SolidSide& side : run.conversation.solids)
    solids += fmt::format("{} {:.2e} s, ", side.name, side.stable_step);
  const std::string limits = fmt::format(
      "the window has fallen to {:.2e} s at t = {:.4e} s; stable steps: {}fluid {:.2e} s, lag of fluid loads {:.2e} s",
      run.planned_step, run.keeper.time, solids, run.limits.fluid_stable, run.limits.lag_limit);
  if (run.planned_step < run.first_planned_step / 1000) throw std::runtime_error(limits);
  if (!run.step_warned) spdlog::warn("{}", limits);
  run.step_warned = true;
}

void suggest_threads(Run& run, const std::string& name, int threads) {
  if (name == "coupler") return compute::use_threads(threads);
  if (run.conversation.fluid && run.conversation.fluid->name == name) run.conversation.fluid->new_threads = threads;
  for (SolidSide& side : run.conversation.solids)
    if (side.name == name) side.new_threads = threads;
}

/// How long nothing can act between the participants, s: without fluid until the solids may touch. The latest end of
/// the run aside.
double quiet_time(Run& run) {
  const SolidSide* vehicle = run.conversation.find(Body::vehicle);
  const SolidSide* ice = run.conversation.find(Body::ice);
  if (run.conversation.fluid || !vehicle || !ice || !vehicle->can_subdivide || !ice->can_subdivide) return 0;
  const double until_frame = run.next_frame_time - run.keeper.time;
  const double until_event = time_to_event(run.scene, run.monitor->nose(), run.monitor->speed());
  return std::min({time_apart(*vehicle, *ice, run.scene.run.gravity), until_frame, until_event});
}

/// The pressure at time 0 acts until the fluid expects something else, or has answered: it is given to the solids, not
/// taken from the fluid.
void give_start_impulse(SolidSide& side, double span, Ledger& ledger) {
  const int body = static_cast<int>(side.body);
  for (std::size_t i = 0; i < side.start_force.size(); ++i) {
    const double impulse = span * side.start_force[i];
    side.fluid_impulse[i] += impulse;
    ledger.fluid_given[body][i % 3] += impulse;
    ledger.fluid_start[body][i % 3] += impulse;
  }
}

void begin_loads(Run& run, double span) {
  if (!run.conversation.fluid) return;
  const bool expects = run.conversation.fluid->forecasts && run.keeper.span > 0;
  for (SolidSide& side : run.conversation.solids) {
    // In span 0 the loads of the start act up to the middle of its last window (the half step before is booked where it
    // begins); with forecasts what is given beyond it until the span's end is known as such (`last_window`).
    const double after_middle = run.conversation.fluid->forecasts ? 0.5 : 1.0;
    const double handed_out = run.keeper.span == 0 ? span - after_middle * run.planned_step : span;
    if (!expects && run.keeper.span <= 1) give_start_impulse(side, handed_out, run.ledger);
    if (run.keeper.span == 1) side.start_force.clear();
    begin_span_loads(side, {.span = span,
                            .last_span = run.keeper.time - run.keeper.span_start,
                            .window = run.planned_step,
                            .last_window = run.keeper.length,
                            .expects = expects});
  }
}

}  // namespace

void refresh_limits(Run& run) {
  run.limits.solid_stable = 1e300;
  for (const SolidSide& side : run.conversation.solids)
    run.limits.solid_stable = std::min(run.limits.solid_stable, side.stable_step);
  if (run.conversation.fluid) run.limits.fluid_stable = run.conversation.fluid->stable_step;
  if (!(run.limits.solid_stable > 0)) throw std::runtime_error("a solid reports a stable step that is not positive");
}

void plan_next_span(Run& run) {
  refresh_limits(run);
  limit_growth(run.limits, run.plan.step > 0 ? &run.plan : nullptr);
  run.plan = plan_span(run.limits);
  const SpanPlan& plan = run.plan;
  run.planned_step = plan.step;
  run.keeper.windows_left = plan.windows;
  watch_step(run);
  begin_loads(run, plan.step * static_cast<double>(plan.windows));
  run.keeper.span_start = run.keeper.time;
}

void bound_lag(Run& run, const geometry::CutCells& cells) {
  if (run.conversation.fluid->forecasts) return;
  refresh_limits(run);
  const LightestWall wall = lightest_wall(run.conversation, cells);
  const double limit = lag_limit(wall, run.scene);
  if (limit < 0.8 * run.logged_lag_limit) {
    run.logged_lag_limit = limit;
    const geometry::GridLines& grid = run.conversation.fluid->grid;
    const auto position = grid.cell_position(wall.cell);
    spdlog::info(
        "t = {:.4e} s: lag of fluid loads bounds the span to {:.2e} s: {} of {:.3f} kg/m^2 in the cell at ({:.4f}, "
        "{:.4f}, {:.4f}) m",
        run.keeper.time, limit, wall.body == Body::ice ? "ice" : "vehicle", wall.areal_mass, grid.lines[0][position[0]],
        grid.lines[1][position[1]], grid.lines[2][position[2]]);
  }
  run.limits.lag_limit = std::min(limit, held_share_of_step * run.limits.solid_stable);
}

double next_length(Run& run, double step, bool span_ends) {
  const double quiet = span_ends ? quiet_time(run) : 0.0,
               left = std::max(0.0, run.scene.run.end_time - run.keeper.time);
  if (quiet < least_free_window * step) return step;
  // With a later end this window would be longer, and all that follows another.
  run.fitted_to_end = run.fitted_to_end || left < quiet;
  if (left < least_free_window * step) return step;
  run.keeper.windows_left = 1;
  ++run.keeper.free_windows;
  return std::min(quiet, left);
}

void begin_balance(Run& run, const std::vector<std::string>& names) {
  const int cores = compute::threads();
  std::map<std::string, int> threads{{"coupler", cores}};
  for (const std::string& name : names)
    if (const auto own = run.scene.participants.find(name);
        own == run.scene.participants.end() || own->second.threads == 0)
      threads[name] = first_threads(name, cores);
  run.balance.emplace(cores, threads);
  for (const auto& [name, count] : threads) suggest_threads(run, name, count);
  run.span_began = std::chrono::steady_clock::now();
}

void balance_threads(Run& run) {
  const auto now = std::chrono::steady_clock::now();
  const std::chrono::duration<double> passed = now - std::exchange(run.span_began, now);
  const long windows = run.keeper.window + 1 - std::exchange(run.span_window, run.keeper.window + 1);
  if (run.keeper.free()) return;
  for (const std::string& name : run.balance->note(passed.count() / static_cast<double>(windows)))
    suggest_threads(run, name, run.balance->threads(name));
}

}  // namespace polynya::coupler
