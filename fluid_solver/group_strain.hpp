#pragma once
#include <algorithm>
#include <vector>

#include "fluid_solver/fluid.hpp"

/// How a change of volume strains the members of a group.
namespace polynya::fluid {

/// The members of a group.
struct MembersOfGroup {
  const Groups::Member *first, *last;
  const Groups::Member* begin() const { return first; }
  const Groups::Member* end() const { return last; }
};

inline MembersOfGroup members_of(const Groups& groups, std::size_t g) {
  return {groups.members.data() + groups.first[g], groups.members.data() + groups.first[g + 1]};
}

/// Index of the member that is the cell `parent`, which stands before `child`.
inline std::size_t position_of(const MembersOfGroup& range, std::ptrdiff_t parent, std::size_t child) {
  while (range.first[child].cell != parent) --child;
  return child;
}

/// The part of its own change of volume that a member keeps: all of it from half full on, none where it is empty.
inline double kept_share(const Grid& grid, std::ptrdiff_t cell, double volume) {
  return std::min(1.0, volume / (0.5 * grid.cell_volume[cell]));
}

/// Rate of strain of every member. A member is strained by its own rate of volume, but one under half full hands the
/// rest of it on to its parent, the fuller one: so it is no stiffer than a half-full cell, and a cell that joins or
/// leaves a group feels no jolt. What the root cannot keep strains the whole group.
/// `volumes` are free volumes by cell, `rate_of(cell)` a rate of volume.
template <class Rate>
void member_strains(const Fluid& fluid, std::size_t g, const std::vector<double>& volumes, Rate&& rate_of,
                    std::vector<double>& strain) {
  const MembersOfGroup range = members_of(fluid.groups, g);
  const std::size_t count = static_cast<std::size_t>(range.last - range.first);
  strain.assign(count, 0.0);
  double common = 0, group_volume = 0;
  for (std::size_t m = count; m-- > 0;) {
    const auto& [c, parent] = range.first[m];
    const double volume = volumes[c], rate = strain[m] + rate_of(c);
    const double kept = kept_share(fluid.grid, c, volume) * rate;
    strain[m] = volume > 0 ? kept / volume : 0.0;
    group_volume += volume;
    if (m == 0)
      common = rate - kept;
    else
      strain[position_of(range, parent, m)] += rate - kept;
  }
  // A member without volume has nothing to be strained, the group holds half a cell at least.
  for (double& one : strain) one += group_volume > 0 ? common / group_volume : 0.0;
}

}  // namespace polynya::fluid
