#include "ice_solver/bending_record.hpp"

#include <algorithm>

namespace polynya::ice {
namespace {

constexpr double fractured = 0.9;  // damage

double most_damage(const IceBody& ice) {
  return *std::max_element(ice.solid.element.damage.begin(), ice.solid.element.damage.end());
}

bool has_yielded(const IceBody& ice) {
  const auto& strain = ice.solid.element.plastic_strain;
  return *std::max_element(strain.begin(), strain.end()) > 0;
}

}  // namespace

void record(BendingRecord& record, const BendingRig& rig, const IceBody& beam, double dt) {
  const double damage = most_damage(beam);
  record.broken = record.broken || damage > fractured;
  if (record.broken) return;
  const double load = roller_load(rig, beam);
  record.peak_load = std::max(record.peak_load, load);
  record.load_time += load * dt;
  record.duration += dt;
  if (has_yielded(beam)) return;
  record.sag_load += sag(rig, beam) * load;
  record.load_load += load * load;
}

nlohmann::json findings(const BendingRecord& record, const BendingRig& rig, const IceBody& beam) {
  const auto layers = static_cast<double>(beam.options.z.size() - 1);
  const double theory = timoshenko_flexibility(rig, continuum::elastic_part(beam.solid.law));
  const double strength = outer_fibre_stress(rig, record.peak_load);
  const Cracks cracks = count_cracks(rig, beam);
  nlohmann::json found{{"peak_load", record.peak_load},
                       {"mean_load", record.duration > 0 ? record.load_time / record.duration : 0.0},
                       {"broken", record.broken},
                       {"deflection", rig.deflection},
                       {"sag_ratio", record.load_load > 0 ? record.sag_load / record.load_load / theory : 0.0},
                       {"bending_strength", strength},
                       {"sampling_bound", layers / (layers - 1)},
                       {"cracks", cracks.all},
                       {"cracks_between_loads", cracks.between_loads},
                       {"most_damage", most_damage(beam)}};
  if (const auto* law = std::get_if<continuum::JohnsonHolmquist2>(&beam.solid.law)) {
    const double tension = continuum::uniaxial_tensile_strength(*law, law->reference_strain_rate);
    found.update({{"tensile_strength", tension},
                  {"strength_ratio", strength / tension},
                  {"tension_ductility", law->tension_ductility}});
  }
  return found;
}

}  // namespace polynya::ice
