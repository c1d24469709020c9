#pragma once
#include <array>
#include <cstdint>
#include <functional>

#include "core/continuum/hex_mesh.hpp"

namespace polynya::tests {

/// n[0] x n[1] x n[2] equal bricks that fill a box from the origin; `moved` displaces each node.
inline continuum::HexMesh block(std::array<int, 3> n, std::array<double, 3> size,
                                const std::function<void(double*)>& moved = {}) {
  continuum::HexMesh mesh;
  for (int k = 0; k <= n[2]; ++k)
    for (int j = 0; j <= n[1]; ++j)
      for (int i = 0; i <= n[0]; ++i) {
        double x[] = {size[0] * i / n[0], size[1] * j / n[1], size[2] * k / n[2]};
        if (moved) moved(x);
        mesh.nodes.insert(mesh.nodes.end(), x, x + 3);
      }
  const auto node = [&](int i, int j, int k) { return i + (n[0] + 1) * (j + (n[1] + 1) * k); };
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
        for (int z = 0; z < 2; ++z)
          for (std::int32_t v :
               {node(i, j, k + z), node(i + 1, j, k + z), node(i + 1, j + 1, k + z), node(i, j + 1, k + z)})
            mesh.elements.push_back(v);
  return mesh;
}

}  // namespace polynya::tests
