#include "fluid_solver/groups.hpp"

#include <algorithm>
#include <array>
#include <deque>
#include <numeric>
#include <unordered_map>

namespace polynya::fluid {
namespace {

/// A change of partner is felt as a small jolt, so a cell keeps the one it had until another is so much better.
constexpr double faithfulness = 5.0;

/// Builds the groups of one step as a forest: an edge is added only between different sets.
class Builder {
 public:
  Builder(const Grid& grid, const CutGeometry& before, const CutGeometry& after, const Groups& previous,
          std::vector<std::int32_t>& label)
      : grid_(grid), before_(before), after_(after), label_(label) {
    for (const Groups::Member& member : previous.members) {
      if (member.parent < 0) continue;
      joined_before_.push_back({member.cell, member.parent});
      joined_before_.push_back({member.parent, member.cell});
    }
    std::sort(joined_before_.begin(), joined_before_.end());
  }

  Groups build() {
    for (const std::ptrdiff_t c : small_cells()) local(c);
    const std::size_t small = cells_.size();
    for (std::size_t l = 0; l < small; ++l) join_best_neighbour(l);
    enlarge();
    Groups groups = ordered_groups();
    for (const std::ptrdiff_t c : cells_) label_[c] = -1;
    return groups;
  }

 private:
  double least(std::ptrdiff_t c) const { return std::min(before_.volume[c], after_.volume[c]); }
  double most(std::ptrdiff_t c) const { return std::max(before_.volume[c], after_.volume[c]); }
  bool is_small(std::ptrdiff_t c) const { return least(c) < 0.5 * grid_.cell_volume[c]; }
  double openness(std::ptrdiff_t c, int side) const {
    const std::ptrdiff_t f = side % 2 ? c + grid_.stride(side / 2) : c;
    return 0.5 * (before_.open[side / 2][f] + after_.open[side / 2][f]);
  }
  std::ptrdiff_t neighbour(std::ptrdiff_t c, int side) const {
    return side % 2 ? c + grid_.stride(side / 2) : c - grid_.stride(side / 2);
  }

  std::vector<std::ptrdiff_t> small_cells() const {
    std::vector<std::ptrdiff_t> small;
    for (const CutGeometry* geometry : {&before_, &after_}) {
      for (const WallPiece& wall : geometry->walls) {
        if (most(wall.cell) > 0 && is_small(wall.cell)) small.push_back(wall.cell);
      }
    }
    std::sort(small.begin(), small.end());
    small.erase(std::unique(small.begin(), small.end()), small.end());
    return small;
  }

  std::int32_t local(std::ptrdiff_t c) {
    if (label_[c] >= 0) return label_[c];
    label_[c] = static_cast<std::int32_t>(cells_.size());
    cells_.push_back(c);
    set_.push_back(label_[c]);
    held_.push_back(least(c));
    edges_.emplace_back();
    return label_[c];
  }

  std::int32_t find(std::int32_t l) {
    while (set_[l] != l) l = set_[l] = set_[set_[l]];
    return l;
  }

  void join(std::ptrdiff_t a, std::ptrdiff_t b) {
    const std::int32_t la = local(a), lb = local(b);
    const std::int32_t ra = find(la), rb = find(lb);
    if (ra == rb) return;
    set_[std::max(ra, rb)] = std::min(ra, rb);
    held_[std::min(ra, rb)] += held_[std::max(ra, rb)];
    edges_[la].push_back(b);
    edges_[lb].push_back(a);
  }

  /// The neighbour outside the cell's set that it is most open to; cells that need no partner themselves come first.
  std::ptrdiff_t best_neighbour(std::ptrdiff_t c, double& best, bool through_walls) {
    std::ptrdiff_t chosen = -1;
    const std::int32_t own = find(local(c));
    for (int side = 0; side < 6; ++side) {
      const std::ptrdiff_t other = neighbour(c, side);
      if (!grid_.inside(other) || most(other) <= 0) continue;
      if (label_[other] >= 0 && find(label_[other]) == own) continue;
      const double open = through_walls ? 1.0 : openness(c, side);
      const double score = (before_.volume[other] + after_.volume[other]) * open * (is_small(other) ? 0.25 : 1.0) *
                           (were_joined(c, other) ? faithfulness : 1.0);
      if (score > best) {
        best = score;
        chosen = other;
      }
    }
    return chosen;
  }

  bool were_joined(std::ptrdiff_t a, std::ptrdiff_t b) const {
    return std::binary_search(joined_before_.begin(), joined_before_.end(), std::pair{a, b});
  }

  void join_best_neighbour(std::size_t l) {
    double best = 0;
    const std::ptrdiff_t c = cells_[l], other = best_neighbour(c, best, false);
    if (other >= 0) join(c, other);
  }

  /// Lets every group that still holds less than half a cell join on, first through openings, then through walls.
  void enlarge() {
    for (int pass = 0; pass < 64; ++pass) {
      std::vector<std::vector<std::int32_t>> sets(cells_.size());
      const std::size_t number = cells_.size();
      for (std::size_t l = 0; l < number; ++l)
        sets[find(static_cast<std::int32_t>(l))].push_back(static_cast<std::int32_t>(l));
      bool changed = false;
      for (std::size_t s = 0; s < number; ++s) {
        if (sets[s].empty() || find(static_cast<std::int32_t>(s)) != static_cast<std::int32_t>(s)) continue;
        if (held_[s] >= 0.5 * grid_.cell_volume[cells_[sets[s][0]]]) continue;
        changed = enlarge_set(sets[s]) || changed;
      }
      if (!changed) return;
    }
  }

  bool enlarge_set(const std::vector<std::int32_t>& set) {
    for (const bool through_walls : {false, true}) {
      double best = 0;
      std::ptrdiff_t from = -1, to = -1;
      for (const std::int32_t l : set) {
        const std::ptrdiff_t other = best_neighbour(cells_[l], best, through_walls);
        if (other >= 0) from = cells_[l], to = other;
      }
      if (to >= 0) {
        sealed_ += through_walls;
        join(from, to);
        return true;
      }
    }
    return join_nearest_fluid(cells_[set[0]]);
  }

  /// Joins the cells on the shortest way, through solid cells, to the nearest cell with fluid of another set.
  bool join_nearest_fluid(std::ptrdiff_t start) {
    const std::int32_t own = find(local(start));
    std::unordered_map<std::ptrdiff_t, std::ptrdiff_t> came_from{{start, -1}};
    std::deque<std::ptrdiff_t> queue{start};
    while (!queue.empty()) {
      const std::ptrdiff_t c = queue.front();
      queue.pop_front();
      const bool of_own = label_[c] >= 0 && find(label_[c]) == own;
      if (!of_own && most(c) > 0) {
        for (std::ptrdiff_t at = c; came_from[at] >= 0; at = came_from[at]) join(at, came_from[at]);
        ++sealed_;
        return true;
      }
      for (int side = 0; side < 6; ++side) {
        const std::ptrdiff_t other = neighbour(c, side);
        if (grid_.inside(other) && came_from.emplace(other, c).second) queue.push_back(other);
      }
    }
    return false;  // there is no other fluid
  }

  Groups ordered_groups() {
    Groups groups;
    groups.sealed = sealed_;
    std::vector<std::int32_t> root(cells_.size(), -1);
    for (std::size_t l = 0; l < cells_.size(); ++l) {
      std::int32_t& r = root[find(static_cast<std::int32_t>(l))];
      if (r < 0 || least(cells_[l]) > least(cells_[r])) r = static_cast<std::int32_t>(l);
    }
    for (std::size_t s = 0; s < cells_.size(); ++s) {
      if (root[s] < 0) continue;
      groups.first.push_back(groups.members.size());
      groups.members.push_back({cells_[root[s]], -1});
      for (std::size_t m = groups.first.back(); m < groups.members.size(); ++m) {
        const Groups::Member here = groups.members[m];
        for (const std::ptrdiff_t next : edges_[label_[here.cell]]) {
          if (next != here.parent) groups.members.push_back({next, here.cell});
        }
      }
    }
    groups.first.push_back(groups.members.size());
    return groups;
  }

  const Grid& grid_;
  const CutGeometry &before_, &after_;
  std::vector<std::int32_t>& label_;
  std::vector<std::ptrdiff_t> cells_;
  std::vector<std::int32_t> set_;
  std::vector<double> held_;  ///< least volume of the set, valid at its representative
  std::vector<std::vector<std::ptrdiff_t>> edges_;
  std::vector<std::pair<std::ptrdiff_t, std::ptrdiff_t>> joined_before_;  ///< both ways, sorted
  long sealed_ = 0;
};

}  // namespace

Groups find_groups(const Grid& grid, const CutGeometry& before, const CutGeometry& after, const Groups& previous,
                   std::vector<std::int32_t>& label) {
  return Builder(grid, before, after, previous, label).build();
}

}  // namespace polynya::fluid
