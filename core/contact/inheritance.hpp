#pragma once
#include <span>
#include <vector>

#include "core/contact/body.hpp"
#include "core/contact/touch.hpp"

namespace polynya::contact {

/// A force whose pair vanished.
struct LostForce {
  Vector3 place{};   ///< m, where it acted
  double force = 0;  ///< N
};

/// Hands lost forces to new particles that touch at once: they take the place of the nodes and faces that held before.
/// A particle is an heir of what acted within four of its radii; of these, those within half as much again as the least
/// distance share a force, the nearer the more. To `lost` is added what pairs that go on hold less because their
/// stiffness fell: with an element's mass its part of the spring goes to the particle.
void inherit(const Body& primary, const Body& secondary, std::vector<LostForce> lost, std::span<const Touch> touches);

}  // namespace polynya::contact
