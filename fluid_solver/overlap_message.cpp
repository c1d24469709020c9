#include "fluid_solver/overlap_message.hpp"

#include <algorithm>
#include <span>
#include <string>

#include "core/exchange/errors.hpp"

namespace polynya::fluid {
namespace {

using Numbers = std::span<const std::int64_t>;

std::span<const double> values(const exchange::Message& message, const std::string& name, std::size_t expected) {
  const auto view = message.view<double>(name);
  if (view.size() != expected)
    throw exchange::ProtocolError("message '" + message.kind() + "': array '" + name + "' holds " +
                                  std::to_string(view.size()) + " values, expected " + std::to_string(expected));
  return view;
}

/// Goes through listed numbers and those of runs ([runs][2], first and how many) in ascending order:
/// listed(position, number), full(number).
template <class Listed, class Full>
void walk(Numbers numbers, Numbers runs, Listed&& listed, Full&& full) {
  std::size_t next = 0;
  for (std::size_t r = 0; r + 1 < runs.size(); r += 2) {
    for (; next < numbers.size() && numbers[next] < runs[r]; ++next) listed(next, numbers[next]);
    for (std::int64_t n = runs[r]; n < runs[r] + runs[r + 1]; ++n) full(n);
  }
  for (; next < numbers.size(); ++next) listed(next, numbers[next]);
}

void check_runs(const exchange::Message& message, const std::string& name, Numbers runs, std::int64_t last) {
  std::int64_t end = 0;
  for (std::size_t r = 0; r + 1 < runs.size(); r += 2) {
    if (runs[r] < end || runs[r + 1] < 0 || runs[r + 1] > last - runs[r])
      throw exchange::ProtocolError("message '" + message.kind() + "': run " + std::to_string(r / 2) + " of '" + name +
                                    "' is " + std::to_string(runs[r + 1]) + " from " + std::to_string(runs[r]) +
                                    " on; runs ascend and end at " + std::to_string(last) + " at the latest");
    end = runs[r] + runs[r + 1];
  }
}

void read_walls(const exchange::Message& message, Overlap& overlap) {
  const auto walls = message.view<std::int64_t>("wall");
  const auto area = values(message, "wall_area", 6 * walls.size());
  const auto velocity = values(message, "wall_velocity", 6 * walls.size());
  overlap.walled.assign(walls.begin(), walls.end());
  overlap.wall_area.assign(6 * overlap.cell.size(), 0.0);
  overlap.wall_velocity.assign(6 * overlap.cell.size(), 0.0);
  auto at = overlap.cell.begin();
  for (std::size_t w = 0; w < walls.size(); ++w) {
    at = std::lower_bound(at, overlap.cell.end(), walls[w]);
    if (at == overlap.cell.end() || *at != walls[w])
      throw exchange::ProtocolError("message '" + message.kind() + "': cell " + std::to_string(walls[w]) +
                                    " of 'wall' is not in 'cell', or not in ascending order");
    const std::ptrdiff_t m = at - overlap.cell.begin();
    std::copy_n(&area[6 * w], 6, &overlap.wall_area[6 * m]);
    std::copy_n(&velocity[6 * w], 6, &overlap.wall_velocity[6 * m]);
  }
}

}  // namespace

Overlap read_overlap(const exchange::Message& message, const Grid& grid) {
  Overlap overlap;
  const auto cells = message.view<std::int64_t>("cell"), full = message.view<std::int64_t>("cell.full");
  const auto solid = values(message, "solid_volume", cells.size()),
             debris = values(message, "debris_volume", cells.size());
  check_runs(message, "cell.full", full, static_cast<std::int64_t>(grid.cells()));
  const auto add = [&](std::int64_t cell, double solid_volume, double debris_volume) {
    overlap.cell.push_back(cell);
    overlap.solid_volume.push_back(solid_volume);
    overlap.debris_volume.push_back(debris_volume);
  };
  walk(
      cells, full, [&](std::size_t m, std::int64_t cell) { add(cell, solid[m], debris[m]); },
      [&](std::int64_t cell) { add(cell, grid.cell_volume[grid.from_message(cell)], 0.0); });
  read_walls(message, overlap);
  constexpr std::array<const char*, 3> names{"face_x", "face_y", "face_z"};
  for (int axis = 0; axis < 3; ++axis) {
    const std::string name = names[axis];
    const auto faces = message.view<std::int64_t>(name), runs = message.view<std::int64_t>(name + ".full");
    const auto fraction = values(message, name + ".solid", faces.size());
    check_runs(message, name + ".full", runs, grid.face_count(axis));
    const auto add_face = [&](std::int64_t face, double part) {
      overlap.face[axis].push_back(face);
      overlap.face_solid[axis].push_back(part);
    };
    walk(
        faces, runs, [&](std::size_t m, std::int64_t face) { add_face(face, fraction[m]); },
        [&](std::int64_t face) { add_face(face, 1.0); });
  }
  return overlap;
}

}  // namespace polynya::fluid
