#include "structure_solver/output.hpp"

#include <algorithm>
#include <limits>

#include "core/compute/threads.hpp"
#include "core/results/durable_file.hpp"

namespace polynya::structure {
namespace {

constexpr double most_rows = 10000;

std::vector<results::Column> columns() {
  std::vector<results::Column> all{{"time", "s"}, {"step", "s"}};
  for (const AccountEntry& entry : account_entries) all.push_back({std::string(entry.name), std::string(entry.unit)});
  for (int s = 0; s < station_count; ++s)
    all.push_back({"von_mises_at_" + std::to_string(100 * s / (station_count - 1)) + "_percent", "Pa"});
  return all;
}

constexpr const char* attitude_file = "/series/attitude.csv";

std::vector<results::Column> attitude_columns() {
  std::vector<results::Column> all{{"time", "s"}};
  const std::pair<const char*, const char*> vectors[] = {{"centre_of_mass", "m"},
                                                         {"velocity", "m/s"},
                                                         {"nose_direction", ""},
                                                         {"angular_velocity", "rad/s"},
                                                         {"angular_momentum", "kg m^2/s"}};
  for (const auto& [name, unit] : vectors)
    for (const char* axis : {"_x", "_y", "_z"}) all.push_back({std::string(name) + axis, unit});
  return all;
}

std::vector<double> attitude_row(double time, const Attitude& a) {
  std::vector<double> row{time};
  for (const auto* vector : {&a.centre, &a.velocity, &a.nose_direction, &a.angular_velocity, &a.angular_momentum})
    row.insert(row.end(), vector->begin(), vector->end());
  return row;
}

/// Hexahedra, or the triangles of a hull that has none.
results::UnstructuredFields unstructured(const geometry::VehicleMesh& vehicle, VehicleFields&& fields) {
  const continuum::HexMesh& mesh = vehicle.hexahedra;
  results::UnstructuredFields grid;
  grid.single_precision = true;
  grid.points = std::move(fields.positions);
  for (std::size_t e = 0; e < mesh.element_count(); ++e) {
    std::array<std::int64_t, 8> corners;
    for (int k = 0; k < 8; ++k) corners[k] = mesh.elements[8 * e + k];
    grid.add_cell(results::CellType::hexahedron, corners);
  }
  for (std::size_t t = 0; mesh.element_count() == 0 && t + 2 < vehicle.hull_triangles.size(); t += 3) {
    std::array<std::int64_t, 3> corners;
    for (int k = 0; k < 3; ++k) corners[k] = vehicle.hull_nodes[vehicle.hull_triangles[t + k]];
    grid.add_cell(results::CellType::triangle, corners);
  }
  grid.point_fields.push_back({"velocity", 3, std::move(fields.velocities)});
  grid.point_fields.push_back({"displacement", 3, std::move(fields.displacements)});
  if (!fields.von_mises.empty()) {
    grid.cell_fields.push_back({"von_mises", 1, std::move(fields.von_mises)});
    grid.cell_fields.push_back({"stress", 6, std::move(fields.stress)});
  }
  return grid;
}

}  // namespace

Output::Output(std::string run_folder, std::string name, double duration, const BuiltVehicle& vehicle,
               results::Opening opening)
    : folder_(std::move(run_folder)),
      name_(std::move(name)),
      vehicle_(vehicle),
      frames_(folder_, "vehicle"),
      series_(folder_ + "/series/structure.csv", columns(), opening),
      row_interval_(duration / most_rows) {
  account_ = first_ = vehicle.body->account();
  if (vehicle.body->attitude()) attitude_.emplace(folder_ + attitude_file, attitude_columns(), opening);
  if (opening == results::Opening::fresh)
    write_row();
  else
    last_row_ = std::numeric_limits<double>::infinity();  // no row before the checkpoint is loaded
}

void Output::write_row() {
  std::vector<double> row{time_, step_};
  const auto values = account_values(account_);
  row.insert(row.end(), values.begin(), values.end());
  const auto stations = vehicle_.body->station_stress();
  row.insert(row.end(), stations.begin(), stations.end());
  series_.append(row);
  if (attitude_) attitude_->append(attitude_row(time_, *vehicle_.body->attitude()));
  last_row_ = time_;
  while (next_row_ <= time_) next_row_ += row_interval_;
}

void Output::record(double time, double step, const Account& account) {
  ++steps_;
  time_ = time;
  step_ = step;
  account_ = account;
  smallest_step_ = std::min(smallest_step_, step);
  peak_vertex_ = std::max(peak_vertex_, account.head_stress_vertex);
  if (account.head_stress > peak_stress_) {
    peak_stress_ = account.head_stress;
    peak_time_ = time;
  }
  if (time >= next_row_) write_row();
}

void Output::write_frame(int number, double time) {
  const auto lap = watch_.lap("frames");
  frames_.write(number, unstructured(vehicle_.mesh, vehicle_.body->fields()), time);
}

void Output::close(const results::Waits& waits) {
  if (time_ > last_row_) write_row();
  if (!waits.empty()) report_.waits["coupler"] = waits;
  report_.set_headings(watch_.seconds(), watch_.cpu_seconds());
  report_.threads = compute::threads();
  report_.counts["steps"] = static_cast<double>(steps_);
  report_.counts["elements"] = static_cast<double>(vehicle_.mesh.hexahedra.element_count());
  report_.counts["nodes"] = static_cast<double>(vehicle_.mesh.hexahedra.node_count());
  report_.counts["frames"] = static_cast<double>(frames_.count());
  report_.write(folder_, name_);
}

void Output::write_summary() const {
  nlohmann::json found = summary();
  found["end_reason"] = "time";
  found["end_time"] = time_;
  results::replace_text(folder_ + "/" + name_ + "_summary.json", found.dump(1) + "\n");
}

nlohmann::json Output::summary() const {
  nlohmann::json s;
  s["elements"] = vehicle_.mesh.hexahedra.element_count();
  s["nodes"] = vehicle_.mesh.hexahedra.node_count();
  s["hull_triangles"] = vehicle_.mesh.hull_triangles.size() / 3;
  s["wall_thickness"] = vehicle_.mesh.wall_thickness;
  s["elements_through_wall"] = vehicle_.mesh.layers;
  s["mass"] = vehicle_.mass;
  s["whole_mass"] = vehicle_.whole_mass;
  s["density"] = vehicle_.density;
  s["mass_note"] = vehicle_.mass_note;
  if (vehicle_.body->attitude()) {
    s["centre_of_mass"] = vehicle_.centre;
    s["inertia"] = vehicle_.inertia;
  }
  s["volume"] = vehicle_.quality.volume;
  s["least_scaled_jacobian"] = vehicle_.quality.least_scaled_jacobian;
  s["greatest_aspect"] = vehicle_.quality.greatest_aspect;
  s["smallest_edge"] = vehicle_.quality.smallest_edge;
  s["stable_step"] = vehicle_.body->stable_step();
  s["steps"] = steps_;
  s["smallest_step"] = steps_ > 0 ? smallest_step_ : 0.0;
  s["time"] = time_;
  s["peak_head_stress"] = peak_stress_;
  s["peak_head_stress_time"] = peak_time_;
  s["peak_head_stress_vertex"] = peak_vertex_;
  s["speed"] = account_.speed_z;
  const auto values = account_values(account_);
  for (std::size_t i = 0; i < account_entries.size(); ++i)
    s["account"][std::string(account_entries[i].name)] = values[i];
  s["energy_error"] = first_.kinetic > 0 ? (account_.balance() - first_.balance()) / first_.kinetic : 0.0;
  return s;
}

}  // namespace polynya::structure
