#pragma once
#include <limits>

#include "core/scene/scene.hpp"
#include "coupler/conversation.hpp"

namespace polynya::coupler {

/// A fluid that does not forecast its loads (docs/protocol.md) has them held from one span to the next. Two things
/// bound the span then, both shown on a model in tests/coupler/held_loads_test.cpp.

/// The lightest wall: the mean over a cell's pieces of wall of (vertex mass / vertex area), because one pressure acts
/// on all of them. Cells with little wall (under a tenth of their smallest face) and cells along the grid's outer sides
/// do not count.
struct LightestWall {
  double areal_mass = std::numeric_limits<double>::infinity();  ///< kg/m^2
  std::int64_t cell = -1;
  Body body = Body::vehicle;
};
LightestWall lightest_wall(const Conversation& conversation, const geometry::CutCells& cut);

/// Largest density x sound speed x span / areal mass: a free wall is thrown to and fro beyond 2, one that oscillates
/// sooner.
inline constexpr double lag_factor = 0.7;
/// Span over the smallest stable step of the solids: their fastest motion turns by twice that in a span, and loads as
/// old as a span and a half begin to drive it at about 1.3.
inline constexpr double held_share_of_step = 0.5;

/// Longest span that held fluid loads bear on the lightest wall, s.
double lag_limit(const LightestWall& wall, const scene::Scene& scene);

}  // namespace polynya::coupler
