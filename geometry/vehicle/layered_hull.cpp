#include "geometry/vehicle/layered_hull.hpp"

namespace polynya::geometry {

std::array<double, 3> position(const HullNode& node) {
  return {node.radius * node.cosine, node.radius * node.sine, node.depth};
}

QuarterMesh layer_hull(const HullNet& net, const std::vector<std::array<double, 3>>& inner_nodes, int layers) {
  QuarterMesh mesh;
  const auto count = static_cast<std::int32_t>(net.nodes.size());
  mesh.nodes.reserve(net.nodes.size() * (layers + 1));
  for (int layer = 0; layer <= layers; ++layer) {
    const double share = static_cast<double>(layer) / layers;
    for (std::int32_t i = 0; i < count; ++i) {
      const auto outer = position(net.nodes[i]);
      const auto& inner = inner_nodes[i];
      std::array<double, 3> node;
      for (int a = 0; a < 3; ++a) node[a] = (1 - share) * outer[a] + share * inner[a];
      mesh.nodes.push_back(node);
    }
  }
  for (int layer = 0; layer < layers; ++layer)
    for (const auto& quad : net.quads) {
      std::array<std::int32_t, 8> element;
      for (int corner = 0; corner < 4; ++corner) {
        element[corner] = (layer + 1) * count + quad[corner];
        element[corner + 4] = layer * count + quad[corner];
      }
      mesh.elements.push_back(element);
    }
  mesh.hull = net.quads;
  mesh.regions = net.regions;
  return mesh;
}

}  // namespace polynya::geometry
