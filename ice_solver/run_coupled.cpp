#include <spdlog/spdlog.h>

#include <algorithm>

#include "core/compute/equal_steps.hpp"
#include "core/compute/threads.hpp"
#include "ice_solver/account.hpp"
#include "ice_solver/ice_surface.hpp"
#include "ice_solver/last_good.hpp"
#include "ice_solver/run.hpp"

namespace polynya::ice {
namespace {

using exchange::Message;

void add_topology(Message& message, const IceSurface& surface) {
  const auto vertices = static_cast<std::int64_t>(surface.vertex_count());
  message.add<std::int64_t>("surface.ids", {vertices}, surface.ids);
  message.add<double>("surface.masses", {vertices}, surface.masses);
  message.add<std::int32_t>("surface.triangles", {static_cast<std::int64_t>(surface.triangles.size() / 3), 3},
                            surface.triangles);
  message.add<double>("surface.radius", {vertices}, surface.radii);
  message.add<double>("surface.volume", {vertices}, surface.volumes);
}

void add_motion_and_account(Message& message, IceBody& ice, const IceSurface& surface) {
  std::vector<double> positions, velocities;
  vertex_motion(ice, surface.nodes, positions, velocities);
  const auto vertices = static_cast<std::int64_t>(surface.vertex_count());
  message.add<double>("positions", {vertices, 3}, std::move(positions));
  message.add<double>("velocities", {vertices, 3}, std::move(velocities));
  const auto lap = ice.watch.lap("account");
  message.header["stable_step"] = stable_step(ice);
  const std::vector<double> values = account_values(account_of(ice));
  message.add<double>("account", {static_cast<std::int64_t>(values.size())}, values);
}

Message ready_message(IceBody& ice, const IceSurface& surface) {
  Message ready("ready");
  ready.header["role"] = "solid";
  ready.header["body"] = "ice";
  ready.header["can_subdivide"] = true;
  ready.header["can_checkpoint"] = true;
  ready.header["time"] = ice.solid.time;
  ready.header["account"] = account_names();
  add_topology(ready, surface);
  add_motion_and_account(ready, ice, surface);
  return ready;
}

Message surface_message(IceBody& ice, const IceSurface& surface, long window) {
  Message message("surface");
  message.header["window"] = window;
  message.header["time"] = ice.solid.time;
  message.header["topology_changed"] = ice.topology_changed;
  add_motion_and_account(message, ice, surface);
  if (ice.topology_changed) add_topology(message, surface);
  return message;
}

void convert(IceRun& run, IceSurface& surface) {
  const std::size_t converted = convert_failed_elements(run.ice);
  if (converted == 0) return;
  const auto lap = run.ice.watch.lap("conversion");
  if (run.ice.particles.count() == converted) spdlog::info("first particles at t = {:.6e} s", run.ice.solid.time);
  surface = surface_of(run.ice);
}

void note_step(IceRun& run, double dt) {
  run.smallest_step = std::min(run.smallest_step, dt);
  ++run.steps;
}

double own_step(const IceRun& run, double left) {
  return compute::equal_step(left, run.scene.run.step_factor * stable_step(run.ice));
}

/// What goes on from window to window.
struct Course {
  IceRun& run;
  IceSurface surface;
  double dt = 0;    ///< s
  long window = 0;  ///< the next one
  IceFrames frames;
  std::vector<double> node_loads, particle_loads;  ///< N; of nodes only while they act
  LastGood last_good = {};

  POLYNYA_STATE_WITHOUT((node_loads, particle_loads, last_good), run, surface, dt, window, frames, node_loads,
                        particle_loads, last_good)
};

/// Steps of a free window but for its last one, whose length is returned: no loads, and no messages.
double advance_freely(Course& course, double step, double left) {
  IceRun& run = course.run;
  bool changed = run.ice.topology_changed;
  while (left > 0) {
    const double next = own_step(run, left);
    advance_positions(run.ice, step);
    course.last_good.internal_forces(run.ice, step, course.frames);
    advance_velocities(run.ice, {}, {}, step, next);
    convert(run, course.surface);
    changed = changed || run.ice.topology_changed;
    note_step(run, step);
    left -= next;
    step = next;
  }
  run.ice.topology_changed = changed;
  return step;
}

/// What remains of a window after its positions are known, and of the next one, if it is free, all but the last step;
/// returns the length of the step that comes now, 0 to finish, and the
/// folder of the checkpoint that is wanted before it.
double finish_window(Course& course, exchange::Participant& participant, std::string& checkpoint) {
  auto& [run, surface, dt, window, frames, node_loads, particle_loads, last_good] = course;
  last_good.internal_forces(run.ice, dt, frames);
  Message loads;
  {
    const auto lap = run.ice.watch.lap("messages");
    loads = participant.receive("loads");
    distribute_loads(run.ice, surface, loads.view<std::int64_t>("load.vertices"), loads.view<double>("load.forces"),
                     node_loads, particle_loads);
  }
  compute::use_threads(loads.header.value("threads", 0));
  const double length = loads.header.at("next_step").get<double>();
  const bool free = loads.header.value("free", false);
  const double next = free ? own_step(run, length) : length;
  advance_velocities(run.ice, node_loads, particle_loads, dt, next);
  take_back_loads(surface, loads.view<std::int64_t>("load.vertices"), node_loads);
  const int frame = loads.header.at("frame").get<int>();
  if (frame >= 0) {
    const auto lap = run.ice.watch.lap("frames");
    frames.write(frame, run.ice);
  }
  convert(run, surface);
  if (loads.header.at("finish").get<bool>()) return 0;
  checkpoint = loads.header.value("checkpoint", std::string{});
  return free ? advance_freely(course, next, length - next) : next;
}

/// From `ready` to the first half step.
void begin(Course& course, exchange::Participant& participant) {
  IceBody& ice = course.run.ice;
  course.surface = surface_of(ice);
  std::vector<double> node_loads, particle_loads;
  {
    const auto lap = ice.watch.lap("messages");
    participant.send(ready_message(ice, course.surface));
    const Message begin = participant.receive("begin");
    course.dt = begin.header.at("step").get<double>();
    distribute_loads(ice, course.surface, begin.view<std::int64_t>("load.vertices"), begin.view<double>("load.forces"),
                     node_loads, particle_loads);
  }
  if (course.run.scene.ice->start == "equilibrium" && !node_loads.empty()) {
    const auto lap = ice.watch.lap("equilibrium");
    const auto report = settle(ice, node_loads);
    spdlog::info("starts in equilibrium, to {:.1e} N at a node: {} {}", report.imbalance, report.iterations,
                 report.method == continuum::EquilibriumMethod::newton ? "corrections of Newton's method"
                                                                       : "steps of relaxation");
  }
  internal_forces(ice, 0);
  advance_velocities(ice, node_loads, particle_loads, 0, course.dt);
  spdlog::info("begins with a step of {:.3e} s", course.dt);
}

void go_on(Course& course, exchange::Participant& participant) {
  const results::Checkpoints checkpoints = course.run.checkpoints;
  if (const std::string remark = checkpoints.load(course); !remark.empty()) spdlog::warn("{}", remark);
  spdlog::info("goes on at t = {:.6e} s, window {}", course.run.ice.solid.time, course.window);
  participant.send(ready_message(course.run.ice, course.surface));
  participant.receive("begin");
}

}  // namespace

void run_coupled(IceRun& run, exchange::Participant& participant) {
  IceBody& ice = run.ice;
  Course course{.run = run, .surface = {}, .frames = IceFrames(run.folder), .node_loads = {}, .particle_loads = {}};
  if (run.checkpoints.resuming())
    go_on(course, participant);
  else
    begin(course, participant);
  course.last_good.keep(ice);
  while (course.dt > 0) {
    advance_positions(ice, course.dt);
    {
      const auto lap = ice.watch.lap("messages");
      participant.send(surface_message(ice, course.surface, course.window));
    }
    note_step(run, course.dt);
    std::string checkpoint;
    course.dt = finish_window(course, participant, checkpoint);
    ++course.window;
    if (checkpoint.empty() || !run.checkpoints.active()) continue;
    const auto lap = ice.watch.lap("checkpoints");
    run.checkpoints.save(checkpoint, course.window, ice.solid.time, course);
  }
  Message finished("finished");
  finished.header.update(last_words(run));
  const auto lap = ice.watch.lap("messages");
  participant.send(finished);
  participant.receive("bye");
}

}  // namespace polynya::ice
