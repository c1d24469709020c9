#include "coupler/coupled_run.hpp"

#include <spdlog/spdlog.h>

#include <cmath>
#include <fstream>

#include "core/compute/timer.hpp"
#include "core/contact/penalty_contact.hpp"
#include "core/exchange/errors.hpp"
#include "core/results/process_report.hpp"
#include "coupler/conversation.hpp"
#include "coupler/end_condition.hpp"
#include "coupler/ledger.hpp"
#include "coupler/monitor.hpp"
#include "coupler/overlap_exchange.hpp"
#include "coupler/stability_limits.hpp"
#include "coupler/time_keeper.hpp"

namespace polynya::coupler {
namespace {

constexpr long cuts_between_samples = 100;   // every 100 cuts a seeded sample is recut by CGAL
constexpr std::size_t cells_in_sample = 8;
constexpr double largest_sample_difference = 1e-10;

/// Everything that lives as long as the run.
struct Run {
  const scene::Scene& scene;
  std::string folder;
  Conversation conversation;
  results::ProcessReport report;
  compute::Stopwatch watch;
  TimeKeeper keeper;
  StepLimits limits;
  Ledger ledger;
  LedgerFile ledger_file;
  std::array<WorkMeter, body_count> work;
  std::optional<contact::PenaltyContact> contact;
  bool topology_changed = false;
  std::optional<OverlapExchange> overlap;
  std::optional<Monitor> monitor;
  double planned_step = 0, first_planned_step = 0, next_frame_time = 0;
  double logged_lag_limit = 1;  ///< s
  double slowest_answer = 1;    ///< s, longest span that lets the fluid follow the fastest motion of the intact ice
  bool step_warned = false;
  long frame = 0, cuts = 0;
  std::string end;  ///< why the run ends; empty while it goes on

  Run(const scene::Scene& s, std::string run_folder, exchange::Hub& hub)
      : scene(s), folder(std::move(run_folder)), conversation{hub, {}, std::nullopt}, ledger_file(folder) {}

  contact::ContactLaw contact_law(const contact::Body& vehicle, const contact::Body& ice) const {
    const scene::Scene& s = scene;
    contact::ContactLaw law;
    law.friction = s.effect("friction") ? s.contact.friction : 0.0;
    law.damping = s.contact.damping;
    law.stiffness_factor = s.contact.stiffness_factor;
    law.depth_limit = 0.5 * s.resolution.ice_element;
    law.skin = 0.25 * s.resolution.ice_element;
    law.two_way = s.contact.two_way == "on" || (s.contact.two_way == "auto" && contact::is_finer(vehicle, ice));
    law.edges = s.contact.edges != "off";
    law.mirror = {s.symmetry == scene::Symmetry::quarter, s.symmetry != scene::Symmetry::full};
    return law;
  }
};

void refresh_limits(Run& run) {
  run.limits.solid_stable = 1e300;
  for (const SolidSide& side : run.conversation.solids)
    run.limits.solid_stable = std::min(run.limits.solid_stable, side.stable_step);
  if (run.conversation.fluid) run.limits.fluid_stable = run.conversation.fluid->stable_step;
  if (!(run.limits.solid_stable > 0)) throw std::runtime_error("a solid reports a stable step that is not positive");
}

/// A step that collapses would never reach the end: says what limits it, and stops when it is hopeless.
void watch_step(Run& run) {
  run.first_planned_step = std::max(run.first_planned_step, run.planned_step);
  if (run.planned_step > run.first_planned_step / 20) return;
  std::string solids;
  for (const SolidSide& side : run.conversation.solids)
    solids += fmt::format("{} {:.2e} s, ", side.name, side.stable_step);
  const std::string limits = fmt::format("the window has fallen to {:.2e} s at t = {:.4e} s; stable steps: {}fluid {:.2e} s, lag of fluid loads {:.2e} s",
                                         run.planned_step, run.keeper.time, solids, run.limits.fluid_stable, run.limits.lag_limit);
  if (run.planned_step < run.first_planned_step / 1000) throw std::runtime_error(limits);
  if (!run.step_warned) spdlog::warn("{}", limits);
  run.step_warned = true;
}

void plan_next_span(Run& run) {
  refresh_limits(run);
  const SpanPlan plan = plan_span(run.limits);
  run.planned_step = plan.step;
  run.keeper.windows_left = plan.windows;
  run.keeper.span_start = run.keeper.time;
  watch_step(run);
}

/// Bounds the span by the lag of the fluid's loads on the lightest wall there is.
void bound_lag(Run& run, const geometry::CutCells& cells) {
  const LightestWall wall = lightest_wall(run.conversation, cells);
  const double limit = lag_limit(wall, run.scene);
  if (limit < 0.8 * run.logged_lag_limit) {
    run.logged_lag_limit = limit;
    const geometry::GridLines& grid = run.conversation.fluid->grid;
    const auto position = grid.cell_position(wall.cell);
    spdlog::info("t = {:.4e} s: lag of fluid loads bounds the span to {:.2e} s: {} of {:.3f} kg/m^2 in the cell at ({:.4f}, {:.4f}, {:.4f}) m",
                 run.keeper.time, limit, wall.body == Body::ice ? "ice" : "vehicle", wall.areal_mass,
                 grid.lines[0][position[0]], grid.lines[1][position[1]], grid.lines[2][position[2]]);
  }
  run.limits.lag_limit = std::min(limit, run.slowest_answer);
}

/// Cuts the grid where the solids are now; every hundredth cut is checked against CGAL.
const geometry::CutCells& cut_grid(Run& run) {
  const auto lap = run.watch.lap("overlap");
  const geometry::CutCells& cells = run.overlap->cut(run.conversation);
  if (run.cuts++ % cuts_between_samples == 0) {
    const auto check = run.watch.lap("overlap_check");
    const double difference =
        run.overlap->verify_sample(static_cast<std::uint64_t>(run.scene.run.seed + run.cuts), cells_in_sample);
    if (difference > largest_sample_difference)
      throw std::runtime_error("overlap: the packed cut differs from CGAL's exact cut by " +
                               std::to_string(difference) + " of a cell at t = " + std::to_string(run.keeper.time));
  }
  return cells;
}

void begin(Run& run, const std::vector<std::string>& names) {
  receive_ready(run.conversation, names);
  run.limits.solid_factor = run.scene.run.step_factor;
  run.limits.fluid_factor = run.scene.run.fluid_step_factor;
  run.limits.longest_span = run.scene.run.frame_interval / 100;
  if (run.conversation.fluid) {
    FluidSide& fluid = *run.conversation.fluid;
    run.overlap.emplace(fluid, run.scene.effect("debris_displacement"), run.scene.fluid->atmospheric_pressure);
    const geometry::CutCells& cells = cut_grid(run);
    spdlog::info("first cut: {} cells hold solid, {} loose edges, {} corrected faces", cells.cell.size(),
                 cells.loose_edges, cells.corrected_faces);
    exchange::Message message("begin");
    message.header["time"] = 0.0;
    add_overlap(message, cells);
    if (const SolidSide* ice = run.conversation.find(Body::ice)) run.slowest_answer = ice_share_of_step * ice->stable_step;
    bound_lag(run, cells);
    run.conversation.hub.send(fluid.name, std::move(message));
    const exchange::Message answer = run.conversation.hub.receive(fluid.name, "pressure");
    fluid.stable_step = answer.header.at("stable_step").get<double>();
    fluid.account.set_initial(answer);
  }
  plan_next_span(run);
  run.keeper.step = run.planned_step;
  spdlog::info("first window {:.3e} s, {} windows in the first span; stable: solids {:.3e} s, fluid {:.3e} s, lag {:.3e} s",
               run.keeper.step, run.keeper.windows_left, run.limits.solid_stable, run.limits.fluid_stable,
               run.limits.lag_limit);
  run.monitor.emplace(run.scene, run.folder, run.conversation);
  begin_solids(run.conversation, run.keeper.step);
}

contact::Body as_contact_body(const SolidSide& side) {
  return {side.positions, side.velocities, side.masses, side.radii, side.ids, side.triangles};
}

void find_contact(Run& run) {
  SolidSide* vehicle = run.conversation.find(Body::vehicle);
  SolidSide* ice = run.conversation.find(Body::ice);
  for (SolidSide& side : run.conversation.solids) side.contact_force.assign(3 * side.vertices(), 0.0);
  if (!vehicle || !ice) return;
  const auto lap = run.watch.lap("contact");
  const contact::Body hull = as_contact_body(*vehicle), plate = as_contact_body(*ice);
  const bool first = !run.contact;
  if (first) {
    const contact::ContactLaw law = run.contact_law(hull, plate);
    run.contact.emplace(law);
    spdlog::info("contact: the ice's points against the hull{}{}", law.two_way ? ", the hull's against the ice" : "",
                 law.edges ? ", edges against edges" : "");
  }
  if (first || vehicle->topology_changed || ice->topology_changed) run.contact->set_topology(hull, plate);
  const contact::ContactForces& forces = run.contact->evaluate(hull, plate, run.keeper.step);
  vehicle->contact_force = forces.primary;
  ice->contact_force = forces.secondary;
  run.ledger.contact_stored = forces.stored_energy;
  run.ledger.contact_friction += forces.friction_loss;
  run.ledger.contact_damping += forces.damping_loss;
  run.ledger.contact_released += forces.released_energy;
  run.monitor->note_contact(forces);
}

/// The fluid steps over the span that just ended; its loads act in the next one.
void exchange_with_fluid(Run& run, bool finish, long frame) {
  FluidSide& fluid = *run.conversation.fluid;
  const geometry::CutCells& cells = cut_grid(run);
  const double length = run.keeper.time - run.keeper.span_start;
  exchange::Message message("span");
  message.header["span"] = run.keeper.span;
  message.header["time0"] = run.keeper.span_start;
  message.header["time1"] = run.keeper.time;
  message.header["finish"] = finish;
  message.header["frame"] = frame;
  add_overlap(message, cells);
  run.conversation.hub.send(fluid.name, std::move(message));
  const auto lap = run.watch.lap("fluid_loads");
  const exchange::Message answer = run.conversation.hub.receive(fluid.name, "pressure");
  fluid.stable_step = answer.header.at("stable_step").get<double>();
  fluid.account.update(answer);
  for (SolidSide& side : run.conversation.solids) {
    side.seen_velocity = side.mean_velocity();
    side.restart_mean();
  }
  if (run.keeper.span == 0) {
    // The first span fits the flow of the start to the walls' first motion: no loads come of it, the books open after it.
    fluid.account.set_initial(answer);
    return;
  }
  const WallPressure at_start = read_pressure(answer, "pressure.previous_", run.overlap->before().cell.size());
  const WallPressure at_end = read_pressure(answer, "pressure.", cells.cell.size());
  run.overlap->give_impulses(run.conversation, at_start, at_end, length, run.ledger);
  if (answer.has("pressure.impulse"))
    run.overlap->give_wall_impulses(run.conversation, answer.view<double>("pressure.impulse"), run.ledger);
  if (answer.has("pressure.impedance"))
    run.overlap->set_impedance(run.conversation, answer.view<double>("pressure.impedance"));
  // Where elements broke away, lighter nodes meet the water now.
  if (run.topology_changed) bound_lag(run, cells);
  run.topology_changed = false;
  run.ledger.fluid_reported = {fluid.account.change("impulse_vehicle_z"), fluid.account.change("impulse_ice_z")};
  run.monitor->note_pressure(cells, fluid.grid, at_end);
}

/// Force of the fluid on a vertex that moves otherwise than the fluid has seen: sound carries the difference away.
std::array<double, 3> radiation_force(const SolidSide& side, std::size_t v) {
  const double* z = &side.impedance[6 * v];
  double u[3];
  for (int d = 0; d < 3; ++d) u[d] = side.velocities[3 * v + d] - side.seen_velocity[3 * v + d];
  return {-(z[0] * u[0] + z[3] * u[1] + z[5] * u[2]), -(z[3] * u[0] + z[1] * u[1] + z[4] * u[2]),
          -(z[5] * u[0] + z[4] * u[1] + z[2] * u[2])};
}

/// Takes one window's share of the outstanding fluid impulses as forces of this window. Those loads are old by more than
/// a span, and a wall that oscillates faster would be driven by them. So the change since then is answered at once by the
/// water's impedance; the impulse of it is taken from what is outstanding, and the fluid's own answer replaces it later.
void hand_on_fluid_impulse(Run& run, double acting_time) {
  const double share = 1.0 / static_cast<double>(std::max(1L, run.keeper.windows_left));
  for (SolidSide& side : run.conversation.solids) {
    side.fluid_force.assign(side.fluid_impulse.size(), 0.0);
    for (std::size_t v = 0; v < side.vertices(); ++v) {
      const std::array<double, 3> radiation = radiation_force(side, v);
      for (int d = 0; d < 3; ++d) {
        const std::size_t i = 3 * v + d;
        const double impulse = share * side.fluid_impulse[i] + acting_time * radiation[d];
        side.fluid_impulse[i] -= impulse;
        side.fluid_force[i] = impulse / acting_time;
        run.ledger.fluid_taken[static_cast<int>(side.body)][d] += impulse;
      }
    }
  }
}

void write_ledger(Run& run, double acting_time) {
  std::array<Impulse, body_count> held{};
  for (const SolidSide& side : run.conversation.solids) {
    const int b = static_cast<int>(side.body);
    held[b] = outstanding(side);
    for (std::size_t i = 0; i < side.contact_force.size(); ++i)
      run.ledger.contact_impulse[b][i % 3] += acting_time * side.contact_force[i];
  }
  run.ledger_file.append(run.keeper.time, run.keeper.window, acting_time, run.ledger, held);
}

/// One window of docs/coupling.md: positions, contact, at the end of a span the fluid, loads.
void advance_window(Run& run) {
  {
    const auto lap = run.watch.lap("surfaces");
    receive_surfaces(run.conversation, run.keeper.window);
  }
  run.keeper.time += run.keeper.step;
  for (const SolidSide& side : run.conversation.solids) {
    run.work[static_cast<int>(side.body)].settle(side, run.ledger);
    run.topology_changed = run.topology_changed || side.topology_changed;
  }
  for (SolidSide& side : run.conversation.solids) side.add_to_mean(run.keeper.step);
  find_contact(run);

  long frame = -1;
  if (--run.keeper.windows_left <= 0) {
    run.end = end_reason(run.scene, run.keeper.time, run.monitor->nose(), run.monitor->speed());
    const bool finish = !run.end.empty();
    if (run.keeper.time >= run.next_frame_time || finish) {
      frame = run.frame++;
      run.next_frame_time += run.scene.run.frame_interval;
    }
    if (run.conversation.fluid) exchange_with_fluid(run, finish, frame);
    ++run.keeper.span;
    run.monitor->append_row(run.keeper, run.conversation, run.ledger, run.planned_step);
    plan_next_span(run);
  } else {
    refresh_limits(run);
  }
  const double next = next_step(run.limits, run.planned_step, run.keeper.step);
  const double acting_time = run.keeper.acting_time(next);
  hand_on_fluid_impulse(run, acting_time);
  write_ledger(run, acting_time);
  for (SolidSide& side : run.conversation.solids) run.work[static_cast<int>(side.body)].remember(side, acting_time);
  send_loads(run.conversation, run.keeper.window, next, !run.end.empty(), frame);
  ++run.keeper.window;
  run.keeper.step = next;
}

void write_reports(Run& run, const std::vector<std::pair<std::string, nlohmann::json>>& last_words) {
  nlohmann::json summary = run.monitor->summary(run.keeper, run.conversation, run.ledger);
  summary["end_reason"] = run.end;
  summary["overlap_cuts"] = run.cuts;
  for (const auto& [name, words] : last_words) summary["participants"][name] = words;
  std::ofstream(run.folder + "/coupler_summary.json") << summary.dump(1) << '\n';
  for (const SolidSide& side : run.conversation.solids)
    run.report.seconds["waiting_" + side.name] = run.conversation.hub.waiting_seconds(side.name);
  if (run.conversation.fluid)
    run.report.seconds["waiting_fluid"] = run.conversation.hub.waiting_seconds(run.conversation.fluid->name);
  for (const auto& [heading, seconds] : run.watch.seconds()) run.report.seconds[heading] = seconds;
  run.report.counts["windows"] = static_cast<double>(run.keeper.window);
  run.report.counts["spans"] = static_cast<double>(run.keeper.span);
  run.report.write(run.folder, "coupler");
}

std::vector<std::string> expected_participants(const scene::Scene& scene) {
  std::vector<std::string> names;
  if (scene.vehicle) names.push_back("structure");
  if (scene.ice) names.push_back("ice");
  if (scene.fluid && scene.effect("fluid")) names.push_back("fluid");
  return names;
}

}  // namespace

void run_coupled(const scene::Scene& scene, const std::string& run_folder, const std::string& endpoint,
                 const std::string& run_id, double connect_timeout) {
  const std::vector<std::string> names = expected_participants(scene);
  exchange::Hub hub(endpoint, run_id, names);
  try {
    hub.await_participants(connect_timeout);
    Run run(scene, run_folder, hub);
    begin(run, names);
    while (run.end.empty()) advance_window(run);
    const auto last_words = say_goodbye(run.conversation);
    write_reports(run, last_words);
    spdlog::info("end: {} at t = {:.6e} s after {} windows and {} spans", run.end, run.keeper.time, run.keeper.window,
                 run.keeper.span);
  } catch (const std::exception& error) {
    hub.stop_all(error.what());
    throw;
  }
}

}  // namespace polynya::coupler
