#pragma once
#include <limits>

#include "core/scene/scene.hpp"
#include "coupler/conversation.hpp"

namespace polynya::coupler {

/// The wall that bounds the span: the mean over a cell's pieces of wall of (vertex mass / vertex area), because one
/// pressure acts on all of them, times the `lag_factor` of the body. Cells with little wall (under a tenth of their
/// smallest face) and cells along the grid's outer sides do not count.
struct LightestWall {
  double bound = std::numeric_limits<double>::infinity();  ///< factor x areal mass, kg/m^2
  double areal_mass = 0;                                   ///< kg/m^2
  std::int64_t cell = -1;
  Body body = Body::vehicle;
};
LightestWall lightest_wall(const Conversation& conversation, const geometry::CutCells& cut);

/// Largest rho_f c dt / m' of a span. A free wall whose change of speed is answered at once is stable beyond 2
/// (tests/coupler/lagged_loads_test.cpp); a thin elastic hull oscillates through its wall within a span and needs more.
inline constexpr double lag_factor(Body body) {
  return body == Body::vehicle ? 0.7 : 2.0;
}

/// Span over the stable step of the intact ice. The fastest motion of the ice turns by 2 / (stable step) x span; loads
/// as old as a span and a half begin to drive it at about 1.3 (tests/coupler/lagged_loads_test.cpp).
inline constexpr double ice_share_of_step = 0.5;

/// Longest span that lagged fluid loads bear, s.
double lag_limit(const LightestWall& wall, const scene::Scene& scene);

}  // namespace polynya::coupler
