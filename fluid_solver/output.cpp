#include "fluid_solver/output.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

#include "core/compute/threads.hpp"
#include "core/results/durable_file.hpp"

namespace polynya::fluid {
namespace {

constexpr double most_rows = 10000;
constexpr long steps_between_good_states = 20;  ///< keeping one costs about as much as a tenth of a step

std::string unit_of(const std::string& name) {
  if (name.find("mass") != std::string::npos) return "kg";
  if (name.find("impulse") != std::string::npos || name.find("momentum") != std::string::npos) return "N s";
  if (name == "released_room" || name.starts_with("swept_volume")) return "m^3";
  return "J";
}

std::vector<results::Column> columns() {
  std::vector<results::Column> all{{"time", "s"}, {"step", "s"}};
  for (const std::string& name : account_names()) all.push_back({name, unit_of(name)});
  return all;
}

/// What sleeping saved, and the bound that it keeps.
std::string sleeping_report(const Fluid& fluid) {
  const auto& impulse = fluid.account.rest_impulse;
  std::ostringstream text;
  text.precision(3);
  text << 100 * fluid.sleeping.share_awake() << " % of the cells were stepped; disturbances below "
       << fluid.setup.sleeping_threshold
       << " of sound speed and bulk modulus were dropped: " << fluid.account.put_to_rest << " J and "
       << std::hypot(impulse[0], impulse[1], impulse[2]) << " N s in all";
  return text.str();
}

/// Volume of the modelled part of the vehicle taken as a cylinder: a scale for what should not be inside.
double vehicle_volume(const scene::Scene& scene) {
  if (!scene.vehicle) return 0;
  const double part = scene.symmetry == scene::Symmetry::quarter ? 0.25
                      : scene.symmetry == scene::Symmetry::half  ? 0.5
                                                                 : 1.0;
  return part * std::numbers::pi / 4 * scene.vehicle->diameter * scene.vehicle->diameter * scene.vehicle->length;
}

results::UnstructuredFields make_cells(const Grid& grid) {
  results::UnstructuredFields cells;
  cells.single_precision = true;
  const std::int64_t nx = grid.nx + 1, plane = nx * (grid.ny + 1);
  for (int k = 0; k <= grid.nz; ++k) {
    for (int j = 0; j <= grid.ny; ++j) {
      for (int i = 0; i <= grid.nx; ++i) cells.points.insert(cells.points.end(), {grid.x[i], grid.y[j], grid.z[k]});
    }
  }
  for (int k = 0; k < grid.nz; ++k) {
    for (int j = 0; j < grid.ny; ++j) {
      for (int i = 0; i < grid.nx; ++i) {
        const std::int64_t n = i + nx * j + plane * k;
        const std::int64_t corners[8] = {n,         n + 1,         n + nx + 1,         n + nx,
                                         n + plane, n + plane + 1, n + plane + nx + 1, n + plane + nx};
        cells.add_cell(results::CellType::hexahedron, corners);
      }
    }
  }
  cells.grid = {{"x", 1, grid.x}, {"y", 1, grid.y}, {"z", 1, grid.z}};
  return cells;
}

void add_fields(const Fluid& fluid, results::UnstructuredFields& cells) {
  const Grid& grid = fluid.grid;
  const std::size_t count = grid.cells();
  results::FieldArray pressure{"pressure", 1, std::vector<double>(count)},
      water_part{"water_fraction", 1, std::vector<double>(count)},
      solid{"solid_fraction", 1, std::vector<double>(count)}, density{"density", 1, std::vector<double>(count)},
      velocity{"velocity", 3, std::vector<double>(3 * count)};
  const std::vector<double>& absolute = fluid.steps > 0 ? fluid.predicted_pressure : fluid.pressure;
  std::size_t at = 0;
  for (int k = 1; k <= grid.nz; ++k) {
    for (int j = 1; j <= grid.ny; ++j) {
      for (int i = 1; i <= grid.nx; ++i, ++at) {
        const std::ptrdiff_t c = grid.at(i, j, k);
        const double full = grid.cell_volume[c], free = fluid.after.volume[c];
        pressure.values[at] = fluid.density[c] > 0 ? absolute[c] - fluid.setup.atmospheric_pressure : 0.0;
        const double held = fluid.material[water].volume[c] + fluid.material[air].volume[c];
        water_part.values[at] = held > 0 ? fluid.material[water].volume[c] / held * free / full : 0.0;
        solid.values[at] = 1.0 - free / full;
        density.values[at] = free > 0 ? (fluid.material[water].mass[c] + fluid.material[air].mass[c]) / free : 0.0;
        double weight = 0, sum[3] = {0, 0, 0};
        for (int corner = 0; corner < 8; ++corner) {
          const std::ptrdiff_t n = c + (corner & 1) + (corner & 2 ? grid.sy : 0) + (corner & 4 ? grid.sz : 0);
          weight += fluid.after.node_fraction[n];
          for (int d = 0; d < 3; ++d) sum[d] += fluid.after.node_fraction[n] * fluid.velocity[d][n];
        }
        for (int d = 0; d < 3; ++d) velocity.values[3 * at + d] = weight > 0 && free > 0 ? sum[d] / weight : 0.0;
      }
    }
  }
  cells.cell_fields = {std::move(pressure), std::move(water_part), std::move(solid), std::move(density),
                       std::move(velocity)};
}

}  // namespace

Output::Output(std::string run_folder, std::string name, double duration, const scene::Scene& scene,
               results::Opening opening)
    : folder_(std::move(run_folder)),
      name_(std::move(name)),
      frames_(folder_, "fluid"),
      series_(folder_ + "/series/fluid.csv", columns(), opening),
      row_interval_(duration / most_rows),
      vehicle_volume_(vehicle_volume(scene)) {
  // No row before the checkpoint is loaded.
  if (opening == results::Opening::continued) last_row_ = std::numeric_limits<double>::infinity();
}

void Output::start(const Fluid& fluid) {
  first_ = fluid.account;
  write_row(fluid);
}

void Output::write_row(const Fluid& fluid) {
  std::vector<double> row{fluid.time, step_};
  const auto values = account_values(fluid.account);
  row.insert(row.end(), values.begin(), values.end());
  series_.append(row);
  last_row_ = fluid.time;
  while (next_row_ <= fluid.time) next_row_ += row_interval_;
}

void Output::record(const Fluid& fluid, double step) {
  step_ = step;
  smallest_step_ = std::min(smallest_step_, step);
  if (fluid.time >= next_row_) write_row(fluid);
  if (fluid.steps % steps_between_good_states == 0) keep(fluid);
}

void Output::keep(const Fluid& fluid) {
  check_state(fluid);
  if (cells_.types.empty() || fluid.motion.active()) cells_ = make_cells(fluid.grid);
  add_fields(fluid, cells_);
  good_time_ = fluid.time;
}

void Output::write_frame(Fluid& fluid, int number) {
  const auto lap = fluid.watch.lap("frames");
  keep(fluid);
  frames_.write(number, cells_, fluid.time);
  frame_time_ = fluid.time;
}

std::string Output::write_last_good() {
  if (good_time_ < 0) return "no step was good";
  if (good_time_ != frame_time_) frames_.write(frames(), cells_, good_time_);
  frame_time_ = good_time_;
  std::ostringstream text;
  text << "the last good state kept, of time " << good_time_ << " s, is the last frame in " << folder_ << "/fields";
  return text.str();
}

void Output::close(const Fluid& fluid, const results::Waits& waits) {
  if (fluid.time > last_row_) write_row(fluid);
  if (!waits.empty()) report_.waits["coupler"] = waits;
  report_.set_headings(fluid.watch.seconds(), fluid.watch.cpu_seconds());
  report_.threads = compute::threads();
  report_.counts["steps"] = static_cast<double>(fluid.steps);
  report_.counts["cells"] = static_cast<double>(fluid.grid.cells());
  report_.counts["light_nodes"] = static_cast<double>(fluid.lightened.nodes);
  report_.counts["held_faces"] = static_cast<double>(fluid.lightened.held_faces);
  report_.counts["frames"] = static_cast<double>(frames_.count());
  report_.write(folder_, name_);
}

void Output::write_summary(const Fluid& fluid, double density_error, const nlohmann::json& more) const {
  nlohmann::json found = summary(fluid);
  found["end_reason"] = "time";
  found["end_time"] = fluid.time;
  const double energy = first_.kinetic + first_.internal;
  found["energy_error"] = energy > 0 ? std::abs(fluid.account.energy_sum() - first_.energy_sum()) / energy : 0.0;
  if (fluid.setup.sleeping_threshold > 0) found["effects"]["sleeping"]["reason"] = sleeping_report(fluid);
  if (density_error >= 0) found["density_error"] = density_error;
  found.update(more);
  results::replace_text(folder_ + "/" + name_ + "_summary.json", found.dump(1) + "\n");
}

nlohmann::json Output::summary(const Fluid& fluid) const {
  const Account& a = fluid.account;
  nlohmann::json s;
  s["cells"] = fluid.grid.cells();
  s["steps"] = fluid.steps;
  s["smallest_step"] = fluid.steps > 0 ? smallest_step_ : 0.0;
  s["time"] = fluid.time;
  double start = 0, change = 0, hidden = 0;
  for (int m = 0; m < 2; ++m) {
    start += first_.mass[m];
    change += a.mass[m] + a.boundary_mass[m] - first_.mass[m] - first_.boundary_mass[m];
  }
  for (const WallPiece& wall : fluid.after.walls) {
    if (fluid.after.volume[wall.cell] > 0) continue;
    hidden += std::abs(fluid.material[water].mass[wall.cell]) + std::abs(fluid.material[air].mass[wall.cell]);
  }
  s["mass_error"] = start > 0 ? change / start : 0.0;
  s["fluid_energy_drift"] = a.energy_sum() - first_.energy_sum();
  s["leak_fraction"] = vehicle_volume_ > 0 ? hidden / 1000.0 / vehicle_volume_ : 0.0;
  s["awake_fraction"] = fluid.sleeping.share_awake();
  s["sleeping_threshold"] = fluid.setup.sleeping_threshold;
  const auto& names = account_names();
  const auto values = account_values(a);
  for (std::size_t n = 0; n < names.size(); ++n) s["account"][names[n]] = values[n];
  return s;
}

}  // namespace polynya::fluid
