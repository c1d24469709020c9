#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "core/compute/timer.hpp"
#include "core/results/frame_series.hpp"
#include "core/results/process_report.hpp"
#include "core/results/time_series.hpp"
#include "structure_solver/build_vehicle.hpp"

namespace polynya::structure {

/// What a run of the structure solver leaves behind: RUN/fields/vehicle_*.vtkhdf, RUN/series/structure.csv, of a rigid
/// body that may turn RUN/series/attitude.csv, and RUN/logs/NAME.json; and the figures of its summary.
class Output {
 public:
  /// The series gets at most about 10,000 rows over `duration` (s).
  Output(std::string run_folder, std::string name, double duration, const BuiltVehicle& vehicle,
         results::Opening opening = results::Opening::fresh);

  /// Books one finished window; writes a row of the series when one is due.
  void record(double time, double step, const Account& account);
  void write_frame(int number, double time);
  /// Last row and the report of the process, which was blocked in these waits.
  void close(const results::Waits& waits);

  /// Figures for the `finished` message and the log.
  nlohmann::json summary() const;
  /// RUN/NAME_summary.json, of a run without a coupler.
  void write_summary() const;
  compute::Stopwatch& watch() { return watch_; }

  POLYNYA_STATE_WITHOUT((folder_, name_, vehicle_, report_, watch_), folder_, name_, vehicle_, report_, watch_, frames_,
                        series_, attitude_, row_interval_, next_row_, last_row_, time_, step_, smallest_step_, account_,
                        first_, peak_stress_, peak_time_, peak_vertex_, steps_)

 private:
  void write_row();

  std::string folder_, name_;
  const BuiltVehicle& vehicle_;
  results::ProcessReport report_;
  compute::Stopwatch watch_;
  results::FrameSeries frames_;
  results::TimeSeries series_;
  std::optional<results::TimeSeries> attitude_;
  double row_interval_, next_row_ = 0, last_row_ = -1;
  double time_ = 0, step_ = 0, smallest_step_ = 1e300;
  Account account_, first_;
  double peak_stress_ = 0, peak_time_ = 0, peak_vertex_ = 0;
  long steps_ = 0;
};

}  // namespace polynya::structure
