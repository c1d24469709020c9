#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/compute/state_archive.hpp"

namespace polynya::continuum {

/// Eight-node hexahedra. Node order of VTK: 0-1-2-3 counter-clockwise seen from the side of 4-5-6-7, which lie above
/// 0-1-2-3; so a positive volume has (1-0) x (3-0) . (4-0) > 0.
struct HexMesh {
  std::vector<double> nodes;           ///< [n][3], m, reference positions
  std::vector<std::int32_t> elements;  ///< [e][8], node indices

  std::size_t node_count() const { return nodes.size() / 3; }
  std::size_t element_count() const { return elements.size() / 8; }

  POLYNYA_STATE_WITHOUT((elements), nodes, elements)
};

}  // namespace polynya::continuum
