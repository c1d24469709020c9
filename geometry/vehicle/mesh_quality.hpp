#pragma once
#include "core/continuum/hex_mesh.hpp"

namespace polynya::geometry {

/// How good a mesh of hexahedra is.
struct MeshQuality {
  double least_scaled_jacobian = 1;  ///< over all corners: triple product of the unit edge vectors
  double greatest_aspect = 1;        ///< longest over shortest edge of an element
  double smallest_edge = 0;          ///< m
  double smallest_height = 0;        ///< m, volume over largest face; divided by the wave speed: the stable step
  double volume = 0;                 ///< m^3
};

MeshQuality measure_quality(const continuum::HexMesh& mesh);

/// Volume of the trilinear hexahedra, m^3 (exact formula, summed over the elements).
double mesh_volume(const continuum::HexMesh& mesh);

}  // namespace polynya::geometry
