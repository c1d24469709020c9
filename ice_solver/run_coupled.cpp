#include <spdlog/spdlog.h>

#include <algorithm>

#include "ice_solver/account.hpp"
#include "ice_solver/fields.hpp"
#include "ice_solver/ice_surface.hpp"
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

void add_motion_and_account(Message& message, const IceBody& ice, const IceSurface& surface) {
  std::vector<double> positions, velocities;
  vertex_motion(ice, surface.nodes, positions, velocities);
  const auto vertices = static_cast<std::int64_t>(surface.vertex_count());
  message.add<double>("positions", {vertices, 3}, positions);
  message.add<double>("velocities", {vertices, 3}, velocities);
  const std::vector<double> values = account_values(account_of(ice));
  message.add<double>("account", {static_cast<std::int64_t>(values.size())}, values);
}

Message ready_message(const IceBody& ice, const IceSurface& surface) {
  Message ready("ready");
  ready.header["role"] = "solid";
  ready.header["body"] = "ice";
  ready.header["stable_step"] = stable_step(ice);
  ready.header["account"] = account_names();
  add_topology(ready, surface);
  add_motion_and_account(ready, ice, surface);
  return ready;
}

Message surface_message(const IceBody& ice, const IceSurface& surface, long window) {
  Message message("surface");
  message.header["window"] = window;
  message.header["time"] = ice.solid.time;
  message.header["stable_step"] = stable_step(ice);
  message.header["topology_changed"] = ice.topology_changed;
  add_motion_and_account(message, ice, surface);
  if (ice.topology_changed) add_topology(message, surface);
  return message;
}

/// The half of a window after positions are known; returns the length of the next one, 0 to finish.
double finish_window(IceRun& run, exchange::Participant& participant, IceSurface& surface, IceFrames& frames, double dt) {
  {
    const auto lap = run.watch.lap("internal_forces");
    internal_forces(run.ice, dt);
  }
  const Message loads = participant.receive("loads");
  const double next = loads.header.at("next_step").get<double>();
  std::vector<double> node_loads, particle_loads;
  distribute_loads(run.ice, surface, loads.view<std::int64_t>("load.vertices"), loads.view<double>("load.forces"),
                   node_loads, particle_loads);
  {
    const auto lap = run.watch.lap("velocities");
    advance_velocities(run.ice, node_loads, particle_loads, dt, next);
  }
  const int frame = loads.header.at("frame").get<int>();
  if (frame >= 0) {
    const auto lap = run.watch.lap("frames");
    frames.write(frame, run.ice);
  }
  const auto lap = run.watch.lap("conversion");
  const std::size_t converted = convert_failed_elements(run.ice);
  if (converted > 0) {
    if (run.ice.particles.count() == converted) spdlog::info("first particles at t = {:.6e} s", run.ice.solid.time);
    surface = surface_of(run.ice);
  }
  return loads.header.at("finish").get<bool>() ? 0.0 : next;
}

}  // namespace

void run_coupled(IceRun& run, exchange::Participant& participant) {
  IceBody& ice = run.ice;
  IceSurface surface = surface_of(ice);
  IceFrames frames(run.folder);
  participant.send(ready_message(ice, surface));
  double dt = participant.receive("begin").header.at("step").get<double>();
  internal_forces(ice, 0);
  advance_velocities(ice, {}, {}, 0, dt);
  spdlog::info("begins with a step of {:.3e} s", dt);
  for (long window = 0; dt > 0; ++window) {
    advance_positions(ice, dt);
    {
      const auto lap = run.watch.lap("messages");
      participant.send(surface_message(ice, surface, window));
    }
    run.smallest_step = std::min(run.smallest_step, dt);
    ++run.steps;
    dt = finish_window(run, participant, surface, frames, dt);
  }
  Message finished("finished");
  finished.header.update(last_words(run));
  participant.send(finished);
  participant.receive("bye");
}

}  // namespace polynya::ice
