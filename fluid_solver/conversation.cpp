#include "fluid_solver/conversation.hpp"

#include <spdlog/spdlog.h>

#include "core/compute/threads.hpp"
#include "core/exchange/errors.hpp"
#include "fluid_solver/overlap_message.hpp"
#include "fluid_solver/wall_forecast.hpp"

namespace polynya::fluid {
namespace {

std::int64_t rows(std::size_t count) {
  return static_cast<std::int64_t>(count);
}

exchange::Message make_ready(const Fluid& fluid) {
  exchange::Message ready("ready");
  ready.header["role"] = "fluid";
  ready.header["can_checkpoint"] = true;
  ready.header["forecasts"] = true;
  ready.header["time"] = fluid.time;
  ready.header["stable_step"] = stable_step(fluid);
  ready.header["account"] = account_names();
  const auto values = account_values(fluid.account);
  ready.add<double>("account", {rows(values.size())}, values);
  ready.add<double>("grid.x", {rows(fluid.grid.x.size())}, fluid.grid.x);
  ready.add<double>("grid.y", {rows(fluid.grid.y.size())}, fluid.grid.y);
  const std::vector<double>& first = fluid.motion.first_line[2];  // which the shift counts from
  ready.add<double>("grid.z", {rows(first.size())}, first);
  if (fluid.motion.follows) ready.header["grid_shift"] = fluid.motion.displaced[2][0];
  return ready;
}

void add_pressure(exchange::Message& message, const Fluid& fluid, const Overlap& overlap, const std::string& prefix) {
  std::vector<double> value, gradient;
  overlap_pressure(fluid, overlap.walled, value, gradient);
  const std::int64_t count = rows(value.size());
  message.add<double>(prefix + "values", {count}, std::move(value));
  message.add<double>(prefix + "gradient_z", {count}, std::move(gradient));
}

exchange::Message make_pressure(Fluid& fluid, const Overlap& overlap) {
  exchange::Message message("pressure");
  {
    const auto lap = fluid.watch.lap("account");
    message.header["stable_step"] = stable_step(fluid);
    if (fluid.motion.follows) message.header["grid_speed"] = fluid.motion.speed[2][1];
  }
  add_pressure(message, fluid, overlap, "pressure.");
  const auto values = account_values(fluid.account);
  message.add<double>("account", {rows(values.size())}, values);
  return message;
}

void start(const scene::Scene& scene, Fluid& fluid, const Overlap& overlap) {
  fill_hydrostatic(fluid, overlap, scene.fluid->waterline);
  if (scene.fluid->start == "potential_flow") {
    const int iterations = start_potential_flow(fluid);
    spdlog::info("potential flow: {} iterations, kinetic energy {:.6g} J", iterations, fluid.account.kinetic);
  }
  if (fluid.motion.follows) follow_vehicle(fluid);
  spdlog::info("start: water {:.9g} kg, air {:.9g} kg, stable step {:.3e} s, {} groups of cut cells",
               fluid.account.mass[water], fluid.account.mass[air], stable_step(fluid), fluid.groups.count());
}

void add_impulse_and_forecast(exchange::Message& message, Fluid& fluid, const Overlap& overlap, double dt) {
  std::vector<double> impulse;
  impulse.reserve(6 * overlap.walled.size());
  std::size_t piece = 0;
  for (const std::int64_t number : overlap.walled) {
    const std::ptrdiff_t cell = fluid.grid.from_message(number);
    while (fluid.after.walls[piece].cell != cell) ++piece;  // both ascend, and cells without wall have a piece as well
    for (const auto& body : fluid.wall_impulse[piece]) impulse.insert(impulse.end(), body.begin(), body.end());
  }
  const std::int64_t count = rows(overlap.walled.size());
  message.add<double>("pressure.impulse", {count, 2, 3}, std::move(impulse));
  WallForecast forecast = forecast_walls(fluid, overlap.walled, dt);
  message.add<double>("pressure.forecast", {count}, std::move(forecast.pressure));
  message.add<double>("pressure.impedance", {count}, std::move(forecast.impedance));
}

double positive_span(const exchange::Message& message, double time) {
  const double span = message.header.value("time1", 0.0) - time;
  if (!(span > 0)) throw exchange::ProtocolError("message 'span': header 'time1' must be later than the fluid's time");
  return span;
}

double grid_shift(const exchange::Message& message) {
  if (!message.header.contains("grid_shift"))
    throw exchange::ProtocolError("message 'span': header 'grid_shift' is missing; the grid follows the vehicle");
  return message.header.at("grid_shift").get<double>();
}

/// What goes on from span to span.
struct Course {
  Fluid& fluid;
  Overlap& overlap;  ///< the one sent last
  Output& output;

  POLYNYA_STATE(fluid, overlap, output)  // the output last: it shortens files
};

/// From `ready` to the pressure at time 0.
void begin(const scene::Scene& scene, Course& course, exchange::Participant& coupler) {
  Fluid& fluid = course.fluid;
  fill_hydrostatic(fluid, {}, scene.fluid->waterline);
  {
    const auto lap = fluid.watch.lap("messages");
    coupler.send(make_ready(fluid));
    course.overlap = read_overlap(coupler.receive("begin"), fluid.grid);
  }
  {
    const auto lap = fluid.watch.lap("start");
    start(scene, fluid, course.overlap);
  }
  const auto lap = fluid.watch.lap("messages");
  coupler.send(make_pressure(fluid, course.overlap));
}

void go_on(Course& course, exchange::Participant& coupler, const results::Checkpoints& checkpoints) {
  if (const std::string remark = checkpoints.load(course); !remark.empty()) spdlog::warn("{}", remark);
  course.output.go_on(course.fluid);
  spdlog::info("goes on at t = {:.6e} s, step {}", course.fluid.time, course.fluid.steps);
  coupler.send(make_ready(course.fluid));
  coupler.receive("begin");
}

}  // namespace

void run_coupled(const scene::Scene& scene, Fluid& fluid, exchange::Participant& coupler, Output& output,
                 const results::Checkpoints& checkpoints) {
  Overlap overlap;
  Course course{fluid, overlap, output};
  if (checkpoints.resuming())
    go_on(course, coupler, checkpoints);
  else
    begin(scene, course, coupler);
  for (;;) {
    exchange::Message span;
    Overlap next;
    {
      const auto lap = fluid.watch.lap("messages");
      span = coupler.receive("span");
      next = read_overlap(span, fluid.grid);
    }
    compute::use_threads(span.header.value("threads", 0));
    const double dt = positive_span(span, fluid.time);
    if (fluid.steps == 0 && scene.fluid->start == "potential_flow") {
      const auto lap = fluid.watch.lap("start");
      const int iterations = adapt_potential_flow(fluid, overlap, next, scene.fluid->waterline);
      spdlog::info("potential flow: {} more iterations for the first step", iterations);
    }
    if (fluid.steps == 0) output.start(fluid);
    if (fluid.motion.follows) follow_to(fluid, grid_shift(span));
    step(fluid, dt, next);
    {
      const auto lap = fluid.watch.lap("messages");
      exchange::Message answer = make_pressure(fluid, next);
      answer.header["span"] = span.header.value("span", 0L);
      add_pressure(answer, fluid, overlap, "pressure.previous_");
      add_impulse_and_forecast(answer, fluid, next, dt);
      coupler.send(std::move(answer));
      overlap = std::move(next);
    }
    output.record(fluid, dt);
    if (const int frame = span.header.value("frame", -1); frame >= 0) output.write_frame(fluid, frame);
    if (span.header.value("finish", false)) break;
    if (const auto folder = span.header.value("checkpoint", std::string{}); !folder.empty() && checkpoints.active()) {
      const auto lap = fluid.watch.lap("checkpoints");
      check_state(fluid);  // nobody could go on from a state without meaning
      checkpoints.save(folder, fluid.steps, fluid.time, course);
    }
  }
  exchange::Message finished("finished");
  finished.header.update(output.summary(fluid));
  const auto lap = fluid.watch.lap("messages");
  coupler.send(finished);
  coupler.receive("bye");
  spdlog::info("finished: {}", output.summary(fluid).dump());
}

}  // namespace polynya::fluid
