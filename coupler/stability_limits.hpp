#pragma once
#include "core/scene/scene.hpp"
#include "coupler/conversation.hpp"

namespace polynya::coupler {

/// Longest span that lagged fluid loads bear: rho_f c dt < 0.5 x areal mass of the lightest surface node layer
/// (REFERENCE 9). Vertices on walls of the fluid's grid do not count: they are not wetted. s
double lag_limit(const Conversation& conversation, const scene::Scene& scene);

/// Smallest mass per wetted area over the vertices of a surface, kg/m^2.
double least_areal_mass(const SolidSide& side, const geometry::GridLines& grid);

}  // namespace polynya::coupler
