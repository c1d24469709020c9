#include "fluid_solver/overlap_message.hpp"

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "core/exchange/errors.hpp"

namespace polynya::fluid {
namespace {

[[noreturn]] void refuse(const exchange::Message& message, const std::string& what) {
  throw exchange::ProtocolError("message '" + message.kind() + "': " + what);
}

std::span<const double> values(const exchange::Message& message, const std::string& name, std::size_t expected) {
  const auto view = message.view<double>(name);
  if (view.size() != expected)
    refuse(message, "array '" + name + "' holds " + std::to_string(view.size()) + " values, expected " +
                        std::to_string(expected));
  return view;
}

/// Numbers of cells or faces, at most `count` of them, in two arrays: listed one by one, and in runs ([runs][2], first
/// and how many). Both ascend, and no number is named twice.
struct Numbers {
  std::span<const std::int64_t> listed, runs;

  Numbers(const exchange::Message& message, const std::string& name, std::int64_t count)
      : listed(message.view<std::int64_t>(name)), runs(message.view<std::int64_t>(name + ".full")) {
    check_listed(message, name, count);
    check_runs(message, name + ".full", count);
    for (std::size_t r = 0; r < runs.size(); r += 2) {
      const auto inside = std::lower_bound(listed.begin(), listed.end(), runs[r]);
      if (inside != listed.end() && *inside < runs[r] + runs[r + 1])
        refuse(message, "number " + std::to_string(*inside) + " is both in '" + name + "' and in a run of '" + name +
                            ".full'; what is wholly solid is named in runs only");
    }
  }

  /// Calls listed(position, number) and full(number) in ascending order.
  template <class Listed, class Full>
  void walk(Listed&& one_by_one, Full&& full) const {
    std::size_t next = 0;
    for (std::size_t r = 0; r < runs.size(); r += 2) {
      for (; next < listed.size() && listed[next] < runs[r]; ++next) one_by_one(next, listed[next]);
      for (std::int64_t n = runs[r]; n < runs[r] + runs[r + 1]; ++n) full(n);
    }
    for (; next < listed.size(); ++next) one_by_one(next, listed[next]);
  }

 private:
  void check_listed(const exchange::Message& message, const std::string& name, std::int64_t count) const {
    std::int64_t least = 0;
    for (const std::int64_t number : listed) {
      if (number < least || number >= count)
        refuse(message, "number " + std::to_string(number) + " in '" + name + "' follows " + std::to_string(least - 1) +
                            "; numbers ascend, each once, from 0 to " + std::to_string(count - 1));
      least = number + 1;
    }
  }
  void check_runs(const exchange::Message& message, const std::string& name, std::int64_t count) const {
    const std::vector<std::int64_t>& shape = message.array(name).shape;
    if (shape.size() != 2 || shape[1] != 2) {
      std::string found;
      for (const std::int64_t length : shape) found += "[" + std::to_string(length) + "]";
      refuse(message,
             "array '" + name + "' has the shape " + found + ", expected [r][2]: first and how many of each run");
    }
    std::int64_t end = 0;
    for (std::size_t r = 0; r < runs.size(); r += 2) {
      if (runs[r] < end || runs[r + 1] < 0 || runs[r + 1] > count - runs[r])
        refuse(message, "run " + std::to_string(r / 2) + " of '" + name + "' is " + std::to_string(runs[r + 1]) +
                            " from " + std::to_string(runs[r]) + " on; runs ascend and end at " +
                            std::to_string(count) + " at the latest");
      end = runs[r] + runs[r + 1];
    }
  }
};

void read_walls(const exchange::Message& message, Overlap& overlap) {
  const auto walls = message.view<std::int64_t>("wall");
  const auto area = values(message, "wall_area", 6 * walls.size());
  const auto velocity = values(message, "wall_velocity", 6 * walls.size());
  overlap.walled.assign(walls.begin(), walls.end());
  overlap.wall_area.assign(6 * overlap.cell.size(), 0.0);
  overlap.wall_velocity.assign(6 * overlap.cell.size(), 0.0);
  std::span<const double> size, sweep;
  if (message.has("wall_size")) {
    size = values(message, "wall_size", walls.size());
    overlap.wall_size.assign(overlap.cell.size(), 0.0);
  }
  if (message.has("wall_sweep")) {
    sweep = values(message, "wall_sweep", 2 * walls.size());
    overlap.wall_sweep.assign(2 * overlap.cell.size(), 0.0);
  }
  auto at = overlap.cell.begin();
  for (std::size_t w = 0; w < walls.size(); ++w) {
    at = std::lower_bound(at, overlap.cell.end(), walls[w]);
    if (at == overlap.cell.end() || *at != walls[w])
      refuse(message, "cell " + std::to_string(walls[w]) + " of 'wall' is not in 'cell', or not in ascending order");
    const std::ptrdiff_t m = at++ - overlap.cell.begin();
    std::copy_n(&area[6 * w], 6, &overlap.wall_area[6 * m]);
    std::copy_n(&velocity[6 * w], 6, &overlap.wall_velocity[6 * m]);
    if (!size.empty()) overlap.wall_size[static_cast<std::size_t>(m)] = size[w];
    if (!sweep.empty()) std::copy_n(&sweep[2 * w], 2, &overlap.wall_sweep[2 * m]);
  }
}

}  // namespace

Overlap read_overlap(const exchange::Message& message, const Grid& grid) {
  Overlap overlap;
  const Numbers cells(message, "cell", static_cast<std::int64_t>(grid.cells()));
  const auto solid = values(message, "solid_volume", cells.listed.size()),
             debris = values(message, "debris_volume", cells.listed.size());
  const auto add = [&](std::int64_t cell, double solid_volume, double debris_volume) {
    overlap.cell.push_back(cell);
    overlap.solid_volume.push_back(solid_volume);
    overlap.debris_volume.push_back(debris_volume);
  };
  cells.walk([&](std::size_t m, std::int64_t cell) { add(cell, solid[m], debris[m]); },
             [&](std::int64_t cell) { add(cell, grid.cell_volume[grid.from_message(cell)], 0.0); });
  read_walls(message, overlap);
  constexpr std::array<const char*, 3> names{"face_x", "face_y", "face_z"};
  for (int axis = 0; axis < 3; ++axis) {
    const std::string name = names[axis];
    const Numbers faces(message, name, grid.face_count(axis));
    const auto fraction = values(message, name + ".solid", faces.listed.size());
    const auto add_face = [&](std::int64_t face, double part) {
      overlap.face[axis].push_back(face);
      overlap.face_solid[axis].push_back(part);
    };
    faces.walk([&](std::size_t m, std::int64_t face) { add_face(face, fraction[m]); },
               [&](std::int64_t face) { add_face(face, 1.0); });
  }
  return overlap;
}

}  // namespace polynya::fluid
