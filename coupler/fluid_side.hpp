#pragma once
#include <span>
#include <string>
#include <vector>

#include "core/exchange/hub.hpp"
#include "coupler/account.hpp"
#include "geometry/cut_cells.hpp"

namespace polynya::coupler {

/// Gauge pressure at the centres of cut cells and its upward decrease, as the fluid used them in a span.
struct WallPressure {
  std::vector<double> value;       ///< [entries], Pa
  std::vector<double> gradient_z;  ///< [entries], Pa/m: p(z) = value - gradient_z (z - z of the cell's centre)
};

/// The same by wall, as it came: cells that hold wall, in their order. The message owns the values.
struct WallPressureView {
  std::span<const double> value, gradient_z;  ///< [walls]
};

/// What the fluid gave to the walls during a span. The message owns the values.
struct FluidAnswer {
  WallPressureView at_start, at_end;  ///< of the cut before and of the last one
  std::span<const double> impulse;    ///< [walls of the last cut][2][3] N s, given otherwise than by pressure; spreads
                                      ///< over a cell's pieces of wall by area. May be empty
  // Of the next span, [walls of the last cut]; empty where the fluid does not forecast.
  std::span<const double> forecast;   ///< Pa, gauge, if walls and fluid go on as they moved
  std::span<const double> impedance;  ///< kg/(m^2 s), more for walls that move faster into the fluid
};

/// What the coupler knows of the fluid participant.
struct FluidSide {
  std::string name;
  double stable_step = 0;  ///< s
  int new_threads = 0;     ///< number of threads to suggest with the next span; 0: nothing new
  Account account;
  geometry::GridLines grid;   ///< where it is now
  bool grid_follows = false;  ///< the vehicle: then each span takes the planes across z on by grid_speed
  double grid_speed = 0;      ///< m/s, in the next span
  double grid_shift = 0;      ///< m, of the planes across z from where they were at first
  bool can_checkpoint = false;
  bool forecasts = false;  ///< every answer to a span tells what to expect of the next one
  double ready_time = 0;   ///< s, as a solid's

  std::vector<double> first_z;  ///< m, planes that the shift counts from

  /// Reads from an answer what it says of the next span.
  void read_answer_header(const exchange::Message& answer);
  /// Takes the grid on by a span of this length, s.
  void move_grid(double span);

  POLYNYA_STATE_WITHOUT((grid, ready_time, first_z), name, stable_step, new_threads, account, grid, grid_follows,
                        grid_speed, grid_shift, can_checkpoint, forecasts, ready_time, first_z)
};

FluidSide read_fluid_ready(const std::string& name, const exchange::Message& ready);

/// Adds the overlap arrays of docs/protocol.md to a message for the fluid: what is wholly solid in runs, walls only
/// where there are some.
void add_overlap(exchange::Message& message, const geometry::CutCells& cut, const geometry::GridLines& grid);

/// Pressures of one kind from a `pressure` message, for all entries of the cut, 0 without wall: "pressure.values"
/// belong to the overlap sent last, "pressure.previous_values" to the one before. Throws ProtocolError when the number
/// does not fit.
WallPressure read_pressure(const exchange::Message& message, const std::string& prefix, const geometry::CutCells& cut);

/// The answer to a span, with the numbers of walls of the cut before and of the last one, from a fluid that `forecasts`
/// or not. Throws ProtocolError when the number of values does not fit.
FluidAnswer read_answer(const exchange::Message& message, std::size_t walls_before, std::size_t walls, bool forecasts);

}  // namespace polynya::coupler
