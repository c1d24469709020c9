#pragma once
#include "core/continuum/hex_mesh.hpp"
#include "ice_solver/neighbour_list.hpp"

namespace polynya::ice {

/// A ball of hexahedra about (0, 0, centre): a core, cube of half the radius whose faces bulge, and six blocks of
/// layers from its faces to the sphere. Only x >= 0, y >= 0 where symmetry planes cut. size: m, of the elements;
/// nearest divisions, two at least. Throws std::invalid_argument unless radius and size are positive.
continuum::HexMesh ball_mesh(double radius, double size, double centre, SymmetryPlanes planes);

}  // namespace polynya::ice
