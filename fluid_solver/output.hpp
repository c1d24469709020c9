#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "core/results/frame_series.hpp"
#include "core/results/process_report.hpp"
#include "core/results/time_series.hpp"
#include "core/scene/scene.hpp"
#include "fluid_solver/fluid.hpp"

namespace polynya::fluid {

/// What a run of the fluid solver leaves behind: RUN/fields/fluid_*.vtkhdf, RUN/series/fluid.csv, RUN/logs/NAME.json,
/// and the figures of its summary.
class Output {
 public:
  /// The series gets at most about 10,000 rows over `duration` (s).
  Output(std::string run_folder, std::string name, double duration, const scene::Scene& scene,
         results::Opening opening = results::Opening::fresh);

  /// Remembers the state that errors of mass and energy are counted from.
  void start(const Fluid& fluid);
  /// After loading: that state is the last good one. Throws FluidError where it has no meaning.
  void go_on(const Fluid& fluid) { keep(fluid); }
  /// Every twenty steps also checks the state (FluidError) and keeps its fields as the last good ones.
  void record(const Fluid& fluid, double step);
  /// Checks the state first (FluidError): frames are good states.
  void write_frame(Fluid& fluid, int number);
  /// After a FluidError: makes the last good state a frame, unless it is one. Returns where it is, as a part of a
  /// sentence.
  std::string write_last_good();
  /// Last row and the report of the process, which was blocked in these waits.
  void close(const Fluid& fluid, const results::Waits& waits);
  /// RUN/NAME_summary.json, of a run without a coupler, with the entries of `more`. density_error: see run_tube.
  void write_summary(const Fluid& fluid, double density_error, const nlohmann::json& more) const;
  nlohmann::json summary(const Fluid& fluid) const;
  int frames() const { return static_cast<int>(frames_.count()); }
  const std::string& folder() const { return folder_; }

  /// The last good state is kept anew, by go_on().
  POLYNYA_STATE_WITHOUT((folder_, name_, report_, vehicle_volume_, cells_, good_time_), folder_, name_, report_,
                        frames_, series_, row_interval_, next_row_, step_, smallest_step_, last_row_, vehicle_volume_,
                        first_, cells_, good_time_, frame_time_)

 private:
  void write_row(const Fluid& fluid);
  void keep(const Fluid& fluid);

  std::string folder_, name_;
  results::ProcessReport report_;
  results::FrameSeries frames_;
  results::TimeSeries series_;
  double row_interval_, next_row_ = 0, step_ = 0, smallest_step_ = 1e300, last_row_ = -1;
  double vehicle_volume_ = 0;
  Account first_;
  results::UnstructuredFields
      cells_;  ///< points and cells, the same in every frame of a grid at rest; fields of the last good state
  double good_time_ = -1, frame_time_ = -1;  ///< of these fields, of the last frame; -1: none
};

}  // namespace polynya::fluid
