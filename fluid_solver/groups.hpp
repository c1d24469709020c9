#pragma once
#include <cstdint>
#include <vector>

#include "core/compute/state_archive.hpp"
#include "fluid_solver/cut_geometry.hpp"

namespace polynya::fluid {

/// Cells that are brought to one thermodynamic state, but for what each is compressed by itself (group_state.cpp). A
/// cell under half full, before or after the step, joins the neighbour it is most open to, until the group holds at
/// least half a cell: so cuts never shorten the stable step, and cells may appear and vanish. A small cell that solids
/// have sealed off joins the nearest fluid through the wall: it keeps no state of its own, and its mass is never lost.
struct Groups {
  struct Member {
    std::ptrdiff_t cell;
    std::ptrdiff_t parent;  ///< face neighbour one step nearer to the root; -1 for the root
  };
  std::vector<Member> members;     ///< group after group; the root first, parents before children
  std::vector<std::size_t> first;  ///< where each group starts; one entry more than there are groups
  long sealed = 0;                 ///< groups that had no open neighbour
  std::size_t count() const { return first.empty() ? 0 : first.size() - 1; }

  POLYNYA_STATE(members, first, sealed)
};

/// `previous` are the groups of the step before: cells keep their partners while these serve.
/// `label` is scratch of the grid's size, -1 everywhere, and is left so.
Groups find_groups(const Grid& grid, const CutGeometry& before, const CutGeometry& after, const Groups& previous,
                   std::vector<std::int32_t>& label);

}  // namespace polynya::fluid
