#include "ice_solver/neighbour_list.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "core/compute/pack.hpp"
#include "core/compute/parallel.hpp"

namespace polynya::ice {
namespace {

using compute::Pack;
using compute::pack_width;

double largest(const std::vector<double>& values) {
  return values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
}

bool moved_too_far(const std::vector<double>& now, const std::vector<double>& then, double limit) {
  const double unmoved = 0.0;
  const double farthest = -compute::ordered_minimum(now.size() / 3, 4096, unmoved, [&](std::size_t i) {
    const double dx = now[3 * i] - then[3 * i], dy = now[3 * i + 1] - then[3 * i + 1],
                 dz = now[3 * i + 2] - then[3 * i + 2];
    return -(dx * dx + dy * dy + dz * dz);
  });
  return !(farthest <= limit * limit);
}

void require_finite(const std::vector<double>& position, const char* what) {
  for (std::size_t i = 0; i < position.size(); ++i)
    if (!std::isfinite(position[i]))
      throw std::runtime_error(std::string(what) + " " + std::to_string(i / 3) + " has a position that is no number");
}

}  // namespace

void NeighbourList::build(const Points& particles, const Points& elements, SymmetryPlanes planes, double skin,
                          bool bonds_only) {
  bonds_only_ = bonds_only;
  require_finite(particles.position, "particle");
  require_finite(elements.position, "background point");
  ++builds_;
  skin_ = skin;
  built_particles_ = particles.position;
  built_elements_ = elements.position;
  const double reach = 2 * std::max(largest(particles.smoothing_length), largest(elements.smoothing_length)) + skin;
  collect_points(particles, elements, planes, reach);
  sort_into_cells(reach);
  fill_rows(skin);
}

bool NeighbourList::outdated(const Points& particles, const Points& elements) const {
  if (particles.position.size() != built_particles_.size() || elements.position.size() != built_elements_.size())
    return true;
  return moved_too_far(particles.position, built_particles_, skin_ / 2) ||
         moved_too_far(elements.position, built_elements_, skin_ / 2);
}

std::size_t NeighbourList::entries() const {
  std::size_t sum = 0;
  for (const Row& row : rows_) sum += static_cast<std::size_t>(row.neighbours);
  return sum;
}

void NeighbourList::collect_points(const Points& particles, const Points& elements, SymmetryPlanes planes,
                                   double reach) {
  points_.clear();
  x_.clear(), y_.clear(), z_.clear(), h_.clear(), origin_.clear();
  const auto add_all = [&](const Points& set, bool element) {
    for (std::size_t i = 0; i < set.count(); ++i) {
      const double x = set.position[3 * i], y = set.position[3 * i + 1], z = set.position[3 * i + 2];
      for (std::uint8_t mirror = 0; mirror < 4; ++mirror) {
        if ((mirror & 1) && !(planes.x && x < reach)) continue;
        if ((mirror & 2) && !(planes.y && y < reach)) continue;
        const MirrorSigns sign(mirror);
        points_.push_back({static_cast<std::int32_t>(i), element, mirror});
        x_.push_back(sign.x * x), y_.push_back(sign.y * y), z_.push_back(z);
        h_.push_back(set.smoothing_length[i]);
        origin_.push_back(
            {sign.x * set.origin[3 * i], sign.y * set.origin[3 * i + 1], set.origin[3 * i + 2], set.bond_reach[i]});
      }
    }
  };
  add_all(particles, false);
  add_all(elements, true);
}

void NeighbourList::sort_into_cells(double cell) {
  const std::size_t n = points_.size();
  keys_.resize(n);
  if (n == 0) return;
  const auto [x0, x1] = std::minmax_element(x_.begin(), x_.end());
  const auto [y0, y1] = std::minmax_element(y_.begin(), y_.end());
  const double left = *x0, front = *y0, bottom = *std::min_element(z_.begin(), z_.end());
  // Two spare cells per row keep the neighbours of the last cell of one row apart from the first of the next.
  stride_y_ = static_cast<std::int64_t>((*x1 - left) / cell) + 3;
  stride_z_ = stride_y_ * (static_cast<std::int64_t>((*y1 - front) / cell) + 3);
  std::vector<std::pair<std::int64_t, std::int32_t>> order(n);
  for (std::size_t i = 0; i < n; ++i) {
    const auto column = static_cast<std::int64_t>((x_[i] - left) / cell);
    const auto row = static_cast<std::int64_t>((y_[i] - front) / cell);
    const auto layer = static_cast<std::int64_t>((z_[i] - bottom) / cell);
    order[i] = {column + stride_y_ * row + stride_z_ * layer, static_cast<std::int32_t>(i)};
  }
  std::sort(order.begin(), order.end());
  const auto permute = [&](auto& values) {
    auto copy = values;
    for (std::size_t i = 0; i < n; ++i) values[i] = copy[static_cast<std::size_t>(order[i].second)];
  };
  permute(points_), permute(x_), permute(y_), permute(z_), permute(h_), permute(origin_);
  for (std::size_t i = 0; i < n; ++i) keys_[i] = order[i].first;
}

std::array<NeighbourList::Range, 9> NeighbourList::ranges_around(std::int64_t key) const {
  std::array<Range, 9> ranges;
  std::size_t k = 0;
  for (std::int64_t layer = -1; layer <= 1; ++layer)
    for (std::int64_t line = -1; line <= 1; ++line, ++k) {
      const std::int64_t middle = key + line * stride_y_ + layer * stride_z_;
      const auto low = std::lower_bound(keys_.begin(), keys_.end(), middle - 1);
      const auto high = std::upper_bound(low, keys_.end(), middle + 1);
      ranges[k] = {static_cast<std::size_t>(low - keys_.begin()), static_cast<std::size_t>(high - keys_.begin())};
    }
  return ranges;
}

bool NeighbourList::bonded(std::size_t i, std::size_t j) const {
  const auto &a = origin_[i], &b = origin_[j];
  const double dx = a[0] - b[0], dy = a[1] - b[1], dz = a[2] - b[2], reach = a[3] + b[3];
  return dx * dx + dy * dy + dz * dz < reach * reach;
}

void NeighbourList::append_neighbours(std::size_t i, const Range& range, double skin,
                                      std::vector<std::int32_t>& buffer) const {
  const auto accept = [&](std::size_t j) {
    if (j == i || (points_[i].element && points_[j].element)) return;
    if (bonds_only_ && points_[i].element != points_[j].element && !bonded(i, j)) return;
    buffer.push_back(static_cast<std::int32_t>(j));
  };
  const double own_reach = h_[i] + skin;
  const Pack xi(x_[i]), yi(y_[i]), zi(z_[i]), reach(own_reach);
  std::size_t j = range.low;
  for (; j + pack_width <= range.high; j += pack_width) {
    const Pack dx = Pack(&x_[j], compute::aligned) - xi, dy = Pack(&y_[j], compute::aligned) - yi,
               dz = Pack(&z_[j], compute::aligned) - zi, limit = Pack(&h_[j], compute::aligned) + reach;
    const auto inside = dx * dx + dy * dy + dz * dz < limit * limit;
    if (none_of(inside)) continue;
    for (std::size_t lane = 0; lane < pack_width; ++lane)
      if (inside[lane]) accept(j + lane);
  }
  for (; j < range.high; ++j) {
    const double dx = x_[j] - x_[i], dy = y_[j] - y_[i], dz = z_[j] - z_[i], limit = h_[j] + own_reach;
    if (dx * dx + dy * dy + dz * dz < limit * limit) accept(j);
  }
}

void NeighbourList::fill_rows(double skin) {
  rows_.clear();
  for (std::size_t i = 0; i < points_.size(); ++i)
    if (points_[i].mirror == 0) rows_.push_back({static_cast<std::int32_t>(i), 0, 0, 0});
  buffers_.resize((rows_.size() + chunk - 1) / chunk);

  compute::for_chunks(rows_.size(), chunk, [&](std::size_t begin, std::size_t end) {
    std::vector<std::int32_t>& buffer = buffers_[begin / chunk];
    buffer.clear();
    std::array<Range, 9> ranges{};
    std::int64_t ranges_of = -1;
    for (std::size_t r = begin; r < end; ++r) {
      Row& row = rows_[r];
      const auto i = static_cast<std::size_t>(row.point);
      if (keys_[i] != ranges_of) ranges = ranges_around(ranges_of = keys_[i]);
      row.first = static_cast<std::int32_t>(buffer.size());
      for (const Range& range : ranges) append_neighbours(i, range, skin, buffer);
      row.neighbours = static_cast<std::int32_t>(buffer.size()) - row.first;
      row.length = static_cast<std::int32_t>(compute::padded(static_cast<std::size_t>(row.neighbours)));
      buffer.resize(static_cast<std::size_t>(row.first + row.length), empty_point());
    }
  });
}

}  // namespace polynya::ice
