#include "coupler/coupled_run.hpp"

#include <spdlog/spdlog.h>

#include <cmath>
#include <fstream>

#include "core/compute/threads.hpp"
#include "core/exchange/errors.hpp"
#include "core/results/durable_file.hpp"
#include "core/results/process_report.hpp"
#include "coupler/checkpointing.hpp"
#include "coupler/conversation.hpp"
#include "coupler/end_condition.hpp"
#include "coupler/handed_loads.hpp"
#include "coupler/pacing.hpp"
#include "coupler/recording.hpp"
#include "coupler/run_state.hpp"
#include "coupler/stability_limits.hpp"

namespace polynya::coupler {
namespace {

constexpr long cuts_between_samples = 100;  // every 100 cuts a seeded sample is recut by CGAL
constexpr std::size_t cells_in_sample = 8;
constexpr double largest_sample_difference = 1e-10;

void make_overlap(Run& run) {
  run.overlap.emplace(*run.conversation.fluid, run.scene.effect("debris_displacement"),
                      run.scene.fluid->atmospheric_pressure, run.scene.overlap.method == "exact");
}

/// Cuts the grid where the solids are now.
const geometry::CutCells& cut_grid(Run& run) {
  ++run.cuts;
  return run.overlap->cut(run.conversation, run.watch);
}

/// Compares every hundredth cut with CGAL's.
void check_cut(Run& run) {
  if (run.cuts % cuts_between_samples != 1) return;
  const auto lap = run.watch.lap("overlap_check");
  const double difference =
      run.overlap->verify_sample(static_cast<std::uint64_t>(run.scene.run.seed + run.cuts), cells_in_sample);
  if (difference > largest_sample_difference)
    throw std::runtime_error("overlap: the packed cut differs from CGAL's exact cut by " + std::to_string(difference) +
                             " of a cell at t = " + std::to_string(run.keeper.time));
}

void check_following(const scene::Scene& scene, const FluidSide& fluid) {
  if (scene.fluid->grid_follows == "vehicle" && !fluid.grid_follows)
    throw exchange::ProtocolError("participant '" + fluid.name +
                                  "': fluid.grid_follows is vehicle, but its 'ready' has no header 'grid_shift'; the "
                                  "program's grid must move, or the scene's stay");
}

void begin(Run& run, const std::vector<std::string>& names) {
  const auto lap = run.watch.lap("messages");
  receive_ready(run.conversation, names);
  run.limits.solid_factor = run.scene.run.step_factor;
  run.limits.fluid_factor = run.scene.run.fluid_step_factor;
  run.limits.longest_span = run.scene.run.frame_interval / 100;
  if (run.conversation.fluid) {
    FluidSide& fluid = *run.conversation.fluid;
    check_following(run.scene, fluid);
    make_overlap(run);
    const geometry::CutCells& cells = cut_grid(run);
    check_cut(run);
    spdlog::info("first cut: {} cells hold solid, {} loose edges, {} corrected faces", cells.cell.size(),
                 cells.loose_edges, cells.corrected_faces);
    exchange::Message message("begin");
    message.header["time"] = 0.0;
    add_overlap(message, cells, fluid.grid);
    bound_lag(run, cells);
    run.conversation.hub.send(fluid.name, std::move(message));
    run.overlap->prepare();
    const exchange::Message answer = run.conversation.hub.receive(fluid.name, "pressure");
    fluid.read_answer_header(answer);
    fluid.account.set_initial(answer);
    run.overlap->set_start_forces(run.conversation, read_pressure(answer, "pressure.", cells));
  }
  plan_next_span(run);
  run.keeper.step = run.keeper.length = run.planned_step;
  spdlog::info(
      "first window {:.3e} s, {} windows in the first span; stable: solids {:.3e} s, fluid {:.3e} s, lag {:.3e} s",
      run.keeper.step, run.keeper.windows_left, run.limits.solid_stable, run.limits.fluid_stable, run.limits.lag_limit);
  run.monitor.emplace(run.scene, run.folder, run.conversation);
  begin_balance(run, names);
  begin_solids(run.conversation, run.keeper.step);
  // The first half step happens with the message, so its impulse is given and taken at once.
  for (const SolidSide& side : run.conversation.solids) {
    const int body = static_cast<int>(side.body);
    for (std::size_t i = 0; i < side.start_force.size(); ++i)
      for (auto* entry : {&run.ledger.fluid_given, &run.ledger.fluid_start, &run.ledger.fluid_taken})
        (*entry)[body][i % 3] += 0.5 * run.keeper.step * side.start_force[i];
  }
}

/// Goes on from a checkpoint, as the participants do.
void go_on(Run& run, const std::vector<std::string>& names) {
  const auto lap = run.watch.lap("messages");
  receive_ready(run.conversation, names);
  if (run.conversation.fluid) make_overlap(run);
  run.monitor.emplace(run.scene, run.folder, run.conversation, results::Opening::continued);
  load_checkpoint(run);
  begin_balance(run, names);
  for (const std::string& name : names) {
    exchange::Message message("begin");
    message.header["time"] = run.keeper.time;
    message.header["step"] = run.keeper.length;
    run.conversation.hub.send(name, std::move(message));
  }
}

contact::Body as_contact_body(const SolidSide& side) {
  const bool rigid = !side.rigid_masses.empty();
  return {side.positions, side.velocities, rigid ? side.rigid_masses : side.masses, side.radii, side.ids, side.triangles, rigid};
}

/// The fluid computes meanwhile, where there is one.
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

/// Lets the fluid step over the span that just ended.
void send_span(Run& run, long frame) {
  FluidSide& fluid = *run.conversation.fluid;
  if (fluid.grid_follows) {
    fluid.move_grid(run.keeper.time - run.keeper.span_start);
    run.overlap->move_grid(fluid.grid);
  }
  const geometry::CutCells& cells = cut_grid(run);
  const auto lap = run.watch.lap("messages");
  exchange::Message message("span");
  message.header["span"] = run.keeper.span;
  message.header["time0"] = run.keeper.span_start;
  message.header["time1"] = run.keeper.time;
  message.header["finish"] = !run.end.empty();
  message.header["frame"] = frame;
  if (fluid.grid_follows) message.header["grid_shift"] = fluid.grid_shift;
  if (!run.checkpoint.empty()) message.header["checkpoint"] = run.checkpoint;
  if (const int threads = std::exchange(fluid.new_threads, 0)) message.header["threads"] = threads;
  add_overlap(message, cells, fluid.grid);
  run.conversation.hub.send(fluid.name, std::move(message));
}

/// The fluid computes meanwhile.
void prepare_loads(Run& run) {
  const auto lap = run.watch.lap("fluid_loads");
  run.overlap->prepare();
  if (run.keeper.span == 0 || !run.topology_changed) return;
  // Where elements broke away, lighter nodes meet the water now.
  bound_lag(run, run.overlap->now());
  run.topology_changed = false;
}

exchange::Message receive_pressure(Run& run) {
  exchange::Message answer;
  {
    const auto lap = run.watch.lap("messages");
    answer = run.conversation.hub.receive(run.conversation.fluid->name, "pressure");
  }
  fluid_has_answered(run);
  return answer;
}

/// What the fluid answers to the span that just ended; its loads act in the next one.
void take_fluid_loads(Run& run, const exchange::Message& answer) {
  const auto lap = run.watch.lap("fluid_loads");
  FluidSide& fluid = *run.conversation.fluid;
  const geometry::CutCells& cells = run.overlap->now();
  const double length = run.keeper.time - run.keeper.span_start;
  fluid.read_answer_header(answer);
  fluid.account.update(answer);
  for (SolidSide& side : run.conversation.solids) {
    side.seen_velocity = side.mean_velocity();
    side.restart_mean();
  }
  FluidAnswer given = read_answer(answer, run.overlap->walls_before(), run.overlap->walls(), fluid.forecasts);
  if (run.keeper.span == 0) {
    // The first span fits the flow of the start to the walls' first motion: no loads come of it but what is expected of
    // the next one, and the books open after it.
    fluid.account.set_initial(answer);
    given.impulse = {};
    run.overlap->take(run.conversation, given, 0.0, run.ledger);
    return;
  }
  run.overlap->take(run.conversation, given, length, run.ledger);
  run.ledger.fluid_reported = {fluid.account.change("impulse_vehicle_z"), fluid.account.change("impulse_ice_z")};
  run.monitor->note_pressure(cells, fluid.grid, given.at_end.value);
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

/// Positions at the end of the window, and what follows from the motion over it.
void take_surfaces(Run& run) {
  {
    const auto lap = run.watch.lap("messages");
    receive_surfaces(run.conversation, run.keeper.window);
  }
  solids_have_answered(run);
  const auto lap = run.watch.lap("ledger");
  run.keeper.time += run.keeper.length;
  for (SolidSide& side : run.conversation.solids) {
    run.topology_changed = run.topology_changed || side.topology_changed;
    side.add_to_mean(run.keeper.length);
  }
}

/// Whether the run ends with this span; the number of the frame to write now, -1 for none.
long end_or_frame(Run& run) {
  run.end = end_reason(run.scene, run.keeper.time, run.monitor->nose(), run.monitor->speed());
  if (run.keeper.time < run.next_frame_time && run.end.empty()) return -1;
  run.next_frame_time += run.scene.run.frame_interval;
  return run.frame++;
}

/// The solids work on meanwhile.
void keep_books(Run& run, double acting_time) {
  const auto lap = run.watch.lap("ledger");
  for (const SolidSide& side : run.conversation.solids) run.work[static_cast<int>(side.body)].settle(side, run.ledger);
  write_ledger(run, acting_time);
  for (const SolidSide& side : run.conversation.solids)
    run.work[static_cast<int>(side.body)].remember(side, acting_time);
}

/// Hands out the loads of this window and the length of the next one.
void give_loads(Run& run, bool span_ends, long frame) {
  const double next = next_step(run.limits, run.planned_step, run.keeper.step);
  const double length = next_length(run, next, span_ends);
  // In a free window the solids are past the time of the coupler when they would write.
  if (length > next || run.fitted_to_end) run.checkpoint.clear();
  const double acting_time = run.keeper.acting_time(next);
  {
    const auto lap = run.watch.lap("fluid_loads");
    for (SolidSide& side : run.conversation.solids) {
      const Impulse handed = hand_on_fluid_loads(side, acting_time);
      for (std::size_t d = 0; d < 3; ++d) run.ledger.fluid_taken[static_cast<int>(side.body)][d] += handed[d];
    }
  }
  {
    const auto lap = run.watch.lap("messages");
    send_loads(run.conversation, {run.keeper.window, length, length > next, !run.end.empty(), frame, run.checkpoint});
  }
  keep_books(run, acting_time);
  ++run.keeper.window;
  run.keeper.step = next;
  run.keeper.length = length;
}

/// One window of docs/coupling.md: positions, at the end of a span the fluid, contact, loads.
void advance_window(Run& run) {
  take_surfaces(run);
  const bool span_ends = --run.keeper.windows_left <= 0;
  const bool fluid_steps = span_ends && run.conversation.fluid;
  const long frame = span_ends ? end_or_frame(run) : -1;
  if (span_ends) choose_checkpoint(run);
  if (fluid_steps) send_span(run, frame);
  find_contact(run);
  if (fluid_steps) {
    check_cut(run);
    prepare_loads(run);
    take_fluid_loads(run, receive_pressure(run));
  }
  if (span_ends) {
    const auto lap = run.watch.lap("ledger");
    ++run.keeper.span;
    balance_threads(run);
    run.monitor->append_row(run.keeper, run.conversation, run.ledger, run.planned_step);
    plan_next_span(run);
  } else {
    refresh_limits(run);
  }
  give_loads(run, span_ends, frame);
  write_checkpoint(run);
}

std::vector<std::pair<std::string, nlohmann::json>> part(Run& run) {
  const auto lap = run.watch.lap("messages");
  return say_goodbye(run.conversation);
}

/// When the grid was cut: what of the critical path is geometry (docs/coupling.md).
void write_times_of_cuts(const Run& run) {
  std::string text = "from [s],to [s]\n";
  for (const auto& [from, to] : run.overlap->times()) text += fmt::format("{:.9f},{:.9f}\n", from, to);
  results::replace_text(run.folder + "/logs/coupler_cuts.csv", text);
}

void write_reports(Run& run, const std::vector<std::pair<std::string, nlohmann::json>>& last_words) {
  nlohmann::json summary = run.monitor->summary(run.keeper, run.conversation, run.ledger);
  summary["end_reason"] = run.end;
  summary["overlap_cuts"] = run.cuts;
  if (run.overlap) {
    const OverlapExchange::Counts& cut = run.overlap->counts();
    summary["overlap_cells"] = cut.cells;
    summary["overlap_cells_exact"] = cut.exact;
    summary["overlap_cells_two_bodies"] = cut.shared;
    summary["overlap_cells_united"] = cut.united;
    summary["overlap_cells_united_exactly"] = cut.united_exactly;
    summary["overlap_cells_doubted"] = cut.doubted;
    summary["overlap_triangles_kept"] = cut.kept;
  }
  for (const auto& [name, words] : last_words) summary["participants"][name] = words;
  std::ofstream(run.folder + "/coupler_summary.json") << summary.dump(1) << '\n';
  results::ProcessReport report;
  for (const auto& [name, words] : last_words) report.waits[name] = run.conversation.hub.waits(name).intervals();
  report.set_headings(run.watch.seconds(), run.watch.cpu_seconds());
  report.threads = compute::threads();
  report.counts["windows"] = static_cast<double>(run.keeper.window);
  report.counts["free_windows"] = static_cast<double>(run.keeper.free_windows);
  report.counts["spans"] = static_cast<double>(run.keeper.span);
  report.write(run.folder, "coupler");
  if (run.overlap) write_times_of_cuts(run);
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
                 const std::string& run_id, double connect_timeout, const results::Checkpoints& checkpoints) {
  const std::vector<std::string> names = expected_participants(scene);
  exchange::Hub hub(endpoint, run_id, names);
  const auto recorder = start_recorder(scene, run_folder, run_id, hub);
  try {
    hub.await_participants(connect_timeout);
    Run run(scene, run_folder, hub, checkpoints);
    if (checkpoints.resuming())
      go_on(run, names);
    else
      begin(run, names);
    begin_checkpoints(run);
    while (run.end.empty()) advance_window(run);
    const auto last_words = part(run);
    if (recorder) finish_recorder(*recorder);
    write_reports(run, last_words);
    spdlog::info("end: {} at t = {:.6e} s after {} windows and {} spans", run.end, run.keeper.time, run.keeper.window,
                 run.keeper.span);
  } catch (const std::exception& error) {
    hub.stop_all(error.what());
    throw;
  }
}

}  // namespace polynya::coupler
