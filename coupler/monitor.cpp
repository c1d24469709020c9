#include "coupler/monitor.hpp"

#include <algorithm>
#include <cmath>

namespace polynya::coupler {
namespace {

double symmetry_scale(scene::Symmetry symmetry) {
  if (symmetry == scene::Symmetry::quarter) return 4;
  return symmetry == scene::Symmetry::half ? 2 : 1;
}

std::vector<results::Column> progress_columns() {
  return {{"time", "s"},
          {"window", ""},
          {"span", ""},
          {"vehicle_speed", "m/s"},
          {"vehicle_momentum", "kg m/s"},
          {"vehicle_position", "m"},
          {"energy_error", ""},
          {"momentum_error", ""},
          {"contact_force", "N"},
          {"fluid_force", "N"},
          {"head_stress", "Pa"},
          {"vehicle_kinetic", "J"},
          {"vehicle_internal", "J"},
          {"ice_kinetic", "J"},
          {"ice_internal", "J"},
          {"fluid_energy_change", "J"},
          {"contact_energy", "J"},
          {"dissipated", "J"},
          {"external_work", "J"},
          {"numerical_work", "J"},
          {"broken_ice_mass", "kg"},
          {"converted_elements", ""},
          {"particles", ""},
          {"wall_pressure", "Pa"},
          {"head_pressure", "Pa"},
          {"contact_depth", "m"},
          {"fluid_step", "s"},
          {"window_step", "s"}};
}

}  // namespace

Monitor::Monitor(const scene::Scene& scene, const std::string& run_folder, const Conversation& conversation,
                 results::Opening opening)
    : scene_(scene),
      series_(run_folder + "/series/coupler.csv", progress_columns(), opening),
      scale_(symmetry_scale(scene.symmetry)),
      atmospheric_pressure_(scene.fluid ? scene.fluid->atmospheric_pressure : 0.0) {
  read_vehicle(conversation);
  initial_speed_ = speed_;
  if (const SolidSide* vehicle = conversation.find(Body::vehicle)) {
    const double u = vehicle->account["momentum_x"] / mass_, v = vehicle->account["momentum_y"] / mass_;
    initial_kinetic_ = 0.5 * mass_ * (speed_ * speed_ + u * u + v * v);
    initial_momentum_ = vehicle->account["momentum_z"];
  } else if (const SolidSide* ice = conversation.find(Body::ice)) {
    initial_momentum_ = ice->account["momentum_z"];
  }
}

void Monitor::read_vehicle(const Conversation& conversation) {
  const SolidSide* vehicle = conversation.find(Body::vehicle);
  if (!vehicle) return;
  mass_ = vehicle->account["mass"];
  if (mass_ > 0) speed_ = vehicle->account["momentum_z"] / mass_;
  nose_ = -1e300;
  for (std::size_t v = 0; v < vehicle->vertices(); ++v) nose_ = std::max(nose_, vehicle->positions[3 * v + 2]);
}

double Monitor::energy_error(double defect) const {
  const double reference = mass_ > 0 ? initial_kinetic_ : largest_exchange_;
  return reference > 0 ? defect / reference : 0;
}

double Monitor::momentum_error(const Balance& sum) const {
  return initial_momentum_ != 0 ? std::abs(sum.momentum / initial_momentum_) : 0;
}

void Monitor::note_contact(const contact::ContactForces& forces) {
  deepest_contact_ = std::max(deepest_contact_, forces.deepest);
}

void Monitor::note_pressure(const geometry::CutCells& cells, const geometry::GridLines& grid,
                            std::span<const double> pressure) {
  wall_pressure_ = 0;
  double head_area = 0, head_sum = 0;
  constexpr auto vehicle = static_cast<std::size_t>(Body::vehicle);
  const double shoulder = scene_.vehicle ? nose_ - scene_.vehicle->head_length : nose_;
  for (std::size_t e = 0, wall = 0; e < cells.cell.size(); ++e) {
    if (!cells.walled[e]) continue;
    const double at_wall = pressure[wall++];
    const double* area = &cells.wall_area[(e * body_count + vehicle) * 3];
    const double size = std::sqrt(area[0] * area[0] + area[1] * area[1] + area[2] * area[2]);
    if (size == 0) continue;
    wall_pressure_ = std::max(wall_pressure_, at_wall);
    if (grid.lines[2][static_cast<std::size_t>(grid.cell_position(cells.cell[e])[2]) + 1] < shoulder) continue;
    head_area += size;
    head_sum += size * at_wall;
  }
  head_pressure_ = head_area > 0 ? head_sum / head_area : 0.0;
  peak_wall_pressure_ = std::max(peak_wall_pressure_, wall_pressure_);
}

Balance balance(const Conversation& conversation, const Ledger& ledger, double atmospheric_pressure) {
  Balance sum;
  for (const SolidSide& side : conversation.solids) {
    double& stored = side.body == Body::vehicle ? sum.vehicle : sum.ice;
    stored = side.account.change({"kinetic", "internal", "hourglass", "viscous", "conversion_heat"});
    sum.external += side.account.change({"gravity_work", "support_work", "set_load_work"}) - side.account.change("boundary_flux");
    sum.numerical += side.account.change("step_change");
    sum.momentum += side.account.change("momentum_z") - side.account.change("boundary_impulse_z") -
                    side.account.change("gravity_impulse_z") + outstanding(side)[2] -
                    ledger.fluid_weight[static_cast<int>(side.body)] -
                    ledger.fluid_start[static_cast<int>(side.body)][2];
  }
  if (conversation.fluid) {
    const Account& fluid = conversation.fluid->account;
    // What walls gave to fluid they carried along ("node_fix") is in the fluid's kinetic energy and missing in the
    // solids'.
    sum.fluid = fluid.change({"kinetic", "internal", "gravity", "remap_loss", "hourglass", "put_to_rest", "vapour"});
    sum.external -= fluid.change({"boundary_work", "boundary_energy"});
    // The fluid works on walls with absolute pressure, solids count from the atmosphere: their insides hold against it.
    sum.external -= atmospheric_pressure * fluid.change({"swept_volume_vehicle", "swept_volume_ice"});
    sum.numerical -= fluid.change("swept_defect");
    sum.momentum += fluid.change({"momentum_z", "boundary_impulse_z", "gravity_impulse", "rest_impulse_z"});
  }
  for (const double part : {sum.vehicle, sum.ice, sum.fluid, sum.external})
    sum.exchanged = std::max(sum.exchanged, std::abs(part));
  sum.contact = ledger.contact_stored + ledger.contact_friction + ledger.contact_damping + ledger.contact_released;
  return sum;
}

void Monitor::append_row(const TimeKeeper& keeper, const Conversation& conversation, const Ledger& ledger,
                         double window_step) {
  read_vehicle(conversation);
  const SolidSide* vehicle = conversation.find(Body::vehicle);
  const SolidSide* ice = conversation.find(Body::ice);
  static const Account nothing;
  const Account& v = vehicle ? vehicle->account : nothing;
  const Account& i = ice ? ice->account : nothing;

  const Balance sum = balance(conversation, ledger, atmospheric_pressure_);
  largest_exchange_ = std::max(largest_exchange_, sum.exchanged);
  const double defect = std::abs(sum.energy_defect());
  largest_defect_ = std::max(largest_defect_, defect);
  largest_momentum_error_ = std::max(largest_momentum_error_, momentum_error(sum));
  peak_head_stress_ = std::max(peak_head_stress_, v["head_stress"]);

  constexpr int body = static_cast<int>(Body::vehicle);
  const double passed = std::max(keeper.time - time_before_, 1e-300);
  const double contact_force = (ledger.contact_impulse[body][2] - contact_before_[2]) / passed;
  const double fluid_force = (ledger.fluid_taken[body][2] - fluid_before_[2]) / passed;
  contact_before_ = ledger.contact_impulse[body];
  fluid_before_ = ledger.fluid_taken[body];
  time_before_ = keeper.time;

  const double row[] = {keeper.time,
                        static_cast<double>(keeper.window),
                        static_cast<double>(keeper.span),
                        speed_,
                        scale_ * v["momentum_z"],
                        v["centre_of_mass_z"],
                        energy_error(defect),
                        momentum_error(sum),
                        scale_ * contact_force,
                        scale_ * fluid_force,
                        v["head_stress"],
                        scale_ * v["kinetic"],
                        scale_ * v["internal"],
                        scale_ * i["kinetic"],
                        scale_ * i["internal"],
                        scale_ * sum.fluid,
                        scale_ * sum.contact,
                        scale_ * (ledger.contact_friction + i["viscous"] + i["hourglass"] + i["conversion_heat"]),
                        scale_ * sum.external,
                        scale_ * sum.numerical,
                        scale_ * i["broken_mass"],
                        i["converted_elements"],
                        i["particles"],
                        wall_pressure_,
                        head_pressure_,
                        deepest_contact_,
                        keeper.time - keeper.span_start,
                        window_step};
  series_.append(row);
}

nlohmann::json Monitor::summary(const TimeKeeper& keeper, const Conversation& conversation,
                                const Ledger& ledger) const {
  const Balance sum = balance(conversation, ledger, atmospheric_pressure_);
  nlohmann::json summary;
  summary["end_time"] = keeper.time;
  summary["windows"] = keeper.window;
  summary["steps"] = keeper.window;
  summary["free_windows"] = keeper.free_windows;
  summary["spans"] = keeper.span;
  if (conversation.find(Body::vehicle)) {
    summary["initial_speed"] = initial_speed_;
    summary["residual_speed"] = speed_;
    summary["peak_head_stress"] = peak_head_stress_;
  }
  if (const SolidSide* ice = conversation.find(Body::ice)) {
    summary["broken_ice_mass"] = scale_ * ice->account["broken_mass"];
    summary["converted_elements"] = ice->account["converted_elements"];
    summary["particles"] = ice->account["particles"];
  }
  summary["energy_error"] = energy_error(std::abs(sum.energy_defect()));
  summary["momentum_error"] = momentum_error(sum);
  summary["largest_energy_error"] = energy_error(largest_defect_);
  summary["largest_momentum_error"] = largest_momentum_error_;
  summary["peak_wall_pressure"] = peak_wall_pressure_;
  summary["deepest_contact"] = deepest_contact_;
  summary["balance"] = {{"vehicle", scale_ * sum.vehicle},       {"ice", scale_ * sum.ice},
                        {"fluid", scale_ * sum.fluid},           {"contact", scale_ * sum.contact},
                        {"external", scale_ * sum.external},     {"numerical", scale_ * sum.numerical},
                        {"defect", scale_ * sum.energy_defect()}};
  for (const SolidSide& side : conversation.solids)
    for (std::size_t n = 0; n < side.account.names().size(); ++n)
      summary["accounts"][side.name][side.account.names()[n]] = side.account.values()[n];
  if (conversation.fluid)
    for (std::size_t n = 0; n < conversation.fluid->account.names().size(); ++n)
      summary["accounts"]["fluid"][conversation.fluid->account.names()[n]] = conversation.fluid->account.values()[n];
  return summary;
}

}  // namespace polynya::coupler
