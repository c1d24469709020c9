#pragma once
#include "core/scene/scene.hpp"
#include "coupler/conversation.hpp"

namespace polynya::coupler {

/// Smallest areal mass of the node layer behind the wall of a cut cell, kg/m^2: the mean of (vertex mass / vertex area)
/// over the pieces of wall in the cell, because one pressure acts on all of them. Cells with little wall (under a tenth
/// of their smallest face) and cells along the grid's outer sides do not count.
double least_areal_mass(const SolidSide& side, const geometry::CutCells& cut, const geometry::GridLines& grid);

/// Longest span that lagged fluid loads bear: rho_f c dt < 0.5 x areal mass of the lightest surface node layer
///, s.
double lag_limit(const Conversation& conversation, const geometry::CutCells& cut, const scene::Scene& scene);

}  // namespace polynya::coupler
