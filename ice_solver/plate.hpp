#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/continuum/explicit_solid.hpp"
#include "ice_solver/neighbour_list.hpp"

namespace polynya::ice {

/// What happens on the outer lateral faces: waves leave, nothing holds them, or they are held in place.
/// clamped_ends: those across x are held, those across y slide in their planes, so that nothing depends on y.
enum class Sides { non_reflecting, free, clamped, clamped_ends };

/// "non_reflecting", "free", "clamped" or "clamped_ends". Throws std::invalid_argument naming the alternatives.
Sides sides_from_name(const std::string& name);

/// Hexahedra between grid lines (m, ascending). Nodes and elements are numbered along z first, then x, then y, so that
/// neighbours in a thin plate are neighbours in memory. Throws std::invalid_argument if a line has less than two nodes
/// or does not ascend.
continuum::HexMesh plate_mesh(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& z);

/// Holds what symmetry and sides demand: the normal component on symmetry planes, all components on clamped sides,
/// waves leaving through non-reflecting ones. The plate must begin at 0 where it is cut by a plane.
void constrain_plate(continuum::ExplicitSolid& plate, SymmetryPlanes planes, Sides sides);

/// Holds the nodes of the upper face that lie within `width` (m) of the sides that are not symmetry planes.
void hold_rim(continuum::ExplicitSolid& plate, SymmetryPlanes planes, double width);

/// What holds a set of nodes of a mesh: components of velocity that stay 0 (bits 0, 1, 2: x, y, z), or waves leave
/// through the faces whose four nodes are in the set.
struct Support {
  std::vector<std::int32_t> nodes;
  std::uint8_t components = 0;
  bool non_reflecting = false;
};

void hold_supports(continuum::ExplicitSolid& body, std::span<const Support> supports);
/// The non-reflecting ones. Hold all that is held first.
void release_waves(continuum::ExplicitSolid& body, std::span<const Support> supports);

/// The symmetry planes as the surface extraction wants them: faces on them cannot be touched.
std::vector<continuum::Plane> excluded_planes(SymmetryPlanes planes);

}  // namespace polynya::ice
