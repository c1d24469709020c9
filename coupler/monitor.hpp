#pragma once
#include <memory>
#include <string>

#include "core/contact/penalty_contact.hpp"
#include "core/results/time_series.hpp"
#include "core/scene/scene.hpp"
#include "coupler/conversation.hpp"
#include "coupler/ledger.hpp"
#include "coupler/time_keeper.hpp"

namespace polynya::coupler {

/// Energy and momentum of the whole coupled system relative to the start. All of the modelled part (J, N s).
struct Balance {
  double vehicle = 0, ice = 0, fluid = 0;  ///< J, change of what each stores, losses that are booked included
  double contact = 0;                      ///< J, stored in penalty springs, dissipated by friction, released
  double external = 0;                     ///< J, put in from outside: gravity, boundaries
  double numerical = 0;  ///< J, part of the energy defect that the scheme can name (swept volume, change of step)
  double momentum = 0;   ///< kg m/s, change of vertical momentum less outside impulses
  double exchanged = 0;  ///< J, the largest of these changes
  /// What does not close. Booked defects count as error: no physical reservoir took that energy.
  double energy_defect() const { return vehicle + ice + fluid + contact - external; }
};

/// Watches a coupled run: vehicle motion, energy and momentum errors, RUN/series/coupler.csv (one row per span, values
/// of the full vehicle and plate whatever the symmetry).
class Monitor {
 public:
  Monitor(const scene::Scene& scene, const std::string& run_folder, const Conversation& conversation,
          results::Opening opening = results::Opening::fresh);

  void note_contact(const contact::ContactForces& forces);
  /// Gauge pressure on the vehicle's wall: the largest of any cell, and the mean over the head by area.
  /// pressure: Pa, by wall.
  void note_pressure(const geometry::CutCells& cells, const geometry::GridLines& grid,
                     std::span<const double> pressure);

  double nose() const { return nose_; }    ///< m
  double speed() const { return speed_; }  ///< m/s, of the centre of mass, upward

  void append_row(const TimeKeeper& keeper, const Conversation& conversation, const Ledger& ledger, double window_step);
  nlohmann::json summary(const TimeKeeper& keeper, const Conversation& conversation, const Ledger& ledger) const;

  POLYNYA_STATE_WITHOUT((scene_), scene_, series_, scale_, atmospheric_pressure_, initial_kinetic_, initial_momentum_,
                        largest_exchange_, initial_speed_, nose_, speed_, mass_, largest_defect_, largest_momentum_error_,
                        peak_head_stress_, peak_wall_pressure_, wall_pressure_, head_pressure_, deepest_contact_,
                        contact_before_, fluid_before_, time_before_)

 private:
  void read_vehicle(const Conversation& conversation);
  /// Over the vehicle's initial kinetic energy; without a vehicle over the largest change of any part's energy so far.
  double energy_error(double defect) const;
  double momentum_error(const Balance& sum) const;

  const scene::Scene& scene_;
  results::TimeSeries series_;
  double scale_ = 1;  ///< full model over modelled part
  double atmospheric_pressure_ = 0;
  double initial_kinetic_ = 0;   ///< of the vehicle
  double initial_momentum_ = 0;  ///< of the vehicle; without one that of the ice
  double largest_exchange_ = 0;  ///< J, so far
  double initial_speed_ = 0;
  double nose_ = 0, speed_ = 0, mass_ = 0;
  double largest_defect_ = 0;  ///< J
  double largest_momentum_error_ = 0;
  double peak_head_stress_ = 0, peak_wall_pressure_ = 0, wall_pressure_ = 0, head_pressure_ = 0, deepest_contact_ = 0;
  Impulse contact_before_{}, fluid_before_{};
  double time_before_ = 0;
};

/// Changes of all reservoirs since the start.
Balance balance(const Conversation& conversation, const Ledger& ledger, double atmospheric_pressure);

}  // namespace polynya::coupler
