#pragma once
#include <array>
#include <vector>

#include "geometry/vehicle/quarter_mesh.hpp"

namespace polynya::geometry {

/// Position (x, y, depth) of a hull node.
std::array<double, 3> position(const HullNode& node);

/// Layers of hexahedra between the hull and one inner node per hull node. Node i of layer l (0: hull, `layers`: inner)
/// has the number l * net.nodes.size() + i.
QuarterMesh layer_hull(const HullNet& net, const std::vector<std::array<double, 3>>& inner_nodes, int layers);

}  // namespace polynya::geometry
