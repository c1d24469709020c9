#include <spdlog/spdlog.h>

#include <algorithm>

#include "core/compute/equal_steps.hpp"
#include "core/compute/threads.hpp"
#include "core/exchange/errors.hpp"
#include "structure_solver/conversation.hpp"
#include "structure_solver/free_flight.hpp"

namespace polynya::structure {
namespace {

std::int64_t rows(std::size_t count) {
  return static_cast<std::int64_t>(count);
}

void add_motion(exchange::Message& message, const VehicleBody& body) {
  const std::size_t n = body.hull_vertices();
  std::vector<double> positions(3 * n), velocities(3 * n);
  body.hull_motion(positions, velocities);
  message.add<double>("positions", {rows(n), 3}, std::move(positions));
  message.add<double>("velocities", {rows(n), 3}, std::move(velocities));
}

void add_account(exchange::Message& message, const Account& account) {
  const auto values = account_values(account);
  message.add<double>("account", {rows(values.size())}, values);
}

/// How long two bodies stay apart is worked out from speeds that go on as they are: not those of a body that turns.
bool moves_straight(const VehicleBody& body) {
  const std::optional<Attitude> attitude = body.attitude();
  return !attitude || attitude->angular_velocity == std::array<double, 3>{};
}

exchange::Message make_ready(const BuiltVehicle& vehicle, const Account& account, double time) {
  exchange::Message ready("ready");
  ready.header["role"] = "solid";
  ready.header["body"] = "vehicle";
  ready.header["stable_step"] = vehicle.body->stable_step();
  ready.header["can_subdivide"] = moves_straight(*vehicle.body);
  ready.header["can_checkpoint"] = true;
  ready.header["time"] = time;
  for (const AccountEntry& entry : account_entries) ready.header["account"].push_back(std::string(entry.name));
  add_account(ready, account);
  const std::size_t n = vehicle.mesh.hull_nodes.size();
  std::vector<std::int64_t> ids(vehicle.mesh.hull_nodes.begin(), vehicle.mesh.hull_nodes.end());
  std::vector<double> masses;
  for (const std::int32_t node : vehicle.mesh.hull_nodes) masses.push_back(vehicle.node_masses[node]);
  const std::vector<double> zeros(n, 0.0);
  ready.add<std::int64_t>("surface.ids", {rows(n)}, ids);
  ready.add<double>("surface.masses", {rows(n)}, masses);
  ready.add<std::int32_t>("surface.triangles", {rows(vehicle.mesh.hull_triangles.size() / 3), 3},
                          vehicle.mesh.hull_triangles);
  ready.add<double>("surface.radius", {rows(n)}, zeros);
  ready.add<double>("surface.volume", {rows(n)}, zeros);
  if (const std::vector<double> rigid = vehicle.body->rigid_masses(); !rigid.empty())
    ready.add<double>("surface.rigid_masses", {rows(n)}, rigid);
  add_motion(ready, *vehicle.body);
  return ready;
}

/// Spreads the loads of a message over all hull vertices.
void read_loads(const exchange::Message& loads, std::vector<double>& hull_force) {
  std::fill(hull_force.begin(), hull_force.end(), 0.0);
  const auto vertices = loads.view<std::int64_t>("load.vertices");
  const auto forces = loads.view<double>("load.forces");
  if (forces.size() != 3 * vertices.size())
    throw exchange::ProtocolError("message '" + loads.kind() +
                                  "': array 'load.forces' does not hold three values per vertex");
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (vertices[i] < 0 || 3 * static_cast<std::size_t>(vertices[i]) >= hull_force.size())
      throw exchange::ProtocolError("message '" + loads.kind() + "': array 'load.vertices' names vertex " +
                                    std::to_string(vertices[i]) + ", the hull has " +
                                    std::to_string(hull_force.size() / 3));
    for (int c = 0; c < 3; ++c) hull_force[3 * vertices[i] + c] += forces[3 * i + c];
  }
}

exchange::Message make_surface(long window, double time, const VehicleBody& body, const Account& account) {
  exchange::Message surface("surface");
  surface.header["window"] = window;
  surface.header["time"] = time;
  surface.header["stable_step"] = body.stable_step();
  surface.header["can_subdivide"] = moves_straight(body);
  surface.header["topology_changed"] = false;
  add_motion(surface, body);
  add_account(surface, account);
  return surface;
}

double positive_step(const exchange::Message& message, const char* key) {
  const double step = message.header.value(key, 0.0);
  if (!(step > 0))
    throw exchange::ProtocolError("message '" + message.kind() + "': header '" + key + "' must be a positive number");
  return step;
}

/// Steps of a free window but for its last one, whose length is returned: no loads, and no messages.
double advance_freely(VehicleBody& body, double step, double left, double step_factor, double& time, Output& output) {
  while (left > 0) {
    const double next = compute::equal_step(left, step_factor * body.stable_step());
    time += step;
    step_freely(body, step, next, time, output);
    left -= next;
    step = next;
  }
  return step;
}

/// What goes on from window to window.
struct Course {
  VehicleBody& body;
  Output& output;
  double time = 0, dt = 0;  ///< s
  long window = 0;          ///< the next one
  Account account;

  void list_state(compute::StateArchive& archive) {
    archive.item("body", body);
    archive.item("time", time), archive.item("dt", dt), archive.item("window", window);
    archive.item("account", account);
    archive.item("output", output);  // last: it shortens files
  }
};

/// From `ready` to the first half step; returns its length.
double begin(BuiltVehicle& vehicle, exchange::Participant& coupler, Output& output, std::vector<double>& hull_force) {
  VehicleBody& body = *vehicle.body;
  exchange::Message begin;
  {
    const auto lap = output.watch().lap("messages");
    coupler.send(make_ready(vehicle, body.account(), 0));
    begin = coupler.receive("begin");
  }
  const double dt = positive_step(begin, "step");
  read_loads(begin, hull_force);
  if (!begin.view<std::int64_t>("load.vertices").empty()) {
    const auto lap = output.watch().lap("equilibrium");
    body.settle(hull_force);
  }
  body.internal_forces(0);
  body.finish_step(hull_force, 0, dt);
  return dt;
}

/// Before the first window: from the start, or from a checkpoint.
void start(BuiltVehicle& vehicle, exchange::Participant& coupler, Course& course,
           const results::Checkpoints& checkpoints, std::vector<double>& hull_force) {
  if (!checkpoints.resuming()) {
    course.dt = begin(vehicle, coupler, course.output, hull_force);
    course.account = course.body.account();
    return;
  }
  if (const std::string remark = checkpoints.load(course); !remark.empty()) spdlog::warn("{}", remark);
  spdlog::info("goes on at t = {:.6e} s, window {}", course.time, course.window);
  coupler.send(make_ready(vehicle, course.account, course.time));
  coupler.receive("begin");
}

/// Positions at the end of the window go to the coupler; returns its answer. Internal forces are computed meanwhile.
exchange::Message exchange_window(Course& course, exchange::Participant& coupler, std::vector<double>& hull_force) {
  compute::Stopwatch& watch = course.output.watch();
  {
    const auto lap = watch.lap("positions");
    course.body.advance_positions(course.dt);
    course.time += course.dt;
  }
  {
    const auto lap = watch.lap("messages");
    coupler.send(make_surface(course.window, course.time, course.body, course.account));
  }
  {
    const auto lap = watch.lap("internal_forces");
    course.body.internal_forces(course.dt);
  }
  const auto lap = watch.lap("messages");
  exchange::Message loads = coupler.receive("loads");
  read_loads(loads, hull_force);
  return loads;
}

/// Velocities by the loads, what is written of the window, and the steps of a free one but for its last.
void finish_window(Course& course, const exchange::Message& loads, double step_factor,
                   const std::vector<double>& hull_force) {
  compute::Stopwatch& watch = course.output.watch();
  const bool finish = loads.header.value("finish", false), free = loads.header.value("free", false);
  const double next = finish ? loads.header.value("next_step", course.dt) : positive_step(loads, "next_step");
  const double first = free ? compute::equal_step(next, step_factor * course.body.stable_step()) : next;
  {
    const auto lap = watch.lap("velocities");
    course.body.finish_step(hull_force, course.dt, first);
  }
  {
    const auto lap = watch.lap("account");
    course.account = course.body.account();
  }
  course.output.record(course.time, course.dt, course.account);
  if (const int frame = loads.header.value("frame", -1); frame >= 0) course.output.write_frame(frame, course.time);
  course.dt = first;
  if (!free) return;
  course.dt = advance_freely(course.body, first, next - first, step_factor, course.time, course.output);
  course.account = course.body.account();
}

void say_goodbye(exchange::Participant& coupler, Output& output) {
  exchange::Message finished("finished");
  finished.header.update(output.summary());
  const auto lap = output.watch().lap("messages");
  coupler.send(finished);
  coupler.receive("bye");
  spdlog::info("finished: {}", output.summary().dump());
}

}  // namespace

void run_coupled(BuiltVehicle& vehicle, double step_factor, exchange::Participant& coupler, Output& output,
                 const results::Checkpoints& checkpoints) {
  Course course{.body = *vehicle.body, .output = output, .account = vehicle.body->account()};
  std::vector<double> hull_force(3 * vehicle.body->hull_vertices());
  start(vehicle, coupler, course, checkpoints, hull_force);
  for (;;) {
    const exchange::Message loads = exchange_window(course, coupler, hull_force);
    compute::use_threads(loads.header.value("threads", 0));
    finish_window(course, loads, step_factor, hull_force);
    if (loads.header.value("finish", false)) break;
    ++course.window;
    if (const auto folder = loads.header.value("checkpoint", std::string{}); !folder.empty() && checkpoints.active()) {
      const auto lap = output.watch().lap("checkpoints");
      checkpoints.save(folder, course.window, course.time, course);
    }
  }
  say_goodbye(coupler, output);
}

}  // namespace polynya::structure
