#include "coupler/fluid_side.hpp"

#include <algorithm>
#include <utility>

#include "core/contact/vector3.hpp"
#include "core/exchange/errors.hpp"
#include "coupler/solid_side.hpp"

namespace polynya::coupler {

namespace {

void place_planes(FluidSide& side) {
  for (std::size_t p = 0; p < side.first_z.size(); ++p) side.grid.lines[2][p] = side.first_z[p] + side.grid_shift;
}

}  // namespace

FluidSide read_fluid_ready(const std::string& name, const exchange::Message& ready) {
  FluidSide side;
  side.name = name;
  side.stable_step = ready.header.at("stable_step").get<double>();
  side.can_checkpoint = ready.header.value("can_checkpoint", false);
  side.forecasts = ready.header.value("forecasts", false);
  side.ready_time = ready.header.value("time", 0.0);
  side.account.set_names(ready);
  const auto line = [&](const char* array) {
    const auto values = ready.view<double>(array);
    if (values.size() < 2)
      throw exchange::ProtocolError("participant '" + name + "': array '" + array + "' needs at least two coordinates");
    return std::vector<double>(values.begin(), values.end());
  };
  side.grid.lines = {line("grid.x"), line("grid.y"), line("grid.z")};
  side.first_z = side.grid.lines[2];
  side.grid_follows = ready.header.contains("grid_shift");
  side.grid_shift = ready.header.value("grid_shift", 0.0);
  place_planes(side);
  return side;
}

void FluidSide::read_answer_header(const exchange::Message& answer) {
  stable_step = answer.header.at("stable_step").get<double>();
  if (grid_follows) grid_speed = answer.header.at("grid_speed").get<double>();
}

void FluidSide::move_grid(double span) {
  grid_shift += grid_speed * span;
  place_planes(*this);
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
  void move_to(exchange::Message& message, std::string name) {
    const auto count = static_cast<std::int64_t>(rows_.size() / 2);
    message.add(std::move(name), {count, 2}, std::move(rows_));
  }

 private:
  std::vector<std::int64_t> rows_;  ///< [runs][2], first and how many
};

/// Volumes of cells in ascending order: within a row of the grid only the width along x changes.
class RowVolumes {
 public:
  explicit RowVolumes(const geometry::GridLines& grid) : grid_(grid) {}
  double operator()(std::int64_t cell) {
    if (cell >= end_) {
      const auto [i, j, k] = grid_.cell_position(cell);
      begin_ = cell - i;
      end_ = begin_ + grid_.cells(0);
      width_y_ = grid_.width(1, j);
      width_z_ = grid_.width(2, k);
    }
    return grid_.width(0, cell - begin_) * width_y_ * width_z_;
  }

 private:
  const geometry::GridLines& grid_;
  std::int64_t begin_ = 0, end_ = 0;
  double width_y_ = 0, width_z_ = 0;
};

template <class T>
void add_column(exchange::Message& message, const std::string& name, std::vector<T>&& values) {
  const auto count = static_cast<std::int64_t>(values.size());
  message.add(name, {count}, std::move(values));
}

/// Rows of `values` ([..][stride]) with these numbers.
template <class T>
std::vector<T> rows(const std::vector<T>& values, const std::vector<std::uint32_t>& numbers, std::size_t stride = 1) {
  std::vector<T> found(stride * numbers.size());
  T* next = found.data();
  for (const std::uint32_t number : numbers) {
    std::copy_n(values.data() + stride * number, stride, next);
    next += stride;
  }
  return found;
}

void add_cells(exchange::Message& message, const geometry::CutCells& cut, const geometry::GridLines& grid) {
  Runs full;
  RowVolumes volume(grid);
  std::vector<std::uint32_t> listed, walled;
  for (std::size_t e = 0; e < cut.cell.size(); ++e) {
    if (!cut.walled[e] && cut.debris_volume[e] == 0 && cut.solid_volume[e] >= volume(cut.cell[e])) {
      full.add(cut.cell[e]);
      continue;
    }
    listed.push_back(static_cast<std::uint32_t>(e));
    if (cut.walled[e]) walled.push_back(static_cast<std::uint32_t>(e));
  }
  add_column(message, "cell", rows(cut.cell, listed));
  add_column(message, "solid_volume", rows(cut.solid_volume, listed));
  add_column(message, "debris_volume", rows(cut.debris_volume, listed));
  full.move_to(message, "cell.full");
  const auto walls = static_cast<std::int64_t>(walled.size());
  add_column(message, "wall", rows(cut.cell, walled));
  message.add("wall_area", {walls, body_count, 3}, rows(cut.wall_area, walled, 3 * body_count));
  message.add("wall_velocity", {walls, body_count, 3}, rows(cut.wall_velocity, walled, 3 * body_count));
  std::vector<double> size(cut.cell.size(), 0.0);
  for (const geometry::WallPiece& piece : cut.pieces)
    size[static_cast<std::size_t>(piece.entry)] += contact::norm(piece.area);
  add_column(message, "wall_size", rows(size, walled));
  message.add("wall_sweep", {walls, body_count}, rows(cut.wall_sweep, walled, body_count));
}

void add_faces(exchange::Message& message, const std::string& name, const geometry::CutFaces& faces) {
  Runs full;
  std::vector<std::uint32_t> listed;
  for (std::size_t f = 0; f < faces.face.size(); ++f)
    if (faces.solid[f] == 1.0)
      full.add(faces.face[f]);
    else
      listed.push_back(static_cast<std::uint32_t>(f));
  add_column(message, name, rows(faces.face, listed));
  add_column(message, name + ".solid", rows(faces.solid, listed));
  full.move_to(message, name + ".full");
}

/// Any array of a `pressure` message that has `stride` values per wall.
std::span<const double> values_at_walls(const exchange::Message& message, const std::string& name, std::size_t stride,
                                        std::size_t walls) {
  const auto given = message.view<double>(name);
  if (given.size() != stride * walls)
    throw exchange::ProtocolError("message 'pressure': array '" + name + "' holds " + std::to_string(given.size()) +
                                  " values for " + std::to_string(walls) + " walls");
  return given;
}

}  // namespace

void add_overlap(exchange::Message& message, const geometry::CutCells& cut, const geometry::GridLines& grid) {
  add_cells(message, cut, grid);
  const char* names[] = {"face_x", "face_y", "face_z"};
  for (std::size_t d = 0; d < 3; ++d) add_faces(message, names[d], cut.faces[d]);
}

WallPressure read_pressure(const exchange::Message& message, const std::string& prefix, const geometry::CutCells& cut) {
  const auto walls = static_cast<std::size_t>(std::count(cut.walled.begin(), cut.walled.end(), 1));
  const auto value = values_at_walls(message, prefix + "values", 1, walls),
             gradient_z = values_at_walls(message, prefix + "gradient_z", 1, walls);
  WallPressure pressure{std::vector<double>(cut.cell.size()), std::vector<double>(cut.cell.size())};
  for (std::size_t e = 0, wall = 0; e < cut.cell.size(); ++e) {
    if (!cut.walled[e]) continue;
    pressure.value[e] = value[wall];
    pressure.gradient_z[e] = gradient_z[wall++];
  }
  return pressure;
}

FluidAnswer read_answer(const exchange::Message& message, std::size_t walls_before, std::size_t walls, bool forecasts) {
  const auto pressure = [&](const std::string& prefix, std::size_t count) {
    return WallPressureView{values_at_walls(message, prefix + "values", 1, count),
                            values_at_walls(message, prefix + "gradient_z", 1, count)};
  };
  FluidAnswer answer{pressure("pressure.previous_", walls_before), pressure("pressure.", walls), {}, {}, {}};
  if (message.has("pressure.impulse"))
    answer.impulse = values_at_walls(message, "pressure.impulse", 3 * body_count, walls);
  if (!forecasts) return answer;
  answer.forecast = values_at_walls(message, "pressure.forecast", 1, walls);
  answer.impedance = values_at_walls(message, "pressure.impedance", 1, walls);
  return answer;
}

}  // namespace polynya::coupler
