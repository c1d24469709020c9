#pragma once
#include <array>
#include <chrono>
#include <optional>
#include <string>

#include "core/compute/timer.hpp"
#include "core/contact/penalty_contact.hpp"
#include "core/results/checkpoint_file.hpp"
#include "core/results/checkpoint_folder.hpp"
#include "coupler/conversation.hpp"
#include "coupler/ledger.hpp"
#include "coupler/monitor.hpp"
#include "coupler/overlap_exchange.hpp"
#include "coupler/thread_balance.hpp"
#include "coupler/time_keeper.hpp"

namespace polynya::coupler {

/// Everything that lives as long as the run.
struct Run {
  const scene::Scene& scene;
  std::string folder;
  Conversation conversation;
  compute::Stopwatch watch;
  TimeKeeper keeper;
  StepLimits limits;
  SpanPlan plan;  ///< of the span at work
  Ledger ledger;
  LedgerFile ledger_file;
  std::array<WorkMeter, body_count> work;
  std::optional<contact::PenaltyContact> contact;
  bool topology_changed = false;
  std::optional<OverlapExchange> overlap;
  std::optional<Monitor> monitor;
  double planned_step = 0, first_planned_step = 0, next_frame_time = 0;
  double logged_lag_limit = 1;  ///< s
  bool step_warned = false;
  long frame = 0, cuts = 0;
  std::string end;  ///< why the run ends; empty while it goes on
  std::optional<ThreadBalance> balance;
  std::chrono::steady_clock::time_point span_began;  ///< on the wall
  long span_window = 0;                              ///< number of the span's first window

  results::Checkpoints checkpoints;
  results::CheckpointSchedule schedule;
  std::string checkpoint;  ///< folder of the checkpoint that belongs to the window at work; empty: none
  bool fitted_to_end =
      false;  ///< a window was cut to the latest end: no checkpoints from here on, a later end may come
  /// Written by the coupler, and by the others as far as they have answered since.
  struct Pending {
    long window;
    double time;
    bool solids_done = false, fluid_done = false;
  };
  std::optional<Pending> pending;

  Run(const scene::Scene& s, std::string run_folder, exchange::Hub& hub, results::Checkpoints c)
      : scene(s),
        folder(std::move(run_folder)),
        conversation{hub, {}, std::nullopt},
        ledger_file(folder, c.resuming() ? results::Opening::continued : results::Opening::fresh),
        checkpoints(std::move(c)),
        schedule(s.checkpoint.interval, s.checkpoint.wall_interval, 0) {}

  /// Between windows.
  POLYNYA_STATE_WITHOUT((scene, folder, watch, balance, span_began, checkpoints, schedule, checkpoint, fitted_to_end,
                         pending),
                        scene, folder, conversation, watch, keeper, limits, plan, ledger, ledger_file, work, contact,
                        topology_changed, overlap, monitor, planned_step, first_planned_step, next_frame_time,
                        logged_lag_limit, step_warned, frame, cuts, end, balance, span_began, span_window, checkpoints,
                        schedule, checkpoint, fitted_to_end, pending)

  contact::ContactLaw contact_law(const contact::Body& vehicle, const contact::Body& ice) const {
    contact::ContactLaw law;
    law.friction = scene.effect("friction") ? scene.contact.friction : 0.0;
    law.damping = scene.contact.damping;
    law.stiffness_factor = scene.contact.stiffness_factor;
    law.depth_limit = 0.5 * scene.resolution.ice_element;
    law.skin = 0.25 * scene.resolution.ice_element;
    law.two_way = scene.contact.two_way == "on" || (scene.contact.two_way == "auto" && contact::is_finer(vehicle, ice));
    law.edges = scene.contact.edges != "off";
    law.mirror = {scene.symmetry == scene::Symmetry::quarter, scene.symmetry != scene::Symmetry::full};
    return law;
  }
};

}  // namespace polynya::coupler
