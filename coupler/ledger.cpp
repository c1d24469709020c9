#include "coupler/ledger.hpp"

#include "coupler/vertex_index.hpp"

namespace polynya::coupler {

Impulse outstanding(const SolidSide& side) {
  Impulse sum{};
  for (std::size_t i = 0; i < side.fluid_impulse.size(); ++i) sum[i % 3] += side.fluid_impulse[i];
  return sum;
}

void WorkMeter::remember(const SolidSide& side, double acting_time) {
  ids_ = side.ids;
  contact_force_ = side.contact_force;
  fluid_force_ = side.fluid_force;
  velocity_before_ = side.velocities;
  acting_time_ = acting_time;
}

void WorkMeter::settle(const SolidSide& side, Ledger& ledger) {
  if (ids_.empty()) return;
  const int b = static_cast<int>(side.body);
  VertexIndex index(side.topology_changed ? side.ids : std::span<const std::int64_t>());
  double contact = 0, fluid = 0;
  for (std::size_t old = 0; old < ids_.size(); ++old) {
    const double* after = nullptr;
    if (!side.topology_changed) {
      after = &side.velocities[3 * old];
    } else if (const std::ptrdiff_t found = index.find(ids_[old]); found >= 0) {
      after = &side.velocities[3 * static_cast<std::size_t>(found)];
    }
    for (int d = 0; d < 3; ++d) {
      const double before = velocity_before_[3 * old + d];
      // A vertex that vanished by conversion has no velocity after the window: the one before stands in.
      const double mean = after ? 0.5 * (before + after[d]) : before;
      contact += contact_force_[3 * old + d] * mean;
      fluid += fluid_force_[3 * old + d] * mean;
    }
  }
  ledger.contact_work[b] += acting_time_ * contact;
  ledger.fluid_work[b] += acting_time_ * fluid;
}

namespace {

std::vector<results::Column> ledger_columns() {
  std::vector<results::Column> columns{{"time", "s"}, {"window", ""}, {"acting_time", "s"}};
  const char* bodies[] = {"vehicle", "ice"};
  const char* axes[] = {"x", "y", "z"};
  const auto impulse = [&](const std::string& what) {
    for (const char* body : bodies)
      for (const char* axis : axes) columns.push_back({what + "_" + body + "_" + axis, "N s"});
  };
  impulse("contact_impulse");
  impulse("fluid_given");
  impulse("fluid_start");
  impulse("fluid_taken");
  impulse("fluid_outstanding");
  for (const char* body : bodies) columns.push_back({std::string("fluid_weight_") + body + "_z", "N s"});
  for (const char* body : bodies) columns.push_back({std::string("fluid_atmosphere_") + body + "_z", "N s"});
  for (const char* body : bodies) columns.push_back({std::string("fluid_carried_") + body + "_z", "N s"});
  for (const char* body : bodies) columns.push_back({std::string("fluid_reported_") + body + "_z", "N s"});
  for (const char* body : bodies) columns.push_back({std::string("contact_work_") + body, "J"});
  for (const char* body : bodies) columns.push_back({std::string("fluid_work_") + body, "J"});
  columns.push_back({"contact_stored", "J"});
  columns.push_back({"contact_friction", "J"});
  columns.push_back({"contact_damping", "J"});
  columns.push_back({"contact_released", "J"});
  return columns;
}

}  // namespace

LedgerFile::LedgerFile(const std::string& run_folder, results::Opening opening)
    : series_(run_folder + "/series/ledger.csv", ledger_columns(), opening) {}

void LedgerFile::append(double time, long window, double acting_time, const Ledger& ledger,
                        const std::array<Impulse, body_count>& outstanding) {
  std::vector<double> row{time, static_cast<double>(window), acting_time};
  const auto add = [&](const std::array<Impulse, body_count>& impulses) {
    for (const Impulse& impulse : impulses) row.insert(row.end(), impulse.begin(), impulse.end());
  };
  add(ledger.contact_impulse);
  add(ledger.fluid_given);
  add(ledger.fluid_start);
  add(ledger.fluid_taken);
  add(outstanding);
  row.insert(row.end(), ledger.fluid_weight.begin(), ledger.fluid_weight.end());
  row.insert(row.end(), ledger.fluid_atmosphere.begin(), ledger.fluid_atmosphere.end());
  row.insert(row.end(), ledger.fluid_carried.begin(), ledger.fluid_carried.end());
  row.insert(row.end(), ledger.fluid_reported.begin(), ledger.fluid_reported.end());
  row.insert(row.end(), ledger.contact_work.begin(), ledger.contact_work.end());
  row.insert(row.end(), ledger.fluid_work.begin(), ledger.fluid_work.end());
  row.insert(row.end(),
             {ledger.contact_stored, ledger.contact_friction, ledger.contact_damping, ledger.contact_released});
  series_.append(row);
}

}  // namespace polynya::coupler
