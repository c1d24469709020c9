#pragma once
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "core/results/time_series.hpp"
#include "coupler/solid_side.hpp"

namespace polynya::coupler {

using Impulse = std::array<double, 3>;  ///< N s

/// Impulse and work exchanged over every interface since the start, as seen from both sides. The first health check of
/// a coupled run: contact impulses cancel at every time; what the fluid gave equals what the solids took plus what is
/// still outstanding.
struct Ledger {
  // Contact, vehicle against ice.
  std::array<Impulse, body_count> contact_impulse{};  ///< given to each body
  std::array<double, body_count> contact_work{};      ///< J, done on each body
  double contact_stored = 0;                          ///< J, in penalty springs now
  double contact_friction = 0;                        ///< J, dissipated by friction
  double contact_damping = 0;                         ///< J, dissipated by damping
  double contact_released = 0;                        ///< J, when stiffness had to fall
  // Fluid on each body.
  std::array<Impulse, body_count> fluid_given{};      ///< by the fluid, from its pressures and the cut pieces
  std::array<double, body_count> fluid_weight{};      ///< part of the vertical one: weight of water within cut cells
  std::array<double, body_count> fluid_atmosphere{};  ///< vertical, not given: of the atmosphere, on surfaces that are
                                                      ///< not closed within the grid; the fluid's own books count it
  std::array<double, body_count> fluid_carried{};     ///< part of the vertical one: fluid that walls carried along
  std::array<Impulse, body_count> fluid_start{};    ///< part of it: the pressure of the start, until the fluid answers
  std::array<Impulse, body_count> fluid_taken{};    ///< handed to the body
  std::array<double, body_count> fluid_reported{};  ///< vertical, from uniform cell pressures, in the fluid's own books
  std::array<double, body_count> fluid_work{};      ///< J, done on each body
};

/// Impulse still held for a body: given by the fluid, not yet handed on.
Impulse outstanding(const SolidSide& side);

/// Remembers the loads of one window until the velocities after it are known, because the work of a force in a
/// leapfrog is its product with the mean of the velocities before and after.
class WorkMeter {
 public:
  /// Call after the loads of a window are fixed. acting_time in s.
  void remember(const SolidSide& side, double acting_time);
  /// Call when the surface of the next window has come: books the work of the remembered loads.
  void settle(const SolidSide& side, Ledger& ledger);

  POLYNYA_STATE(ids_, contact_force_, fluid_force_, velocity_before_, acting_time_)

 private:
  std::vector<std::int64_t> ids_;
  std::vector<double> contact_force_, fluid_force_, velocity_before_;
  double acting_time_ = 0;
};

/// RUN/series/ledger.csv, one row per window.
class LedgerFile {
 public:
  explicit LedgerFile(const std::string& run_folder, results::Opening opening = results::Opening::fresh);
  void append(double time, long window, double acting_time, const Ledger& ledger,
              const std::array<Impulse, body_count>& outstanding);

  POLYNYA_STATE(series_)

 private:
  results::TimeSeries series_;
};

}  // namespace polynya::coupler
