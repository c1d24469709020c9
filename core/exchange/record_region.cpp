#include "core/exchange/record_region.hpp"

#include <algorithm>

#include "core/exchange/wire.hpp"

namespace polynya::exchange {
namespace {

constexpr std::array<const char*, 3> line_names{"grid.x", "grid.y", "grid.z"};
constexpr std::array<const char*, 3> face_names{"face_x", "face_y", "face_z"};

bool is_one_of(const std::string& name, std::initializer_list<const char*> names) {
  return std::any_of(names.begin(), names.end(), [&](const char* other) { return name == other; });
}

Array rows_of(const Array& array, const std::vector<bool>& mask) {
  if (array.shape.empty() || array.shape[0] != static_cast<std::int64_t>(mask.size())) return array;
  const std::size_t size = mask.empty() ? 0 : array.bytes.size() / mask.size();
  Array kept{array.name, array.type, array.shape, {}};
  kept.shape[0] = std::count(mask.begin(), mask.end(), true);
  std::vector<std::byte> bytes;
  bytes.reserve(static_cast<std::size_t>(kept.shape[0]) * size);
  for (std::size_t row = 0; row < mask.size(); ++row) {
    if (!mask[row]) continue;
    const auto first = array.bytes.begin() + static_cast<std::ptrdiff_t>(row * size);
    bytes.insert(bytes.end(), first, first + static_cast<std::ptrdiff_t>(size));
  }
  kept.bytes = Bytes(std::move(bytes));
  return kept;
}

}  // namespace

bool RecordRegion::inside(const std::array<double, 3>& point) const {
  for (int d = 0; d < 3; ++d)
    if (!(point[d] >= box_[d] && point[d] <= box_[d + 3])) return false;
  return true;
}

void RecordRegion::note_vertices(const Message& message) {
  const auto positions = message.view<double>("positions");
  vertices_.assign(positions.size() / 3, false);
  for (std::size_t v = 0; v < vertices_.size(); ++v)
    vertices_[v] = inside({positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]});
  if (!message.has("surface.triangles")) return;
  const auto corners = message.view<std::int32_t>("surface.triangles");
  triangles_.assign(corners.size() / 3, true);
  for (std::size_t c = 0; c < 3 * triangles_.size(); ++c) {
    const auto vertex = static_cast<std::size_t>(corners[c]);
    if (vertex >= vertices_.size() || !vertices_[vertex]) triangles_[c / 3] = false;
  }
}

/// Centre of a cell, or of a face across the axis, by its number in the grid (docs/protocol.md, section 5).
std::array<double, 3> RecordRegion::place(std::int64_t index, int face_axis) const {
  std::array<double, 3> centre{};
  for (int d = 0; d < 3; ++d) {
    const auto lines = static_cast<std::int64_t>(lines_[d].size());
    const std::int64_t extent = std::max<std::int64_t>(d == face_axis ? lines : lines - 1, 1);
    const auto line = static_cast<std::size_t>(d == 2 ? index : index % extent);
    index /= extent;
    const std::size_t next = d == face_axis ? line : line + 1;
    if (next < lines_[d].size()) centre[d] = 0.5 * (lines_[d][line] + lines_[d][next]);
  }
  centre[2] += shift_;
  return centre;
}

void RecordRegion::note_cells(const Message& message) {
  const auto mask = [&](const char* name, int face_axis) {
    Mask kept;
    for (const std::int64_t index : message.view<std::int64_t>(name)) kept.push_back(inside(place(index, face_axis)));
    return kept;
  };
  walls_before_ = std::move(walls_);
  walls_ = mask("wall", -1);
  cells_ = mask("cell", -1);
  for (int axis = 0; axis < 3; ++axis)
    if (message.has(face_names[axis])) faces_[axis] = mask(face_names[axis], axis);
}

/// The parts of runs (first and how many) that lie inside.
Array RecordRegion::runs_inside(const Message& message, const std::string& name, int face_axis) const {
  std::vector<std::int64_t> kept;
  const auto runs = message.view<std::int64_t>(name);
  for (std::size_t r = 0; r + 1 < runs.size(); r += 2)
    for (std::int64_t index = runs[r]; index < runs[r] + runs[r + 1]; ++index) {
      if (!inside(place(index, face_axis))) continue;
      if (!kept.empty() && kept[kept.size() - 2] + kept.back() == index)
        ++kept.back();
      else
        kept.insert(kept.end(), {index, 1});
    }
  Message part;
  part.add<std::int64_t>(name, {static_cast<std::int64_t>(kept.size() / 2), 2}, kept);
  return std::move(part.arrays.front());
}

const RecordRegion::Mask* RecordRegion::mask_for(const std::string& name) const {
  if (is_one_of(name, {"positions", "velocities", "surface.ids", "surface.masses", "surface.rigid_masses", "surface.radius", "surface.volume"}))
    return &vertices_;
  if (name == "surface.triangles") return &triangles_;
  if (is_one_of(name, {"load.vertices", "load.forces"})) return &loads_;
  if (is_one_of(name, {"cell", "solid_volume", "debris_volume"})) return &cells_;
  if (is_one_of(name, {"wall", "wall_area", "wall_velocity", "wall_size", "wall_sweep"})) return &walls_;
  for (int axis = 0; axis < 3; ++axis)
    if (name.starts_with(face_names[axis])) return &faces_[axis];
  if (name.starts_with("pressure.previous_")) return &walls_before_;
  if (name.starts_with("pressure.")) return &walls_;
  return nullptr;
}

Message RecordRegion::restrict(const Message& message) {
  for (int d = 0; d < 3; ++d)
    if (message.has(line_names[d])) {
      const auto line = message.view<double>(line_names[d]);
      lines_[d].assign(line.begin(), line.end());
    }
  shift_ = message.header.value("grid_shift", shift_);
  if (message.has("positions")) note_vertices(message);
  if (message.has("cell")) note_cells(message);
  if (message.has("load.vertices")) {
    loads_.clear();
    for (const std::int64_t vertex : message.view<std::int64_t>("load.vertices"))
      loads_.push_back(static_cast<std::size_t>(vertex) < vertices_.size() &&
                       vertices_[static_cast<std::size_t>(vertex)]);
  }
  Message part;
  part.header = message.header;
  for (const Array& array : message.arrays) {
    if (array.name.ends_with(".full")) {
      int axis = 2;
      while (axis >= 0 && !array.name.starts_with(face_names[axis])) --axis;
      part.arrays.push_back(runs_inside(message, array.name, axis));  // no axis: of cells
      continue;
    }
    const Mask* mask = mask_for(array.name);
    part.arrays.push_back(mask == nullptr ? array : rows_of(array, *mask));
  }
  if (message.has("positions")) {
    std::vector<std::int64_t> kept;
    for (std::size_t v = 0; v < vertices_.size(); ++v)
      if (vertices_[v]) kept.push_back(static_cast<std::int64_t>(v));
    part.add<std::int64_t>("region.vertices", {static_cast<std::int64_t>(kept.size())}, kept);
  }
  return part;
}

}  // namespace polynya::exchange
