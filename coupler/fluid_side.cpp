#include "coupler/fluid_side.hpp"

#include "core/exchange/errors.hpp"
#include "coupler/solid_side.hpp"

namespace polynya::coupler {

FluidSide read_fluid_ready(const std::string& name, const exchange::Message& ready) {
  FluidSide side;
  side.name = name;
  side.stable_step = ready.header.at("stable_step").get<double>();
  side.can_checkpoint = ready.header.value("can_checkpoint", false);
  side.ready_time = ready.header.value("time", 0.0);
  side.account.set_names(ready);
  const auto line = [&](const char* array) {
    const auto values = ready.view<double>(array);
    if (values.size() < 2)
      throw exchange::ProtocolError("participant '" + name + "': array '" + array + "' needs at least two coordinates");
    return std::vector<double>(values.begin(), values.end());
  };
  side.grid.lines = {line("grid.x"), line("grid.y"), line("grid.z")};
  return side;
}

void add_overlap(exchange::Message& message, const geometry::CutCells& cut) {
  const auto count = static_cast<std::int64_t>(cut.cell.size());
  message.add<std::int64_t>("cell", {count}, cut.cell);
  message.add<double>("solid_volume", {count}, cut.solid_volume);
  message.add<double>("debris_volume", {count}, cut.debris_volume);
  message.add<double>("wall_area", {count, body_count, 3}, cut.wall_area);
  message.add<double>("wall_velocity", {count, body_count, 3}, cut.wall_velocity);
  const char* names[] = {"face_x", "face_y", "face_z"};
  for (int d = 0; d < 3; ++d) {
    const auto faces = static_cast<std::int64_t>(cut.faces[d].face.size());
    message.add<std::int64_t>(names[d], {faces}, cut.faces[d].face);
    message.add<double>(std::string(names[d]) + ".solid", {faces}, cut.faces[d].solid);
  }
}

WallPressure read_pressure(const exchange::Message& message, const std::string& prefix, std::size_t entries) {
  const auto values = message.view<double>(prefix + "values");
  const auto gradient = message.view<double>(prefix + "gradient_z");
  if (values.size() != entries || gradient.size() != entries)
    throw exchange::ProtocolError("message 'pressure': array '" + prefix + "values' holds " +
                                  std::to_string(values.size()) + " values for " + std::to_string(entries) +
                                  " overlap entries");
  return {std::vector<double>(values.begin(), values.end()), std::vector<double>(gradient.begin(), gradient.end())};
}

}  // namespace polynya::coupler
