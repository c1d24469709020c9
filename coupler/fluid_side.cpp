#include "coupler/fluid_side.hpp"

#include <algorithm>
#include <utility>

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

namespace {

/// Runs of consecutive numbers.
class Runs {
 public:
  void add(std::int64_t number) {
    if (!rows_.empty() && rows_[rows_.size() - 2] + rows_.back() == number)
      ++rows_.back();
    else
      rows_.insert(rows_.end(), {number, 1});
  }
  void add_to(exchange::Message& message, std::string name) const {
    message.add<std::int64_t>(std::move(name), {static_cast<std::int64_t>(rows_.size() / 2), 2}, rows_);
  }

 private:
  std::vector<std::int64_t> rows_;  ///< [runs][2], first and how many
};

template <class T>
void add_column(exchange::Message& message, const char* name, const std::vector<T>& values) {
  message.add<T>(name, {static_cast<std::int64_t>(values.size())}, values);
}

void add_cells(exchange::Message& message, const geometry::CutCells& cut, const geometry::GridLines& grid) {
  Runs full;
  std::vector<std::int64_t> cell, wall;
  std::vector<double> solid, debris, area, velocity;
  constexpr std::size_t stride = 3 * body_count;
  for (std::size_t e = 0; e < cut.cell.size(); ++e) {
    if (!cut.walled[e] && cut.debris_volume[e] == 0 && cut.solid_volume[e] >= grid.cell_volume(cut.cell[e])) {
      full.add(cut.cell[e]);
      continue;
    }
    cell.push_back(cut.cell[e]);
    solid.push_back(cut.solid_volume[e]);
    debris.push_back(cut.debris_volume[e]);
    if (!cut.walled[e]) continue;
    wall.push_back(cut.cell[e]);
    area.insert(area.end(), &cut.wall_area[stride * e], &cut.wall_area[stride * e] + stride);
    velocity.insert(velocity.end(), &cut.wall_velocity[stride * e], &cut.wall_velocity[stride * e] + stride);
  }
  add_column(message, "cell", cell);
  add_column(message, "solid_volume", solid);
  add_column(message, "debris_volume", debris);
  full.add_to(message, "cell.full");
  const auto walls = static_cast<std::int64_t>(wall.size());
  add_column(message, "wall", wall);
  message.add<double>("wall_area", {walls, body_count, 3}, area);
  message.add<double>("wall_velocity", {walls, body_count, 3}, velocity);
}

void add_faces(exchange::Message& message, const std::string& name, const geometry::CutFaces& faces) {
  Runs full;
  std::vector<std::int64_t> face;
  std::vector<double> solid;
  for (std::size_t f = 0; f < faces.face.size(); ++f) {
    if (faces.solid[f] == 1.0) {
      full.add(faces.face[f]);
      continue;
    }
    face.push_back(faces.face[f]);
    solid.push_back(faces.solid[f]);
  }
  add_column(message, name.c_str(), face);
  add_column(message, (name + ".solid").c_str(), solid);
  full.add_to(message, name + ".full");
}

}  // namespace

void add_overlap(exchange::Message& message, const geometry::CutCells& cut, const geometry::GridLines& grid) {
  add_cells(message, cut, grid);
  const char* names[] = {"face_x", "face_y", "face_z"};
  for (std::size_t d = 0; d < 3; ++d) add_faces(message, names[d], cut.faces[d]);
}

std::vector<double> read_at_walls(const exchange::Message& message, const std::string& name, std::size_t stride,
                                  const geometry::CutCells& cut) {
  const auto given = message.view<double>(name);
  const auto walls = static_cast<std::size_t>(std::count(cut.walled.begin(), cut.walled.end(), 1));
  if (given.size() != stride * walls)
    throw exchange::ProtocolError("message 'pressure': array '" + name + "' holds " + std::to_string(given.size()) +
                                  " values for " + std::to_string(walls) + " walls");
  std::vector<double> values(stride * cut.cell.size(), 0.0);
  const double* next = given.data();
  for (std::size_t e = 0; e < cut.walled.size(); ++e) {
    if (!cut.walled[e]) continue;
    std::copy(next, next + stride, &values[stride * e]);
    next += stride;
  }
  return values;
}

WallPressure read_pressure(const exchange::Message& message, const std::string& prefix, const geometry::CutCells& cut) {
  return {read_at_walls(message, prefix + "values", 1, cut), read_at_walls(message, prefix + "gradient_z", 1, cut)};
}

}  // namespace polynya::coupler
