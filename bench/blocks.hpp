#pragma once
#include "core/continuum/hex_mesh.hpp"

namespace polynya::bench {

/// n^3 equal cubes that fill one of this side (m).
inline continuum::HexMesh cube(int n, double side) {
  continuum::HexMesh mesh;
  for (int k = 0; k <= n; ++k)
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) mesh.nodes.insert(mesh.nodes.end(), {side * i / n, side * j / n, side * k / n});
  const auto node = [&](int i, int j, int k) { return i + (n + 1) * (j + (n + 1) * k); };
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        for (int z = k; z <= k + 1; ++z)
          mesh.elements.insert(mesh.elements.end(),
                               {node(i, j, z), node(i + 1, j, z), node(i + 1, j + 1, z), node(i, j + 1, z)});
  return mesh;
}

}  // namespace polynya::bench
