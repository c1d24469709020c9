#include "geometry/vehicle/quarter_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace polynya::geometry {

void mirror(QuarterMesh& mesh, int axis) {
  const std::size_t nodes = mesh.nodes.size(), elements = mesh.elements.size(), quads = mesh.hull.size();
  std::vector<std::int32_t> image(nodes);
  for (std::size_t i = 0; i < nodes; ++i) {
    if (mesh.nodes[i][axis] == 0.0) {
      image[i] = static_cast<std::int32_t>(i);
      continue;
    }
    image[i] = static_cast<std::int32_t>(mesh.nodes.size());
    std::array<double, 3> reflected = mesh.nodes[i];
    reflected[axis] = -reflected[axis];
    mesh.nodes.push_back(reflected);
  }
  for (std::size_t e = 0; e < elements; ++e) {
    const auto source = mesh.elements[e];
    // A reflection turns the element inside out; walking its bottom and top the other way turns it back.
    constexpr std::array<int, 8> order = {1, 0, 3, 2, 5, 4, 7, 6};
    std::array<std::int32_t, 8> reflected;
    for (int corner = 0; corner < 8; ++corner) reflected[corner] = image[source[order[corner]]];
    mesh.elements.push_back(reflected);
  }
  for (std::size_t q = 0; q < quads; ++q) {
    const auto source = mesh.hull[q];
    // Starting from the same corner keeps the diagonal of the split into triangles a mirror image.
    mesh.hull.push_back({image[source[0]], image[source[3]], image[source[2]], image[source[1]]});
    mesh.regions.push_back(mesh.regions[q]);
  }
}

void sort_along_axis(QuarterMesh& mesh, double slice) {
  std::vector<long> key(mesh.elements.size());
  for (std::size_t e = 0; e < key.size(); ++e) {
    double depth = 0;
    for (const std::int32_t node : mesh.elements[e]) depth += mesh.nodes[node][2];
    key[e] = std::lround(0.125 * depth / slice);
  }
  std::vector<std::size_t> order(key.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key[a] < key[b]; });

  std::vector<std::int32_t> renumbered(mesh.nodes.size(), -1);
  std::vector<std::array<double, 3>> nodes;
  std::vector<std::array<std::int32_t, 8>> elements;
  nodes.reserve(mesh.nodes.size());
  elements.reserve(mesh.elements.size());
  for (const std::size_t e : order) {
    auto element = mesh.elements[e];
    for (std::int32_t& node : element) {
      if (renumbered[node] < 0) {
        renumbered[node] = static_cast<std::int32_t>(nodes.size());
        nodes.push_back(mesh.nodes[node]);
      }
      node = renumbered[node];
    }
    elements.push_back(element);
  }
  for (auto& quad : mesh.hull)
    for (std::int32_t& node : quad) node = renumbered[node];
  mesh.nodes = std::move(nodes);
  mesh.elements = std::move(elements);
}

}  // namespace polynya::geometry
