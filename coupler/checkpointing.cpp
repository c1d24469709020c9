#include "coupler/checkpointing.hpp"

#include <spdlog/spdlog.h>

#include <cmath>

namespace polynya::coupler {
namespace {

std::vector<std::string> files_of(const Run& run) {
  std::vector<std::string> files{run.checkpoints.file()};
  for (const SolidSide& side : run.conversation.solids) files.push_back(side.name + ".h5");
  if (run.conversation.fluid) files.push_back(run.conversation.fluid->name + ".h5");
  return files;
}

void commit_when_all_have_written(Run& run) {
  if (!run.pending->solids_done || (run.conversation.fluid && !run.pending->fluid_done)) return;
  const auto lap = run.watch.lap("checkpoints");
  const Run::Pending done = *std::exchange(run.pending, std::nullopt);
  results::commit_checkpoint(run.folder, done.window, done.time, files_of(run));
  spdlog::info("checkpoint of window {}, t = {:.6e} s", done.window, done.time);
}

void require_time(const std::string& name, double theirs, double ours) {
  // Each adds up its own steps: rounding, far below a window, lies between them.
  if (!(std::abs(theirs - ours) <= 1e-9 * ours))
    throw results::CheckpointError(
        fmt::format("participant '{}' goes on at t = {} s, the coupler's checkpoint is of t = "
                    "{} s: they are not of one checkpoint",
                    name, theirs, ours));
}

}  // namespace

void begin_checkpoints(Run& run) {
  if (!run.checkpoints.active() || (run.scene.checkpoint.interval <= 0 && run.scene.checkpoint.wall_interval <= 0))
    return;
  std::string unable;
  const auto look = [&](const auto& side) {
    if (!side.can_checkpoint) unable += (unable.empty() ? "'" : ", '") + side.name + "'";
  };
  for (const SolidSide& side : run.conversation.solids) look(side);
  if (run.conversation.fluid) look(*run.conversation.fluid);
  if (unable.empty()) return;
  spdlog::warn("there will be no checkpoints: {} cannot write any (can_checkpoint in docs/protocol.md)", unable);
  run.checkpoints = {};
}

void choose_checkpoint(Run& run) {
  run.checkpoint.clear();
  if (!run.checkpoints.active() || run.pending || !run.end.empty() || !run.schedule.due(run.keeper.time)) return;
  run.checkpoint = results::checkpoint_folder(run.keeper.window + 1);
}

void write_checkpoint(Run& run) {
  if (run.checkpoint.empty()) return;
  const auto lap = run.watch.lap("checkpoints");
  run.schedule.taken(run.keeper.time);
  run.checkpoints.save(run.checkpoint, run.keeper.window, run.keeper.time, run);
  run.pending = {.window = run.keeper.window, .time = run.keeper.time};
  run.checkpoint.clear();
}

void solids_have_answered(Run& run) {
  if (!run.pending) return;
  run.pending->solids_done = true;
  commit_when_all_have_written(run);
}

void fluid_has_answered(Run& run) {
  if (!run.pending) return;
  run.pending->fluid_done = true;
  commit_when_all_have_written(run);
}

void load_checkpoint(Run& run) {
  Conversation& conversation = run.conversation;
  std::vector<std::pair<std::string, double>> times;
  for (const SolidSide& side : conversation.solids) times.emplace_back(side.name, side.ready_time);
  if (conversation.fluid) times.emplace_back(conversation.fluid->name, conversation.fluid->ready_time);
  // What they are ready with holds more than the coupler had seen when it wrote: ice that broke after the loads.
  conversation.solids.clear();
  if (conversation.fluid) conversation.fluid->account = {};
  run.contact.emplace(contact::ContactLaw{});
  if (const std::string remark = run.checkpoints.load(run); !remark.empty()) spdlog::warn("{}", remark);
  for (const auto& [name, time] : times) require_time(name, time, run.keeper.time);
  run.schedule = {run.scene.checkpoint.interval, run.scene.checkpoint.wall_interval, run.keeper.time};
  run.span_window = run.keeper.window;
  spdlog::info("goes on at t = {:.6e} s, window {}, span {}", run.keeper.time, run.keeper.window, run.keeper.span);
}

}  // namespace polynya::coupler
